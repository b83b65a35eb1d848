"""Processes killed at bad moments: what was answered stays, what was asked is answered or refused clearly."""

import contextlib
import signal
import socket
import threading
import time
from concurrent.futures import ThreadPoolExecutor
from pathlib import Path
from typing import Any

import httpx
import psutil
import pytest

from backend.__main__ import main

# A second or two of one core: long enough to kill a worker in the middle.
LONG: dict[str, Any] = {"road": {"length": 60.3, "bump": {"start": 30}}, "mpc": {"solver": "osqp", "force_limit": 500}}
SHORT = {"road": {"length": 131.7}}


def long(seed: int) -> dict[str, Any]:
    """Another run of that length each time: a stored one would need no worker."""
    return {**LONG, "road": {**LONG["road"], "seed": seed}}


def post(service: Any, scenario: dict[str, Any], *strategies: str) -> httpx.Response:
    return service.client.post("/api/v1/runs", json={"scenario": scenario, "strategies": list(strategies)})


def test_a_worker_killed_in_the_middle_of_a_run_costs_one_retry(service: Any) -> None:
    service.wait_until_warm(2)
    with ThreadPoolExecutor(1) as threads:
        answer = threads.submit(post, service, long(1), "lv")
        victim = service.wait_for_busy()
        victim.kill()
        response = answer.result()
    assert response.status_code == 200, response.text
    assert response.json()["strategies"]["lv"]["status"] == "ok"
    assert victim.pid not in {worker.pid for worker in service.workers()}
    assert post(service, SHORT, "passive").status_code == 200


def test_a_run_that_kills_two_workers_is_refused_clearly_and_others_go_on(service: Any) -> None:
    service.wait_until_warm(2)
    with ThreadPoolExecutor(1) as threads:
        answer = threads.submit(post, service, long(2), "lv")
        first = service.wait_for_busy()
        others = {worker.pid for worker in service.workers()} - {first.pid}
        first.kill()
        second = service.wait_for_busy(among=others)
        second.kill()
        response = answer.result()
    assert response.status_code == 503
    assert response.headers["content-type"] == "application/problem+json"
    assert response.json()["type"].endswith("worker-lost")
    assert "retry-after" in response.headers
    assert post(service, SHORT, "passive").status_code == 200


def test_workers_killed_while_idle_are_replaced_unnoticed(service: Any) -> None:
    service.wait_until_warm(2)
    killed = {worker.pid for worker in service.workers()}
    for worker in service.workers():
        worker.kill()
    assert post(service, {"road": {"length": 131.6}}, "passive").status_code == 200
    service.wait_until_warm(2)
    assert not killed & {worker.pid for worker in service.workers()}
    assert service.client.get("/readyz").status_code == 200


def test_an_answered_run_survives_the_service(start: Any) -> None:
    service = start(RIDELAB_WORKERS="1")
    answer = post(service, SHORT, "lv", "passive").json()
    workers = service.workers()
    service.kill()
    for worker in workers:
        worker.wait(timeout=10)  # they end with the service, though it could tell them nothing
    again = start(RIDELAB_WORKERS="1")
    stored = again.client.get(f"/api/v1/runs/{answer['id']}")
    assert stored.status_code == 200
    for name, entry in stored.json()["strategies"].items():
        assert {**entry, "cached": False} == answer["strategies"][name]
    repeated = post(again, SHORT, "lv", "passive").json()
    assert all(entry["cached"] for entry in repeated["strategies"].values())
    series = again.client.get(f"/api/v1/runs/{answer['id']}/series", params={"strategy": "lv", "points": 100})
    assert series.status_code == 200, "made again from the stored scenario"


def test_an_ordered_end_comes_within_ten_seconds_and_leaves_nothing(start: Any) -> None:
    service = start(RIDELAB_WORKERS="2", RIDELAB_MAX_REQUEST_COST="1000")
    service.wait_until_warm(2)
    family = psutil.Process(service.process.pid).children(recursive=True)
    threading.Thread(target=_quietly, args=(service,), daemon=True).start()
    service.wait_for_busy()
    # A client that never sends the rest of its request must not hold the end up either.
    address = (service.client.base_url.host, service.client.base_url.port)
    with socket.create_connection(address) as connection:
        connection.sendall(b"POST /api/v1/runs HTTP/1.1\r\nHost: x\r\nContent-Length: 100\r\n\r\n{")
        begin = time.monotonic()
        service.process.send_signal(signal.SIGTERM)
        service.process.wait(timeout=10)
    assert time.monotonic() - begin < 10
    _, alive = psutil.wait_procs(family, timeout=5)
    assert not alive


def _quietly(service: Any) -> None:
    with contextlib.suppress(httpx.TransportError):  # the service may end before it answers
        post(service, {**LONG, "road": {"length": 1500.3, "bump": {"start": 30}}}, "lv")


def test_two_services_share_one_database_file(start: Any) -> None:
    services = [start(ready=False, RIDELAB_WORKERS="1") for _ in range(2)]
    for service in services:
        service.wait_until_ready()
    scenarios = [{"road": {"length": 131.7, "seed": seed}} for seed in range(8)]
    jobs = [(service, scenario) for scenario in scenarios for service in services]
    with ThreadPoolExecutor(8) as threads:
        answers = list(threads.map(lambda job: post(*job, "passive", "speed_only"), jobs))
    assert [answer.status_code for answer in answers] == [200] * len(jobs)
    runs = [answer.json() for answer in answers]
    for one, other in zip(runs[::2], runs[1::2], strict=True):
        assert one["id"] == other["id"]
        stored = [service.client.get(f"/api/v1/runs/{one['id']}").json() for service in services]
        assert stored[0] == stored[1]
        for run in (one, other):
            for name, entry in run["strategies"].items():
                assert {k: v for k, v in entry.items() if k != "cached"} == stored[0]["strategies"][name]


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

    with socket.create_server(("127.0.0.1", 0)) as taken:
        assert "in use" in fails("--port", str(taken.getsockname()[1]))
    assert "RIDELAB_WORKERS" in fails("--port", "0", RIDELAB_WORKERS="many")
    assert "URL" in fails("--port", "0", RIDELAB_DATABASE_URL="no database")
    (tmp_path / "file").touch()
    assert "file" in fails("--port", "0", "--data-dir", str(tmp_path / "file"))
