"""Worker processes killed at bad moments: what was asked is answered or refused clearly, and others are served."""

from concurrent.futures import ThreadPoolExecutor
from pathlib import Path
from typing import Any

import httpx
import pytest

from backend.__main__ import listen, main
from tests.faults.conftest import Process
from tests.servers.postgres import url
from tests.servers.process import reserved_port

# A second or two of one core: long enough to kill a worker in the middle.
LONG: dict[str, Any] = {"road": {"length": 60.3, "bump": {"start": 30}}, "mpc": {"solver": "osqp", "force_limit": 500}}
SHORT = {"road": {"length": 131.7}}


def long(seed: int) -> dict[str, Any]:
    """Another run of that length each time: a stored one would need no worker."""
    return {**LONG, "road": {**LONG["road"], "seed": seed}}


def post(service: Process, scenario: dict[str, Any], *strategies: str) -> httpx.Response:
    return service.client.post("/api/v1/runs", json={"scenario": scenario, "strategies": list(strategies)})


def test_a_worker_killed_in_the_middle_of_a_run_costs_one_retry(service: Process) -> None:
    service.wait_until_warm()
    with ThreadPoolExecutor(1) as threads:
        answer = threads.submit(post, service, long(1), "lv")
        victim = service.wait_for_busy()
        victim.kill()
        response = answer.result()
    assert response.status_code == 200, response.text
    assert response.json()["strategies"]["lv"]["status"] == "ok"
    assert victim not in service.workers()


def test_a_run_that_kills_two_workers_is_refused_clearly_and_others_go_on(service: Process) -> None:
    service.wait_until_warm()
    with ThreadPoolExecutor(1) as threads:
        answer = threads.submit(post, service, long(2), "lv")
        first = service.wait_for_busy()
        first.kill()
        service.wait_for_busy(other_than=first).kill()
        response = answer.result()
    assert response.status_code == 503
    assert response.headers["content-type"] == "application/problem+json"
    assert response.json()["type"].endswith("worker-lost")
    assert "retry-after" in response.headers
    assert post(service, SHORT, "passive").status_code == 200


def test_workers_killed_while_idle_are_replaced_unnoticed(service: Process) -> None:
    service.wait_until_warm()
    killed = service.workers()
    for worker in killed:
        worker.kill()
    assert post(service, {"road": {"length": 131.6}}, "passive").status_code == 200
    service.wait_until_warm()
    assert not set(killed) & set(service.workers())
    assert service.ready


def test_a_start_that_cannot_work_says_why(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch, capsys: pytest.CaptureFixture[str]
) -> None:
    def fails(*arguments: str, **environment: str) -> str:
        with monkeypatch.context() as patch:
            for name, value in environment.items():
                patch.setenv(name, value)
            assert main(["--data-dir", str(tmp_path), *arguments]) == 2
        message = capsys.readouterr().err
        assert message.startswith("Ridelab does not start: ")
        return message

    for port in ("99999", "-1", "http"):
        with pytest.raises(SystemExit, match="2"):
            main(["--port", port])
        assert capsys.readouterr().err.endswith("error: argument --port: a number from 0 to 65535\n")
    with listen("127.0.0.1", 0) as taken:
        port = taken.getsockname()[1]
        assert "in use; --port names another" in fails("--port", str(port))
        with listen("127.0.0.1", port, or_free=True) as other:
            assert other.getsockname()[1] != port
    assert "RIDELAB_WORKERS" in fails("--port", "0", RIDELAB_WORKERS="many")
    assert "URL" in fails("--port", "0", RIDELAB_DATABASE_URL="no database")
    nobody = fails("--port", "0", RIDELAB_DATABASE_URL=url(reserved_port(), "ridelab"))
    assert "onnect" in nobody
    assert not any(secret in nobody for secret in ("p@ss", "p%40ss"))
    (tmp_path / "file").touch()
    assert "file" in fails("--port", "0", "--data-dir", str(tmp_path / "file"))
