"""Every error is a problem with the security headers, and the service goes on."""

import asyncio
import itertools
import threading
from typing import Any

import httpx
import pytest
from sqlalchemy.exc import OperationalError

from backend.errors import (
    WorkerLostError,
    WorkersBusyError,
    WorkerTimeoutError,
)
from backend.http import openapi
from backend.http.middleware import HEADERS
from backend.http.problem_types import KINDS
from backend.http.problems import Problem
from sim_core.errors import RidelabError, TooExpensiveError
from tests.servers.process import HANG_TIMEOUT, wait_until

SOLVE = {"strategy": "passive", "field": "road.bump.height", "metric": "travel_time", "range": [0.05, 0.1], "limit": 99}


def check(response: httpx.Response, status: int, kind: str) -> Problem:
    assert response.status_code == status, response.text
    assert response.headers["content-type"] == "application/problem+json"
    for name, value in HEADERS.items():
        assert response.headers[name] == value
    assert response.headers["cache-control"] == "no-store"
    assert "server" not in response.headers
    problem = Problem.model_validate(response.json())
    assert (problem.status, problem.request_id) == (status, response.headers["x-request-id"])
    assert problem.detail
    assert problem.type == f"urn:problem-type:ridelab:{kind}"
    assert problem.title == KINDS[kind].title
    return problem


@pytest.mark.parametrize(
    ("method", "path", "allowed"), [("DELETE", "runs", {"POST"}), ("PUT", "batches", {"GET", "POST"})]
)
def test_a_wrong_method_is_405_and_says_which_are_right_without_describing_all_others(
    client: httpx.Client, method: str, path: str, allowed: set[str], monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.setattr(openapi, "describe", None)  # takes seconds
    response = client.request(method, f"/api/v1/{path}")
    check(response, 405, "method-not-allowed")
    assert {name.strip() for name in response.headers["allow"].split(",")} == allowed


@pytest.mark.parametrize(
    ("error", "status", "kind", "retry"),
    [
        (RuntimeError("secret detail"), 500, "internal-error", False),
        (OperationalError("secret statement", {}, Exception()), 503, "store-unavailable", True),
        (WorkerLostError(), 503, "worker-lost", True),
        (WorkersBusyError(), 503, "full", True),
        (WorkerTimeoutError(), 422, "too-expensive", False),
        (TooExpensiveError("Too much", fields=("road.length",)), 422, "too-expensive", False),
        (RidelabError("Out of reach", field="road.length"), 422, "refused", False),
    ],
    ids=lambda value: type(value).__name__,
)
def test_what_goes_wrong_inside_tells_nothing_of_the_inside(
    service: Any, monkeypatch: pytest.MonkeyPatch, error: Exception, status: int, kind: str, retry: bool
) -> None:
    async def fail(*_: Any, **__: Any) -> None:
        raise error

    monkeypatch.setattr(service.services.runs, "create", fail)
    response = service.run(["passive"])
    problem = check(response, status, kind)
    assert "secret" not in response.text
    assert ("retry-after" in response.headers) is retry
    if status == 422:
        places = [place.pointer for place in problem.errors]
        assert places == ["/scenario" if isinstance(error, WorkerTimeoutError) else "/scenario/road/length"]
    monkeypatch.undo()
    assert service.run(["passive"]).status_code == 200


@pytest.mark.parametrize(
    ("path", "asked"),
    [
        ("live", {"strategies": ["passive"], "scenario": {"road": {"length": 133.3}}}),
        ("runs", {"strategies": ["passive"], "scenario": {"road": {"length": 133.4}}}),
        ("controller", {"scenario": {"road": {"length": 133.3}}}),
        ("solve", {**SOLVE, "scenario": {"road": {"length": 133.5}}}),
    ],
)
def test_a_client_that_goes_away_calls_its_request_off(
    service: Any, monkeypatch: pytest.MonkeyPatch, path: str, asked: dict[str, Any]
) -> None:
    """While somebody drags on, the waiting computation of the old position is cancelled."""
    calls, waiting, called_off = itertools.count(), threading.Event(), threading.Event()

    async def never(*_: Any, **__: Any) -> Any:
        next(calls)
        waiting.set()
        try:
            await asyncio.Event().wait()
        except asyncio.CancelledError:
            called_off.set()
            raise

    monkeypatch.setattr(service.services.workers, "call", never)
    with service.begun("POST", f"/api/v1/{path}", asked):
        assert waiting.wait(HANG_TIMEOUT)
    assert called_off.wait(HANG_TIMEOUT)
    wait_until(lambda: service.services.gate.load["requests"] == 0, "it is over")
    assert next(calls) == 1, "nothing more was begun"
    monkeypatch.undo()
    assert service.post(f"/api/v1/{path}", json=asked).status_code == 200
