"""The database server goes away and comes back: nothing that was answered is lost, and nobody has to help."""

import os
import subprocess
import sys
import time
from pathlib import Path
from typing import Any

import httpx
import pytest

from tests.faults.conftest import ROOT, Process, Start
from tests.faults.test_disk_full import SHORT, SLOW, check_refused, post, submit, until
from tests.servers.postgres import Postgres


@pytest.fixture
def database(postgres: Postgres) -> Any:
    """A database of its own, on a server that runs again afterwards."""
    yield postgres.new_database()
    postgres.start()


def ready(service: Process) -> bool:
    try:
        return service.client.get("/readyz").status_code == 200
    except httpx.TransportError:
        return False


@pytest.mark.parametrize("how", ["stop", "kill"])
def test_while_it_is_away_answers_are_503_and_then_as_before(
    start: Start, postgres: Postgres, database: str, how: str
) -> None:
    service = start(RIDELAB_WORKERS="1", RIDELAB_DATABASE_URL=database)
    kept = post(service, 1).json()
    getattr(postgres, how)()
    for _ in range(3):
        check_refused(post(service, 2))
        check_refused(service.client.get(f"/api/v1/runs/{kept['id']}"))
        check_refused(submit(service, SHORT, 3, "first"))
        assert service.client.get("/healthz").status_code == 200
        assert service.client.get("/api/v1/schema").status_code == 200
        unready = service.client.get("/readyz")
        assert unready.status_code == 503
        assert unready.json()["store"] is False
    live = service.client.post("/api/v1/live", json={"scenario": SHORT, "strategies": ["lqr"], "points": 50})
    assert live.status_code == 200, "dragging needs no database"
    postgres.start()
    until(lambda: ready(service))
    again = service.client.get(f"/api/v1/runs/{kept['id']}")
    assert again.status_code == 200
    assert {**again.json(), "strategies": None} == {**kept, "strategies": None}
    assert post(service, 2).status_code == 200
    assert submit(service, SHORT, 3, "first").status_code == 202


def test_a_batch_under_way_goes_on_when_it_is_back(start: Start, postgres: Postgres, database: str) -> None:
    service = start(RIDELAB_WORKERS="1", RIDELAB_BATCH_WORKERS="1", RIDELAB_DATABASE_URL=database)
    accepted = submit(service, SLOW, 6, "slow").json()

    def batch() -> dict[str, Any]:
        answer: dict[str, Any] = service.client.get(f"/api/v1/batches/{accepted['id']}").json()
        return answer

    until(lambda: batch()["done"] >= 1)
    postgres.kill()
    time.sleep(4)  # some results arrive that cannot be kept
    assert service.client.get("/healthz").status_code == 200
    check_refused(service.client.get(f"/api/v1/batches/{accepted['id']}"))
    postgres.start()
    until(lambda: ready(service))
    until(lambda: batch()["state"] not in ("queued", "running"))
    ended = batch()
    assert (ended["state"], ended["done"], ended["failed"]) == ("done", 6, 0)
    rows = service.client.get(f"/api/v1/batches/{accepted['id']}/results").json()["rows"]
    assert [row["status"] for row in rows] == ["ok"] * 6


def test_a_start_without_it_says_so_and_ends(postgres: Postgres, database: str, tmp_path: Path) -> None:
    postgres.stop()
    command = [sys.executable, "-m", "backend", "--port", "0", "--data-dir", str(tmp_path)]
    environment = {**os.environ, "RIDELAB_DATABASE_URL": database, "RIDELAB_WORKERS": "1"}
    ended = subprocess.run(command, cwd=ROOT, env=environment, capture_output=True, text=True, timeout=90, check=False)
    assert ended.returncode != 0
    assert "onnect" in ended.stderr
    for secret in ("p@ss", "p%40ss"):
        assert secret not in ended.stdout + ended.stderr
