"""How long a new request would wait, by how quickly others complete; and which are refused for it."""

from collections.abc import Iterator
from contextlib import ExitStack

import pytest

from backend.errors import BusyError, TooManyRequestsError
from backend.http.backlog import Backlog, mark_computing

INTERVAL = 0.1  # between two completions while others wait [s]


class Requests:
    """Requests in progress; they complete in the order in which they arrived."""

    def __init__(self, max_wait: float = 2.0) -> None:
        self.now = 100.0
        self.backlog = Backlog(workers=2, max_wait=max_wait, clock=lambda: self.now)
        self._open: list[ExitStack] = []

    def arrive(self, count: int = 1, *, computing: bool = True) -> None:
        for _ in range(count):
            stack = ExitStack()
            stack.enter_context(self.backlog.track())
            if computing:
                mark_computing()
            self._open.append(stack)

    def complete(self, count: int = 1, *, after: float = INTERVAL) -> None:
        for _ in range(count):
            self.now += after
            self._open.pop(0).close()

    def refusal(self, own: int = 0) -> tuple[int, int]:
        """Status and `Retry-After` of a new request whose client has so many open."""
        with pytest.raises((BusyError, TooManyRequestsError)) as refused:
            self.backlog.check(own)
        return 503 if isinstance(refused.value, BusyError) else 429, refused.value.retry_after or 0


@pytest.fixture
def requests() -> Iterator[Requests]:
    requests = Requests()
    yield requests
    requests.complete(len(requests._open))


def test_a_new_request_waits_for_those_in_progress(requests: Requests) -> None:
    requests.arrive(30)
    requests.complete(15)
    assert requests.backlog.expected_wait == pytest.approx(15 * INTERVAL, rel=0.1)
    requests.backlog.check(0)
    requests.arrive(15)
    assert requests.refusal() == (503, 3)
    requests.complete(12)
    requests.backlog.check(0)  # room again as soon as the wait is short again


def test_twice_the_workers_are_admitted_and_no_more_while_nothing_completes(requests: Requests) -> None:
    requests.arrive(3)
    requests.complete(after=60)
    requests.arrive(1)
    requests.now += 100
    requests.backlog.check(0)  # fewer than twice the workers
    requests.arrive(1)
    assert requests.refusal() == (503, 60), "nothing completed for so long"


def test_the_first_completions_of_a_burst_send_nobody_away_for_long(requests: Requests) -> None:
    requests.arrive(90)
    requests.complete(after=1.0)  # while it was completed, all of them were read
    assert requests.backlog.expected_wait > 40
    assert requests.refusal() == (503, 2)


def test_what_does_not_compute_says_nothing_of_the_wait(requests: Requests) -> None:
    requests.arrive(24)
    requests.complete(4)
    before = requests.backlog.expected_wait / 20
    requests.arrive(100, computing=False)
    requests.complete(20)
    requests.complete(90, after=0)
    assert requests.backlog.expected_wait / 10 == pytest.approx(before, rel=0.2)


def test_one_client_fills_half_of_what_may_wait(requests: Requests) -> None:
    requests.arrive(25)
    requests.complete(10)
    assert requests.refusal(own=15) == (429, 2)
    requests.backlog.check(2)
    requests.arrive(15)  # now the wait is too long for everybody, and whose requests they are is said all the same
    assert requests.refusal(own=30) == (429, 3)
    assert requests.refusal(own=2) == (503, 3)


def test_a_client_with_few_requests_fills_nothing(requests: Requests) -> None:
    requests.arrive(6)
    requests.complete(2, after=0.4)
    assert requests.refusal(own=4) == (429, 2)
    requests.backlog.check(3)
