"""How long a request would wait, by what is inside and how quickly that leaves: measured, not estimated."""

import math
import time
from collections.abc import Callable, Iterator
from contextlib import contextmanager
from contextvars import ContextVar
from dataclasses import dataclass

from backend.problems import ProblemError

LEAST_WEIGHT = 0.1  # of the newest interval between two that leave, in their mean
LONGEST_TOLD = 60  # Retry-After at most [s]


@dataclass(slots=True)
class Visit:
    """One request inside; `computed` once it had to compute anything."""

    computed: bool = False


_visit: ContextVar[Visit | None] = ContextVar("visit", default=None)


class Backlog:
    """Requests that may compute, from the door to the answer.

    A newcomer waits for as many as are inside, each for the time between two that leave (Little's law). That time is
    taken only while more are inside than there are workers, and of requests that did compute: so it is what machine,
    database and neighbours make of it, and neither idle times nor cheap requests make it wrong.

    Args:
        workers: Processes that compute; twice as many requests are always let in.
        max_wait: Longest wait a newcomer is let in for; one client with more than a few inside may fill half of it [s].
        clock: Seconds, monotonic.
    """

    def __init__(self, *, workers: int, max_wait: float, clock: Callable[[], float] = time.monotonic) -> None:
        self._workers = workers
        self._max_wait = max_wait
        self._clock = clock
        self._inside = 0
        self._intervals = 0
        self._interval = 0.0  # between two that leave, the mean of the last ones [s]
        self._since = clock()  # the last one left, or more were inside than workers

    @property
    def wait(self) -> float:
        """How long a newcomer would wait [s]."""
        if self._inside <= self._workers:
            return 0.0
        stalled = self._clock() - self._since
        return max(stalled, self._inside * self._interval)

    def check(self, inside_of_client: int) -> None:
        """Refuse who would wait too long, and a client whose own requests fill half of that wait.

        Raises:
            ProblemError: 503 or 429, with the time after which those inside will have left.
        """
        few = 2 * self._workers
        if self._inside < few:
            return
        wait, own = self.wait, inside_of_client * self._interval
        if wait > self._max_wait:
            detail = f"The service is full: a request would wait {wait:.1f} s, and may wait {self._max_wait:g} s."
            raise ProblemError(503, detail, kind="full", retry_after=_told(wait))
        if own > self._max_wait / 2 and inside_of_client >= few:
            detail = "This client's open requests already fill half of what may wait."
            raise ProblemError(429, detail, kind="too-many-requests", retry_after=_told(own))

    @contextmanager
    def visit(self) -> Iterator[None]:
        """Be inside."""
        if self._inside <= self._workers:
            self._since = self._clock()
        self._inside += 1
        visit = Visit()
        outer = _visit.set(visit)
        try:
            yield
        finally:
            _visit.reset(outer)
            self._inside -= 1
            if visit.computed:
                self._measure()
            if not self._inside:
                self._intervals, self._interval = 0, 0.0  # the next ones may be of another kind

    def _measure(self) -> None:
        """One that computed has left."""
        now = self._clock()
        took, self._since = now - self._since, now
        if self._inside < self._workers:
            return  # nobody waited: it tells how often requests come, not how quickly they leave
        self._intervals += 1
        if self._intervals == 1:
            took /= self._workers  # as many began together
        self._interval += max(LEAST_WEIGHT, 1 / self._intervals) * (took - self._interval)


def computes() -> None:
    """Tell that the present request, if it is one inside, computes."""
    visit = _visit.get()
    if visit is not None:
        visit.computed = True


def _told(wait: float) -> int:
    return min(LONGEST_TOLD, max(1, math.ceil(wait)))
