"""Batches in a real service: its ports, and heavy runs cancelled."""

from typing import Any

import psutil

from backend.compute.workers import BATCH_NICE
from tests.faults.conftest import Process
from tests.servers.batches import rows, wait_for

# A run of a minute of a core alone.
HEAVY = {
    "road": {"length": 400.3, "bump": {"start": 30}},
    "mpc": {"solver": "osqp", "force_limit": 300, "prediction_horizon": 60, "control_horizon": 40},
}


def submit(service: Process, scenario: dict[str, Any], runs: int, **headers: str) -> str:
    body = {"scenario": scenario, "strategies": ["lv"], "sweep": {"grid": {"road.seed": list(range(runs))}}}
    answer = service.client.post("/api/v1/batches", json=body, headers=headers)
    assert answer.status_code == 202, answer.text
    return str(answer.json()["id"])


def state(service: Process, batch_id: str) -> dict[str, Any]:
    batch: dict[str, Any] = service.client.get(f"/api/v1/batches/{batch_id}").json()
    return batch


def finished(service: Process, batch_id: str, runs: int) -> None:
    """Wait for its end: every run is there, and none failed."""
    batch = wait_for(service.client, batch_id)
    assert (batch["state"], batch["done"], batch["failed"]) == ("done", runs, 0)
    assert [row["status"] for row in rows(service.client, batch_id)] == ["ok"] * runs


def test_batches_open_no_port(service: Process) -> None:
    finished(service, submit(service, {"road": {"length": 127.3}}, 12), 12)
    pids = {service.pid, *(process.pid for process in service.children())}
    ports = {
        connection.laddr.port
        for connection in psutil.net_connections("inet")
        if connection.pid in pids and connection.laddr and connection.status == psutil.CONN_LISTEN
    }
    assert ports == {service.port}


def test_heavy_runs_stop_when_their_batch_is_cancelled(service: Process) -> None:
    finished(service, submit(service, {"road": {"length": 127.3}}, 12), 12)  # afterwards its process is warm
    batch_id = submit(service, HEAVY, 6)
    busy = service.wait_for_busy(BATCH_NICE)
    before = service.cpu_times(BATCH_NICE)[busy]
    assert service.client.post(f"/api/v1/batches/{batch_id}/cancel").json()["state"] == "cancelled"
    assert wait_for(service.client, batch_id)["done"] == 0
    finished(service, submit(service, {"road": {"length": 127.4}}, 4), 4)
    spent = service.cpu_times(BATCH_NICE).get(busy, before) - before
    assert spent < 20, "it was interrupted in the middle of its first run"
