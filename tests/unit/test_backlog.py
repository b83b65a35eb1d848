"""How long a new request would wait, by how quickly others complete; and which are refused for it."""

from collections.abc import Iterator
from contextlib import ExitStack

import pytest

from backend.errors import BusyError, TooManyRequestsError
from backend.gate.backlog import Backlog

INTERVAL = 0.1  # between two completions while others wait [s]


class Requests:
    """Requests in progress; they complete in the order in which they arrived."""

    def __init__(self, max_wait: float = 2.0) -> None:
        self.now = 100.0
        self.backlog = Backlog(workers=2, max_wait=max_wait, clock=lambda: self.now)
        self._open: list[ExitStack] = []

    def arrive(self, count: int = 1, client: str = "a", *, computing: bool = True, long: bool = False) -> None:
        for _ in range(count):
            stack = ExitStack()
            stack.enter_context(self.backlog.track(client))
            if computing:
                self.backlog.mark_computing(long=long)
            self._open.append(stack)

    def arrive_from_everywhere(self, clients: int) -> None:
        for client in range(clients):
            self.arrive(client=f"client {client}")

    def complete(self, count: int = 1, *, after: float = INTERVAL) -> None:
        for _ in range(count):
            self.now += after
            self._open.pop(0).close()

    def refusal(self, client: str = "a") -> tuple[int, int]:
        """Status and `Retry-After` of a new request of that client."""
        with pytest.raises((BusyError, TooManyRequestsError)) as refused:
            self.backlog.check(client)
        return 503 if isinstance(refused.value, BusyError) else 429, refused.value.retry_after or 0


@pytest.fixture
def requests() -> Iterator[Requests]:
    requests = Requests()
    yield requests
    requests.complete(len(requests._open))


def test_a_new_request_waits_for_its_clients_others(requests: Requests) -> None:
    requests.arrive(30)
    requests.complete(15)
    requests.backlog.check("a")
    requests.arrive(15)
    assert requests.refusal() == (429, 3), "30 at 0.1 s each"
    requests.complete(12)
    requests.backlog.check("a")  # room again as soon as the wait is short again


def test_of_other_clients_only_as_many_come_before_as_a_client_has_itself(requests: Requests) -> None:
    requests.arrive(60, client="greedy")
    requests.complete(30)
    assert requests.refusal("greedy") == (429, 3)
    for _ in range(10):
        requests.backlog.check("other")
        requests.arrive(client="other")
    requests.arrive(client="other")
    assert requests.refusal("other") == (429, 3), "22 of both: its eleven, and as many of the greedy one"
    requests.backlog.check("third")


def test_many_clients_fill_the_service(requests: Requests) -> None:
    requests.arrive_from_everywhere(40)
    requests.complete(15)
    assert requests.backlog.expected_wait == pytest.approx(25 * INTERVAL, rel=0.1)
    assert requests.refusal("another") == requests.refusal("client 39") == (503, 3)
    requests.complete(10)
    requests.backlog.check("another")


def test_twice_the_workers_are_admitted_and_no_more_while_nothing_completes(requests: Requests) -> None:
    requests.arrive(3)
    requests.complete(after=60)
    requests.arrive(1)
    requests.now += 100
    requests.backlog.check("a")  # fewer than twice the workers
    requests.arrive(1)
    assert requests.refusal() == (429, 60), "nothing completed for so long"
    requests.backlog.check("b")


def test_what_takes_long_keeps_nobody_out(requests: Requests) -> None:
    requests.arrive_from_everywhere(10)
    requests.arrive(10, long=True)
    requests.complete(10)
    requests.now += 100
    requests.backlog.check("another")
    assert requests.backlog.expected_wait == 0


def test_the_first_completions_of_a_burst_send_nobody_away_for_long(requests: Requests) -> None:
    requests.arrive_from_everywhere(90)
    requests.complete(after=1.0)  # while it was completed, all of them were read
    assert requests.backlog.expected_wait > 40
    assert requests.refusal("another") == (503, 2)


def test_what_does_not_compute_says_nothing_of_the_wait(requests: Requests) -> None:
    requests.arrive_from_everywhere(24)
    requests.complete(4)
    before = requests.backlog.expected_wait / 20
    for client in range(100):
        requests.arrive(client=f"reader {client}", computing=False)
    requests.complete(20)
    requests.complete(90, after=0)
    assert requests.backlog.expected_wait / 10 == pytest.approx(before, rel=0.2)


def test_the_wait_follows_requests_of_another_kind(requests: Requests) -> None:
    requests.arrive_from_everywhere(1000)
    requests.complete(900, after=INTERVAL / 10)
    requests.complete(40, after=INTERVAL)
    assert requests.backlog.expected_wait == pytest.approx(60 * INTERVAL, rel=0.1)
