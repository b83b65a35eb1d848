"""The disk is full: what cannot be kept is refused, what was kept is answered, and room alone mends it."""

import resource
import sqlite3
import time
from collections.abc import Callable
from contextlib import closing
from pathlib import Path
from typing import Any

import httpx
import psutil
import pytest

from tests.faults.conftest import Process, Start

FREE = (resource.RLIM_INFINITY, resource.RLIM_INFINITY)
SHORT = {"road": {"length": 121.3, "bump": {"start": 80}}}
# A second or two of one core each, so that a batch of them is under way when the disk fills up.
SLOW = {"road": {"length": 60.9, "bump": {"start": 30}}, "mpc": {"solver": "osqp", "force_limit": 500}}


class Disk:
    """The service's files may not grow any more, as if the disk were full; on a disk of one's own it would be."""

    def __init__(self, service: Process, database: Path) -> None:
        self._process = psutil.Process(service.process.pid)
        self._database = database

    def fill(self) -> None:
        self._process.rlimit(psutil.RLIMIT_FSIZE, (self._database.stat().st_size, resource.RLIM_INFINITY))

    def empty(self) -> None:
        self._process.rlimit(psutil.RLIMIT_FSIZE, FREE)


@pytest.fixture
def database(tmp_path: Path) -> Path:
    return tmp_path / "data" / "ridelab.sqlite"


def post(service: Process, seed: int) -> httpx.Response:
    scenario = {"road": {**SHORT["road"], "seed": seed}}
    return service.client.post("/api/v1/runs", json={"scenario": scenario, "strategies": ["lv", "lqr", "passive"]})


def submit(service: Process, scenario: dict[str, Any], count: int, key: str) -> httpx.Response:
    body = {"scenario": scenario, "strategies": ["lv"], "sweep": {"list": [{"road.seed": i} for i in range(count)]}}
    return service.client.post("/api/v1/batches", json=body, headers={"Idempotency-Key": key})


def until(condition: Callable[[], bool], seconds: float = 120) -> None:
    end = time.monotonic() + seconds
    while not condition():
        assert time.monotonic() < end
        time.sleep(0.1)


def intact(database: Path) -> bool:
    with closing(sqlite3.connect(database)) as connection:
        return connection.execute("PRAGMA integrity_check").fetchall() == [("ok",)]


def check_refused(response: httpx.Response) -> None:
    assert response.status_code == 503, response.text
    assert response.headers["content-type"] == "application/problem+json"
    assert response.json()["type"].endswith("store-unavailable")
    assert int(response.headers["retry-after"]) > 0
    assert "sqlite" not in response.text.lower()


def test_what_cannot_be_kept_is_refused_and_what_is_kept_stays(start: Start, database: Path) -> None:
    service = start(RIDELAB_WORKERS="1")
    kept = post(service, 1)
    assert kept.status_code == 200
    disk = Disk(service, database)
    disk.fill()
    for seed in (2, 3, 4):
        check_refused(post(service, seed))
    check_refused(submit(service, SHORT, 500, "first"))
    assert service.client.get("/healthz").status_code == 200
    stored = service.client.get(f"/api/v1/runs/{kept.json()['id']}")
    assert stored.status_code == 200
    assert post(service, 1).json()["id"] == kept.json()["id"], "it is stored already"
    live = service.client.post("/api/v1/live", json={"scenario": SHORT, "strategies": ["lqr"], "points": 50})
    assert live.status_code == 200, "dragging keeps nothing"
    metrics = service.client.get("/metrics").text
    assert "ridelab_store_errors_total 4.0" in metrics
    disk.empty()
    for seed in (2, 3, 4):
        assert post(service, seed).status_code == 200
    assert service.client.get("/api/v1/batches").json()["batches"] == [], "what was refused is not there"
    assert submit(service, SHORT, 3, "first").status_code == 202, "its key was not used up"
    assert service.client.get(f"/api/v1/runs/{kept.json()['id']}").json() == stored.json()
    assert intact(database)


def test_a_batch_under_way_waits_for_room_and_completes(start: Start, database: Path) -> None:
    service = start(RIDELAB_WORKERS="1", RIDELAB_BATCH_WORKERS="1")
    accepted = submit(service, SLOW, 6, "slow").json()

    def batch() -> dict[str, Any]:
        answer: dict[str, Any] = service.client.get(f"/api/v1/batches/{accepted['id']}").json()
        return answer

    until(lambda: batch()["done"] >= 1)
    disk = Disk(service, database)
    disk.fill()
    time.sleep(4)  # some results arrive that cannot be kept
    assert service.client.get("/healthz").status_code == 200
    held = batch()
    assert held["state"] == "running"
    assert held["done"] < 6
    disk.empty()
    until(lambda: batch()["state"] not in ("queued", "running"))
    ended = batch()
    assert (ended["state"], ended["done"], ended["failed"]) == ("done", 6, 0)
    rows = service.client.get(f"/api/v1/batches/{accepted['id']}/results").json()["rows"]
    assert [row["status"] for row in rows] == ["ok"] * 6
    assert intact(database)
