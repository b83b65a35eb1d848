"""Who is alone is never refused, others have their turn, and a refusal costs next to nothing."""

import contextlib
import itertools
from concurrent.futures import ThreadPoolExecutor
from typing import Any

import httpx
import pytest

from backend.gate.turns import Turns
from tests.servers.process import HANG_TIMEOUT, wait_until

HERE = "127.0.0.1"  # the client of these tests
JSON = {"Content-Type": "application/json"}
_seeds = itertools.count(500_000)


def full(turns: Turns) -> contextlib.ExitStack:
    """As many requests of this client as it may have open."""
    held = contextlib.ExitStack()
    for _ in range(turns.client_queue):
        held.enter_context(turns.ticket(HERE))
    return held


def test_one_client_with_64_threads_is_never_refused(service: Any) -> None:
    def run(seed: int) -> int:
        body = {"scenario": {"road": {"seed": seed}}, "strategies": ["passive"]}
        answer = clients[seed % 64].post("/api/v1/runs", json=body)
        assert answer.status_code == 200, answer.text
        return answer.status_code

    seeds = [next(_seeds) for _ in range(512)]
    with contextlib.ExitStack() as opened:
        clients = [
            opened.enter_context(httpx.Client(base_url=service.base_url, timeout=HANG_TIMEOUT)) for _ in range(64)
        ]
        with ThreadPoolExecutor(64) as threads:
            assert list(threads.map(run, seeds)) == [200] * 512


def test_a_refusal_comes_before_the_body_is_read_and_what_is_only_read_is_read(
    service: Any, run: dict[str, Any], monkeypatch: pytest.MonkeyPatch
) -> None:
    gate = service.services.gate
    with full(gate.computing_turns):
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
    with full(gate.reading_turns):
        assert service.get("/api/v1/batches").status_code == 429
        assert service.run(list(run["strategies"]), run["scenario"]).status_code == 200
    monkeypatch.setattr(gate.computing_turns, "queue", 1)
    with gate.computing_turns.ticket("192.0.2.1"):
        answer = service.post("/api/v1/runs", content=b"no JSON", headers=JSON)
        assert (answer.status_code, int(answer.headers["retry-after"]) > 0) == (503, True)
    monkeypatch.undo()
    assert service.post("/api/v1/runs", content=b"no JSON", headers=JSON).status_code == 400


def test_who_hangs_up_while_waiting_for_a_turn_waits_no_more(service: Any, run: dict[str, Any]) -> None:
    turns: Turns = service.services.gate.reading_turns

    async def take() -> None:
        for _ in range(turns.client_places):
            await turns.take_place(HERE)

    async def give_back() -> None:
        for _ in range(turns.client_places):
            turns.free_place(HERE)

    service.inside(take())
    with service.begun("GET", "/api/v1/batches") as left, service.begun("GET", "/api/v1/batches") as stays:
        wait_until(lambda: turns.waiting == 2, "both wait for their turn")
        assert service.run(list(run["strategies"]), run["scenario"]).status_code == 200
        left.close()
        wait_until(lambda: turns.waiting == 1, "who has gone waits no more")
        service.inside(give_back())
        stays.settimeout(HANG_TIMEOUT)
        assert stays.recv(12) == b"HTTP/1.1 200"
    wait_until(lambda: turns.open == 0, "nothing is left")
