"""How long a newcomer would wait, from what leaves; and who is refused for it."""

from collections.abc import Iterator
from contextlib import ExitStack

import pytest

from backend.backlog import Backlog, computes
from backend.problems import ProblemError

SERVICE = 0.1  # one that computes leaves so often while others wait [s]


class Clock:
    def __init__(self) -> None:
        self.now = 100.0

    def __call__(self) -> float:
        return self.now


class Crowd:
    """Requests inside; they leave in the order in which they came."""

    def __init__(self, max_wait: float = 2.0) -> None:
        self.clock = Clock()
        self.backlog = Backlog(workers=2, max_wait=max_wait, clock=self.clock)
        self._inside: list[ExitStack] = []

    def come(self, count: int = 1, *, computing: bool = True) -> None:
        for _ in range(count):
            stack = ExitStack()
            stack.enter_context(self.backlog.visit())
            if computing:
                computes()
            self._inside.append(stack)

    def leave(self, count: int = 1, *, after: float = SERVICE) -> None:
        for _ in range(count):
            self.clock.now += after
            self._inside.pop(0).close()

    def refusal(self, own: int = 0) -> tuple[int, int]:
        """Status and `Retry-After` of a newcomer whose client has so many inside."""
        with pytest.raises(ProblemError) as refused:
            self.backlog.check(own)
        return refused.value.status_code, int((refused.value.headers or {})["Retry-After"])


@pytest.fixture
def crowd() -> Iterator[Crowd]:
    crowd = Crowd()
    yield crowd
    crowd.leave(len(crowd._inside))


def test_a_newcomer_waits_for_those_inside(crowd: Crowd) -> None:
    crowd.come(30)
    crowd.leave(15)
    assert crowd.backlog.wait == pytest.approx(15 * SERVICE, rel=0.1)
    crowd.backlog.check(0)
    crowd.come(15)
    assert crowd.refusal() == (503, 3)
    crowd.leave(12)
    crowd.backlog.check(0)  # room again as soon as the wait is short again


def test_who_is_always_let_in_finds_others_computing_too(crowd: Crowd) -> None:
    crowd.come(3)
    crowd.leave(after=60)
    crowd.come(1)
    crowd.clock.now += 100
    crowd.backlog.check(0)  # fewer than twice the workers
    crowd.come(1)
    assert crowd.refusal() == (503, 60), "nothing left for so long"


def test_what_does_not_compute_says_nothing_of_the_wait(crowd: Crowd) -> None:
    crowd.come(24)
    crowd.leave(4)
    before = crowd.backlog.wait / 20
    crowd.come(100, computing=False)
    crowd.leave(20)
    crowd.leave(90, after=0)
    assert crowd.backlog.wait / 10 == pytest.approx(before, rel=0.2)


def test_idle_times_say_nothing_of_the_wait(crowd: Crowd) -> None:
    crowd.come()
    for _ in range(20):
        crowd.come()
        crowd.leave(after=30)
    crowd.come(10)
    crowd.backlog.check(0)


def test_one_client_fills_half_of_what_may_wait(crowd: Crowd) -> None:
    crowd.come(25)
    crowd.leave(10)
    assert crowd.refusal(own=15) == (429, 2)
    crowd.backlog.check(2)


def test_a_client_with_few_requests_fills_nothing(crowd: Crowd) -> None:
    crowd.come(6)
    crowd.leave(2, after=0.4)
    assert crowd.refusal(own=4) == (429, 2)
    crowd.backlog.check(3)
