"""Which requests are admitted: limits for one client and for all, and what a refusal says."""

from collections import Counter
from contextlib import AbstractContextManager, ExitStack
from typing import Any

import pytest

from backend.errors import BusyError, TooManyRequestsError
from backend.gate import Gate
from backend.gate.backlog import Backlog
from backend.gate.gate import READS_AT_ONCE, TokenBucket
from backend.gate.quota import Quota
from backend.http.client_key import client_key
from backend.settings import Settings
from tests.servers.process import HANG_TIMEOUT, wait_until


def refusal(opened: AbstractContextManager[Any]) -> tuple[int, int]:
    """Status and `Retry-After`."""
    with pytest.raises((BusyError, TooManyRequestsError)) as refused, opened:
        pass
    return 503 if isinstance(refused.value, BusyError) else 429, refused.value.retry_after or 0


def gate_with(**quotas: Quota) -> Gate:
    """A gate with these quotas in place of its own."""
    gate = Gate(Settings())
    gate.quotas.update(quotas)
    return gate


def test_one_client_and_all_together_have_only_so_much_open() -> None:
    gate = gate_with(streams=Quota(what="things", taken_by="", per_client=2, total=3))
    with gate.hold("a", streams=1), gate.hold("a", streams=1):
        assert refusal(gate.hold("a", streams=1)) == (429, 2)
        with gate.hold("b", streams=1):
            assert refusal(gate.hold("c", streams=1)) == (503, 2)
            assert refusal(gate.hold("c", bodies=1, streams=1)) == (503, 2)
            assert gate.open("bodies") == 0, "all of them or none"
        gate.check("c", streams=1)
        assert gate.open("streams") == 2
    with pytest.raises(ValueError, match="inside"), gate.hold("a", streams=1):
        raise ValueError("inside")
    assert gate.open("streams") == 0


def test_each_thing_that_is_counted_has_its_own_limits() -> None:
    gate = Gate(Settings(max_client_requests=1, max_client_streams=1, max_streams=1, max_queued_cost=1.5))
    with gate.hold("a", streams=1, computing=1, cost=1.0, requests=1, bodies=1):
        assert gate.load == {"cost": 1.0, "wait": 0, "requests": 1, "streams": 1, "bodies": 1}
        assert refusal(gate.hold("b", streams=1)) == (503, 2)
        assert refusal(gate.computing("a", 1.0)) == (429, 2)
        assert refusal(gate.computing("b", 1.0)) == (503, 2)
        assert refusal(gate.hold("a", requests=1)) == refusal(gate.admitted("a")) == (429, 2)
        with gate.computing("b", 0.5), gate.admitted("b"):
            pass
    assert set(gate.load.values()) == {0}
    with gate.computing("a", 9.0):
        assert gate.load["cost"] == 9.0, "one alone may be as big as a request may be"


def test_what_costs_nothing_ends_after_what_costs_something() -> None:
    """Both are one client's: the first to end leaves nothing open, and nothing for the other to take away."""
    gate = Gate(Settings())
    first, second = gate.computing("a", 0.0), gate.hold("a", cost=5.0)
    for block in (first, second):
        block.__enter__()
    for block in (second, first):
        block.__exit__(None, None, None)
    assert gate.open("cost") == gate.open("computing") == 0


def test_a_greedy_client_fills_its_own_share_of_the_cost() -> None:
    gate = gate_with(cost=Quota(what="computing", taken_by="", total=10, fair=True))
    with ExitStack() as held:
        for _ in range(10):
            held.enter_context(gate.hold("greedy", cost=1))
        assert refusal(gate.hold("greedy", cost=1)) == (429, 2)
        for _ in range(5):
            held.enter_context(gate.hold("b", cost=1))
        assert refusal(gate.hold("b", cost=1)) == (429, 2)
        for client in range(10):
            held.enter_context(gate.hold(f"small {client}", cost=0.5))
        assert refusal(gate.hold("large", cost=5)) == (503, 2)
        held.enter_context(gate.hold("small", cost=0.5))
    assert gate.open("cost") == 0


def test_what_was_admitted_as_a_whole_is_not_refused_half_way() -> None:
    gate = Gate(Settings(max_client_requests=1))
    with gate.computing("a", 100.0):
        with gate.computing("a", 100.0):
            assert gate.load["cost"] == 100.0
        assert refusal(gate.hold("a", computing=1)) == (429, 2)
    with gate.computing("a", 100.0):
        pass


def test_a_refusal_comes_before_anything_is_looked_up(service: Any, monkeypatch: pytest.MonkeyPatch) -> None:
    gate = service.services.gate
    looked_up: list[str] = []  # `store.read` stays as it is: what drives the batches beside needs it
    monkeypatch.setattr(service.services.store.runs, "load", looked_up.append)
    monkeypatch.setattr(service.services.store.runs, "load_results", looked_up.extend)
    with ExitStack() as held:
        for _ in range(64):
            held.enter_context(gate.hold("127.0.0.1", requests=1))
        for path in ("runs", "live"):
            response = service.post(f"/api/v1/{path}", json={"strategies": ["passive"]})
            assert response.status_code == 429
            assert int(response.headers["retry-after"]) > 0
        held.enter_context(gate.hold("192.0.2.1", requests=1))
    assert not looked_up
    monkeypatch.undo()
    assert service.live(["passive"]).status_code == 200


def test_a_request_that_would_wait_too_long_is_refused_before_its_body_is_read(
    service: Any, monkeypatch: pytest.MonkeyPatch
) -> None:
    gate, now = service.services.gate, 0.0
    monkeypatch.setattr(gate, "_backlog", Backlog(workers=1, max_wait=1, clock=lambda: now))
    with ExitStack() as held:
        for number in range(2):
            held.enter_context(gate.admitted(f"192.0.2.{number}"))
        now = 9.5
        assert gate.load["wait"] == 9.5
        answer = service.post("/api/v1/runs", content=b"no JSON", headers={"Content-Type": "application/json"})
        assert (answer.status_code, answer.headers["retry-after"]) == (503, "10")
        assert answer.json()["type"].endswith(":full")
        assert service.get("/api/v1/runs/nobody/figures").status_code == 503
        assert service.get("/api/v1/runs/nobody").status_code == 404, "what is only read is read"
    assert (
        service.post("/api/v1/runs", content=b"no JSON", headers={"Content-Type": "application/json"}).status_code
        == 400
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


def test_a_link_with_every_pin_can_be_made_from_a_full_bucket() -> None:
    limits = Gate(Settings())
    limits.linking("a", links=9, pinned=9 * 5)
    with pytest.raises(TooManyRequestsError):
        limits.linking("a")
    limits.linking("b", links=9, pinned=30)
    with pytest.raises(TooManyRequestsError):
        limits.linking("b", links=9, pinned=30)
    limits.linking("b", links=9)  # what is refused takes nothing


@pytest.mark.parametrize(
    ("address", "key"),
    [
        ("192.0.2.1", "192.0.2.1"),
        ("2001:db8:0:1::ffff:2", "2001:db8:0:1::"),
        ("::ffff:192.0.2.1", "192.0.2.1"),
        ("fe80::1%eth0", "fe80::"),
        ("", ""),
        ("unix", "unix"),
    ],
)
def test_an_ipv6_network_is_one_client(address: str, key: str) -> None:
    assert client_key(address) == key


def test_downloads_tables_figures_and_reports_count_like_runs(service: Any, run: dict[str, Any]) -> None:
    gate, client = service.services.gate, service
    heights = "distance [m],height [mm]\n" + "".join(f"{0.1 * step:.1f},{step % 7}\n" for step in range(500))
    road = client.post("/api/v1/roads", content=heights, headers={"Content-Type": "text/csv"})
    asked = {"scenario": run["scenario"], "strategies": ["passive"], "sweep": {"grid": {"road.bump.height": [0.01]}}}
    batch = client.post("/api/v1/batches", json=asked).json()
    paths = [
        f"roads/{road.json()['id']}",
        f"roads/{road.json()['id']}?format=csv",
        *(f"batches/{batch['id']}/results?format={each}" for each in ("json", "csv")),
        f"batches/{batch['id']}/table",
        *(f"runs/{run['id']}/series?strategy=lv&format={each}" for each in ("json", "csv")),
        f"runs/{run['id']}/figures",
        f"runs/{run['id']}/figures/speed",
        f"runs/{run['id']}/report.html",
    ]
    with ExitStack() as held:
        for _ in range(64):
            held.enter_context(gate.hold("127.0.0.1", computing=1))
        for path in paths:
            assert client.get(f"/api/v1/{path}").status_code == 429, path
    for path in paths:
        assert client.get(f"/api/v1/{path}").status_code == 200, path
    wait_until(lambda: gate.load["requests"] == 0, "each is over once it was sent")
    with gate.hold("127.0.0.1", reports=2):
        assert client.get(f"/api/v1/runs/{run['id']}/report.html").status_code == 429
        gate.check("192.0.2.1", reports=1)


def test_a_full_service_answers_what_is_stored_and_for_health(service: Any, run: dict[str, Any]) -> None:
    gate, new = service.services.gate, {"road": {"length": 150, "seed": 9001}}
    with ExitStack() as held:
        for _ in range(64):
            held.enter_context(gate.hold("127.0.0.1", computing=1))
        refused = service.live(["passive"], new)
        assert (refused.status_code, int(refused.headers["retry-after"]) > 0) == (429, True)
        assert service.run(list(run["strategies"]), run["scenario"]).status_code == 200
        for path in (f"/api/v1/runs/{run['id']}", "/api/v1/schema", "/healthz", "/readyz"):
            assert service.get(path).status_code == 200
    assert service.live(["passive"], new).status_code == 200


def test_of_one_clients_lists_some_are_made_at_a_time_and_nothing_else_waits_for_them(
    service: Any, run: dict[str, Any], monkeypatch: pytest.MonkeyPatch
) -> None:
    services = service.services
    turns, batches, pages = services.gate.reading("127.0.0.1"), services.batches, Counter[str]()
    page = batches.page

    async def counted(**options: Any) -> Any:
        pages["made"] += 1
        return await page(**options)

    async def take() -> None:
        for _ in range(READS_AT_ONCE):
            await turns.acquire()

    async def give_back() -> None:
        for _ in range(READS_AT_ONCE):
            turns.release()

    async def waiting() -> int:
        return len(turns._waiters or ())  # a semaphore has no public way to ask

    monkeypatch.setattr(type(batches), "page", lambda self, **options: counted(**options))
    service.inside(take())
    with service.begun("GET", "/api/v1/batches") as left, service.begun("GET", "/api/v1/batches") as stays:
        wait_until(lambda: service.inside(waiting()) == 2, "both wait for their turn")
        assert service.run(list(run["strategies"]), run["scenario"]).status_code == 200
        assert service.get(f"/api/v1/runs/{run['id']}").status_code == 200
        assert not services.gate.reading("127.0.0.2").locked()
        left.close()
        wait_until(lambda: service.inside(waiting()) == 1, "who has gone waits no more")
        service.inside(give_back())
        stays.settimeout(HANG_TIMEOUT)
        assert stays.recv(12) == b"HTTP/1.1 200"
    assert pages["made"] == 1
