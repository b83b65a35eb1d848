"""Who is alone is never refused, others have their turn, and a refusal costs next to nothing."""

import contextlib
from typing import Any

import pytest

from backend.gate import Admission, RequestQueue
from tests.servers.process import HANG_TIMEOUT, wait_until

HERE = "127.0.0.1"  # the client of these tests
JSON = {"Content-Type": "application/json"}


def full(queue: RequestQueue) -> contextlib.ExitStack:
    """Open as many requests of this client as it may have."""
    held = contextlib.ExitStack()
    for _ in range(queue.max_client_requests):
        held.enter_context(queue.admit(HERE))
    return held


def test_a_refusal_comes_before_the_body_is_read_and_what_is_only_read_is_read(
    service: Any, run: dict[str, Any], monkeypatch: pytest.MonkeyPatch
) -> None:
    gate = service.services.gate
    with full(gate.compute_queue):
        answer = service.post("/api/v1/runs", content=b"no JSON", headers=JSON)
        assert (answer.status_code, int(answer.headers["retry-after"]) > 0) == (429, True)
        assert answer.json()["type"].endswith(":too-many-requests")
        for path in (
            "runs/nobody/figures",
            f"runs/{run['id']}/series?strategy=lv",
            f"runs/{run['id']}/report.html",
            "batches/nobody/results",
            "batches/nobody/table",
        ):
            assert service.get(f"/api/v1/{path}").status_code == 429, path
        for path in (f"/api/v1/runs/{run['id']}", "/api/v1/schema", "/api/v1/batches", "/healthz", "/readyz"):
            assert service.get(path).status_code == 200, path
    with full(gate.read_queue):
        assert service.get("/api/v1/batches").status_code == 429
        assert service.run(list(run["strategies"]), run["scenario"]).status_code == 200
    monkeypatch.setattr(gate.compute_queue, "max_requests", 1)
    with gate.compute_queue.admit("192.0.2.1"):
        answer = service.post("/api/v1/runs", content=b"no JSON", headers=JSON)
        assert (answer.status_code, int(answer.headers["retry-after"]) > 0) == (503, True)
    monkeypatch.undo()
    assert service.post("/api/v1/runs", content=b"no JSON", headers=JSON).status_code == 400


def test_who_hangs_up_while_waiting_for_a_turn_waits_no_more(service: Any, run: dict[str, Any]) -> None:
    queue: RequestQueue = service.services.gate.read_queue
    others = [Admission(queue, HERE) for _ in range(queue.client_slots)]

    async def take() -> None:
        for each in others:
            await each.wait_for_slot()

    async def give_back() -> None:
        for each in others:
            each.release_slot()

    service.inside(take())
    with service.begun("GET", "/api/v1/batches") as left, service.begun("GET", "/api/v1/batches") as stays:
        wait_until(lambda: queue.waiting == 2, "both wait for their turn")
        assert service.run(list(run["strategies"]), run["scenario"]).status_code == 200
        left.close()
        wait_until(lambda: queue.waiting == 1, "who has gone waits no more")
        service.inside(give_back())
        stays.settimeout(HANG_TIMEOUT)
        assert stays.recv(12) == b"HTTP/1.1 200"
    wait_until(lambda: not queue.open, "nothing is left")
