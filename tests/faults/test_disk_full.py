"""The disk is full: new results are refused, stored ones are answered, and free space alone repairs it."""

import contextlib
import resource
import sqlite3
from collections.abc import Iterator
from pathlib import Path
from typing import Any

import httpx
import psutil

from backend.compute.workers import BATCH_NICE
from tests.faults.conftest import Process
from tests.faults.test_batches import finished, state, submit
from tests.servers.process import wait_until

FREE = (resource.RLIM_INFINITY, resource.RLIM_INFINITY)
SHORT: dict[str, Any] = {"road": {"length": 121.3, "bump": {"start": 80}}}
LONG_BATCH = 200  # runs: some seconds of one core, so that it is under way when the store goes away
WAITS = "A chunk waits for the database"  # the driver's word for results that it cannot store
COUNTER = "ridelab_store_errors_total "


@contextlib.contextmanager
def full(service: Process, database: Path) -> Iterator[None]:
    """The service's files may not grow any more, as if the disk were full; on a disk of one's own it would be."""
    process = psutil.Process(service.pid)
    process.rlimit(psutil.RLIMIT_FSIZE, (database.stat().st_size, resource.RLIM_INFINITY))
    try:
        yield
    finally:
        process.rlimit(psutil.RLIMIT_FSIZE, FREE)


def post(service: Process, seed: int) -> httpx.Response:
    scenario = {"road": {**SHORT["road"], "seed": seed}}
    return service.client.post("/api/v1/runs", json={"scenario": scenario, "strategies": ["lv", "lqr", "passive"]})


def refused_batch(service: Process, key: str) -> None:
    body = {"scenario": SHORT, "strategies": ["lv"], "sweep": {"list": [{"road.seed": i} for i in range(500)]}}
    check_refused(service.client.post("/api/v1/batches", json=body, headers={"Idempotency-Key": key}))


def check_refused(response: httpx.Response) -> None:
    assert response.status_code == 503, response.text
    assert response.headers["content-type"] == "application/problem+json"
    assert response.json()["type"].endswith("store-unavailable")
    assert int(response.headers["retry-after"]) > 0
    assert "sql" not in response.text.lower()


def store_errors(service: Process) -> float:
    (line,) = [line for line in service.client.get("/metrics").text.splitlines() if line.startswith(COUNTER)]
    return float(line.removeprefix(COUNTER))


def halted(service: Process, batch_id: str) -> psutil.Process:
    """The process that computes a batch, halted once some results of it are stored and others are on their way."""
    wait_until(lambda: state(service, batch_id)["done"] > 0, "the batch begins")
    (process,) = service.workers(BATCH_NICE)
    process.suspend()
    assert state(service, batch_id)["state"] == "running", "the test needs a longer batch"
    return process


def test_new_results_are_refused_and_stored_ones_stay(service: Process, database: Path) -> None:
    first_answer = post(service, 1)
    assert first_answer.status_code == 200
    batches = service.client.get("/api/v1/batches").json()["batches"]
    errors = store_errors(service)
    with full(service, database):
        for seed in (2, 3, 4):
            check_refused(post(service, seed))
        refused_batch(service, "when-full")
        assert service.client.get("/healthz").status_code == 200
        stored = service.client.get(f"/api/v1/runs/{first_answer.json()['id']}")
        assert stored.status_code == 200
        assert post(service, 1).json()["id"] == first_answer.json()["id"], "it is stored already"
        live = service.client.post("/api/v1/live", json={"scenario": SHORT, "strategies": ["lqr"], "points": 50})
        assert live.status_code == 200, "dragging keeps nothing"
        assert store_errors(service) == errors + 4
    for seed in (2, 3, 4):
        assert post(service, seed).status_code == 200
    assert service.client.get("/api/v1/batches").json()["batches"] == batches, "what was refused is not there"
    submit(service, SHORT, 3, **{"Idempotency-Key": "when-full"})  # its key was not used up
    assert service.client.get(f"/api/v1/runs/{first_answer.json()['id']}").json() == stored.json()
    assert intact(database)


def test_a_running_batch_waits_for_room_and_completes(service: Process, database: Path) -> None:
    batch_id = submit(service, {"road": {"length": 121.9}}, LONG_BATCH)
    process, logged = halted(service, batch_id), len(service.log)
    with full(service, database):
        process.resume()
        wait_until(lambda: WAITS in service.log[logged:], "results arrive that cannot be kept")
        assert service.client.get("/healthz").status_code == 200
        held = state(service, batch_id)
        assert held["state"] == "running"
        assert held["done"] < LONG_BATCH
    finished(service, batch_id, LONG_BATCH)
    assert intact(database)


def intact(database: Path) -> bool:
    with contextlib.closing(sqlite3.connect(database)) as connection:
        return connection.execute("PRAGMA integrity_check").fetchall() == [("ok",)]
