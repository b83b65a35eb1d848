"""Which requests are admitted: limits for one client and for all, and what a refusal says."""

import threading
from concurrent.futures import ThreadPoolExecutor
from contextlib import AbstractContextManager, ExitStack
from typing import Any

import httpx
import pytest
from hypothesis import given
from hypothesis import strategies as st

from backend.backlog import Backlog
from backend.errors import BusyError, TooManyRequestsError
from backend.http.admission import Admission
from backend.http.limits import ConcurrencyLimit, TokenBucket, client_key
from sim_core.scenario import Scenario
from sim_core.workload import estimate
from tests.servers.process import wait_until

PASSIVE = estimate(Scenario(), "passive")


def refusal(opened: AbstractContextManager[Any]) -> tuple[int, int]:
    """Status and `Retry-After`."""
    with pytest.raises((BusyError, TooManyRequestsError)) as refused, opened:
        pass
    return 503 if isinstance(refused.value, BusyError) else 429, refused.value.retry_after or 0


def admission(**limits: Any) -> Admission:
    return Admission(**{"max_request_cost": 30, "max_queued_cost": 120, "max_client_requests": 64, **limits})


def test_one_client_and_all_together_have_only_so_much_open() -> None:
    limit = ConcurrencyLimit(what="things", per_client=2, total=3)
    with limit.acquired("a"), limit.acquired("a"):
        assert refusal(limit.acquired("a")) == (429, 2)
        with limit.acquired("b"):
            assert refusal(limit.acquired("c")) == (503, 2)
        limit.check("c")
        assert limit.open == 2
    with pytest.raises(ValueError, match="inside"), limit.acquired("a"):
        raise ValueError("inside")
    assert limit.open == limit.open_by("a") == 0


def test_each_thing_that_is_counted_has_its_own_limits() -> None:
    gate = admission(max_client_requests=1, max_client_streams=1, max_streams=1, max_queued_cost=1.5 * PASSIVE)
    with gate.streaming("a"), gate.computing("a", Scenario(), ["passive"]), gate.reading("a"), gate.receiving("a"):
        assert gate.load == {"cost": PASSIVE, "wait": 0, "requests": 1, "streams": 1, "bodies": 1}
        assert refusal(gate.streaming("b")) == (503, 2)
        assert refusal(gate.computing("a", Scenario(), ["passive"])) == (429, 2)
        assert refusal(gate.computing("b", Scenario(), ["passive"])) == (503, 2)
        assert refusal(gate.reading("a")) == refusal(gate.admitted("a")) == (429, 2)
        with gate.computing("b", Scenario(), ()), gate.admitted("b"):
            pass
    assert set(gate.load.values()) == {0}
    with gate.computing("a", Scenario(), ["passive"] * 9):
        assert gate.load["cost"] > 1.5 * PASSIVE, "one alone may be as big as a request may be"


def test_a_refusal_comes_before_anything_is_looked_up(service: Any, monkeypatch: pytest.MonkeyPatch) -> None:
    gate = service.app.state.admission
    looked_up: list[str] = []  # `store.read` stays as it is: what drives the batches beside needs it
    monkeypatch.setattr(service.app.state.store.runs, "load", looked_up.append)
    monkeypatch.setattr(service.app.state.store.runs, "load_results", looked_up.extend)
    with ExitStack() as held:
        for _ in range(64):
            held.enter_context(gate.reading("127.0.0.1"))
        for path in ("runs", "live"):
            response = service.client.post(f"/api/v1/{path}", json={"strategies": ["passive"]})
            assert response.status_code == 429
            assert int(response.headers["retry-after"]) > 0
        for client in range(7):
            for _ in range(64):
                held.enter_context(gate.reading(f"192.0.2.{client}"))
        assert refusal(gate.reading("another")) == (503, 2)
    assert not looked_up
    monkeypatch.undo()
    assert service.live(["passive"]).status_code == 200


def test_a_request_that_would_wait_too_long_is_refused_before_its_body_is_read(
    service: Any, client: httpx.Client, monkeypatch: pytest.MonkeyPatch
) -> None:
    gate, now = service.app.state.admission, 0.0
    monkeypatch.setattr(gate, "_backlog", Backlog(workers=1, max_wait=1, clock=lambda: now))
    with ExitStack() as held:
        for _ in range(2):
            held.enter_context(gate.admitted("192.0.2.1"))
        now = 9.5
        assert gate.load["wait"] == 9.5
        answer = client.post("/api/v1/runs", content=b"no JSON", headers={"Content-Type": "application/json"})
        assert (answer.status_code, answer.headers["retry-after"]) == (503, "10")
        assert answer.json()["type"].endswith(":full")
        assert client.get("/api/v1/runs/nobody/figures").status_code == 503
        assert client.get("/api/v1/runs/nobody").status_code == 404, "what is only read is read"
    assert (
        client.post("/api/v1/runs", content=b"no JSON", headers={"Content-Type": "application/json"}).status_code == 400
    )


def test_links_are_limited_by_rate() -> None:
    now = 100.0
    rate = TokenBucket(what="links", burst=3, each_second=0.5, clock=lambda: now)

    def take(client: str) -> int:
        """0, or after how many seconds it may be asked again."""
        try:
            rate.take(client)
        except TooManyRequestsError as error:
            return error.retry_after or 0
        return 0

    assert [take("a") for _ in range(4)] == [0, 0, 0, 2]
    assert take("b") == 0
    now += 1.9
    assert take("a") == 1
    now += 0.2
    assert [take("a"), take("a")] == [0, 2]
    now += 1000
    assert [take("a") for _ in range(4)] == [0, 0, 0, 2]
    assert len(rate._full_at) == 1, "whoever has all again is forgotten"


@given(st.lists(st.floats(0, 5), max_size=60), st.integers(1, 5), st.sampled_from([0.25, 1.0, 4.0]))
def test_a_rate_never_lets_through_more_than_it_says(waits: list[float], burst: int, each_second: float) -> None:
    now, begin, taken = 50.0, 50.0, 0
    rate = TokenBucket(what="links", burst=burst, each_second=each_second, clock=lambda: now)
    for wait in waits:
        now += wait
        try:
            rate.take("a")
        except TooManyRequestsError:
            continue
        taken += 1
        assert taken <= burst + (now - begin) * each_second + 1e-6


@pytest.mark.parametrize(
    ("one", "other", "same"),
    [
        ("192.0.2.1", "192.0.2.1", True),
        ("192.0.2.1", "192.0.2.2", False),
        ("2001:db8::1", "2001:db8::ffff:2", True),
        ("2001:db8:0:1::1", "2001:db8:0:2::1", False),
        ("::ffff:192.0.2.1", "192.0.2.1", True),
        ("fe80::1%eth0", "fe80::2%eth1", True),
        ("", "", True),
        ("unix", "other", False),
    ],
)
def test_an_ipv6_network_is_one_client(one: str, other: str, same: bool) -> None:
    assert (client_key(one) == client_key(other)) is same


def test_no_rounding_stays_of_what_was_open() -> None:
    gate = admission()
    for _ in range(100):
        with gate.computing("a", Scenario(), ["passive"]), gate.computing("b", Scenario(), ["lv"]):
            assert gate.load["cost"] > PASSIVE
    assert gate.load["cost"] == 0


@pytest.fixture
def slow(service: Any, monkeypatch: pytest.MonkeyPatch) -> Any:
    """Workers that answer when they are let; room for four requests of a client and six in all."""
    import asyncio

    gate = admission(max_client_requests=4, max_queued_cost=5.5 * PASSIVE)
    go = threading.Event()
    original = service.app.state.workers.call

    async def wait(*args: Any, **options: Any) -> Any:
        while not go.is_set():
            await asyncio.sleep(0.01)
        return await original(*args, **options)

    monkeypatch.setattr(service.app.state.workers, "call", wait)
    for holder in (service.app.state.runs, service.app.state.runs._results):
        monkeypatch.setattr(holder, "_admission", gate)
    yield gate, go
    go.set()


def test_what_is_too_much_is_refused_at_once_and_what_was_taken_is_answered(service: Any, slow: Any) -> None:
    gate, go = slow

    def ask(seed: int) -> httpx.Response:
        scenario = {"road": {"length": 150, "seed": 9000 + seed}}
        return service.live(["passive"], scenario, points=50)

    with ThreadPoolExecutor(4) as threads:
        taken = [threads.submit(ask, seed) for seed in range(4)]
        wait_until(lambda: gate.load["requests"] == 4, "all of them are taken", 20)
        for seed in range(10, 20):
            refused = ask(seed)
            assert refused.status_code == 429
            assert int(refused.headers["retry-after"]) > 0
            assert service.client.get("/healthz").status_code == 200
        assert service.client.get("/readyz").status_code == 200
        with gate.computing("another", Scenario(), ["passive"]):
            assert gate.load["requests"] == 5
            assert refusal(gate.computing("third", Scenario(), ["passive"])) == (503, 2)
        go.set()
        assert [answer.result().status_code for answer in taken] == [200] * 4
    assert ask(30).status_code == 200
    assert gate.load["cost"] == 0


def test_what_is_stored_is_answered_by_a_full_service(service: Any, run: dict[str, Any], slow: Any) -> None:
    gate, _ = slow
    with gate.computing("a", Scenario(), ["passive"] * 5):
        assert service.run(list(run["strategies"]), run["scenario"]).status_code == 200
        assert service.client.get(f"/api/v1/runs/{run['id']}").status_code == 200
        assert service.client.get("/api/v1/schema").status_code == 200
