"""Batches in a real service: its ports, heavy runs cancelled, an ordered end in the middle."""

import time
from typing import Any

import psutil

from backend.batches.cluster import NICE

# A run of many seconds: far longer than the two in which a cancelled batch has to have stopped.
HEAVY = {
    "road": {"length": 400.3, "bump": {"start": 30}},
    "mpc": {"solver": "osqp", "force_limit": 300, "prediction_horizon": 60, "control_horizon": 40},
}


def submit(service: Any, scenario: dict[str, Any], runs: int) -> str:
    body = {"scenario": scenario, "strategies": ["lv"], "sweep": {"grid": {"road.seed": list(range(runs))}}}
    answer = service.client.post("/api/v1/batches", json=body)
    assert answer.status_code == 202, answer.text
    return str(answer.json()["id"])


def state(service: Any, batch_id: str) -> dict[str, Any]:
    batch: dict[str, Any] = service.client.get(f"/api/v1/batches/{batch_id}").json()
    return batch


def wait_for(service: Any, batch_id: str, *states: str, seconds: float = 120) -> dict[str, Any]:
    end = time.monotonic() + seconds
    while (batch := state(service, batch_id))["state"] not in states:
        assert time.monotonic() < end, batch["state"]
        time.sleep(0.05)
    return batch


def listening(service: Any) -> set[int]:
    """Ports on which the service or any of its processes listens."""
    family = [psutil.Process(service.process.pid), *psutil.Process(service.process.pid).children(recursive=True)]
    pids = {process.pid for process in family}
    return {
        connection.laddr.port
        for connection in psutil.net_connections("inet")
        if connection.pid in pids and connection.status == psutil.CONN_LISTEN
    }


def deep_in_work(service: Any, count: int, seconds: float = 90) -> list[psutil.Process]:
    """Processes for batches, once so many of them have computed for much longer than warming up takes."""
    end = time.monotonic() + seconds
    while time.monotonic() < end:
        batch_processes = [process for process in service.workers() if process.nice() == NICE]
        deep = [process for process in batch_processes if process.cpu_times().user > 2.5]
        if len(deep) == count:
            return deep
        time.sleep(0.1)
    raise TimeoutError("No process got deep into its work")


def test_batches_open_no_port(start: Any) -> None:
    service = start(RIDELAB_WORKERS="1", RIDELAB_BATCH_WORKERS="1")
    batch_id = submit(service, {"road": {"length": 127.3}}, 12)
    assert wait_for(service, batch_id, "done")["done"] == 12
    assert listening(service) == {service.client.base_url.port}


def test_heavy_runs_stop_when_their_batch_is_cancelled(start: Any) -> None:
    service = start(RIDELAB_WORKERS="1", RIDELAB_BATCH_WORKERS="1", RIDELAB_MAX_REQUEST_COST="1000")
    service.wait_until_warm(1)
    batch_id = submit(service, HEAVY, 6)
    wait_for(service, batch_id, "running")
    busy = deep_in_work(service, 1)
    begin = time.monotonic()
    assert service.client.post(f"/api/v1/batches/{batch_id}/cancel").json()["state"] == "cancelled"
    assert not psutil.wait_procs(busy, timeout=10)[1]
    print(f"stopped {time.monotonic() - begin:.2f} s after the request to cancel")
    assert state(service, batch_id)["done"] == 0
    # Their successors serve the next batch.
    assert wait_for(service, submit(service, {"road": {"length": 127.4}}, 4), "done")["done"] == 4


def test_an_ordered_end_in_the_middle_loses_nothing(start: Any) -> None:
    service = start(RIDELAB_WORKERS="1")
    batch_id = submit(service, {"road": {"length": 127.5}}, 300)
    while state(service, batch_id)["done"] < 8:
        time.sleep(0.05)
    family = psutil.Process(service.process.pid).children(recursive=True)
    begin = time.monotonic()
    service.process.terminate()
    service.process.wait(timeout=10)
    assert time.monotonic() - begin < 10
    assert not psutil.wait_procs(family, timeout=5)[1]
    again = start(RIDELAB_WORKERS="1")
    assert 8 <= state(again, batch_id)["done"] <= 300
    batch = wait_for(again, batch_id, "done")
    assert (batch["done"], batch["failed"]) == (300, 0)
