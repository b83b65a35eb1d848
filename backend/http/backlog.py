"""How long a new request would wait: from the requests in progress and the measured interval of completions."""

import math
import time
from collections.abc import Callable, Iterator
from contextlib import contextmanager
from contextvars import ContextVar
from dataclasses import dataclass

from backend.errors import BusyError, TooManyRequestsError

MIN_SMOOTHING = 0.1  # weight of the newest interval in the moving average
MAX_RETRY_AFTER = 60  # [s]
SOON = 2  # [s]
RELIABLE = 8  # intervals: the first ones of a burst last as long as the service reads all of it


@dataclass(slots=True)
class OpenRequest:
    """A request in progress; `computed` once it had to compute anything."""

    computed: bool = False


_current: ContextVar[OpenRequest | None] = ContextVar("open_request", default=None)


class Backlog:
    """Requests in progress that may compute.

    By Little's law a new request waits for the number of requests in progress times the mean interval between two
    completions. An interval counts only if it ends with a request that computed, while all workers were busy: then it
    is what machine, database and neighbours make of it, and neither idle times nor cheap requests distort it.

    Args:
        workers: Processes that compute; while fewer than twice as many requests are open, all are admitted.
        max_wait: Longest expected wait with which a request is admitted; one client with at least twice as many
            requests open as there are workers may cause half of it [s].
        clock: Seconds, monotonic.
    """

    def __init__(self, *, workers: int, max_wait: float, clock: Callable[[], float] = time.monotonic) -> None:
        self._workers = workers
        self._max_wait = max_wait
        self._clock = clock
        self._open = 0
        self._intervals = 0
        self._mean_interval = 0.0  # between two completions [s]
        self._interval_start = clock()  # the last completion, or the moment at which all workers became busy

    @property
    def expected_wait(self) -> float:
        """How long a new request would wait [s]."""
        if self._open <= self._workers:
            return 0.0
        since_completion = self._clock() - self._interval_start
        return max(since_completion, self._open * self._mean_interval)

    def check(self, open_of_client: int) -> None:
        """Refuse a request that would wait too long, or whose client already causes half of the longest wait.

        Raises:
            BusyError, TooManyRequestsError: With the time after which those in progress will be complete.
        """
        few = 2 * self._workers
        if self._open < few:
            return
        wait, own = self.expected_wait, open_of_client * self._mean_interval
        if own > self._max_wait / 2 and open_of_client >= few:
            detail = "This client's open requests already fill half of what may wait."
            raise TooManyRequestsError(detail, retry_after=self._retry_after(own))
        if wait > self._max_wait:
            detail = f"The service is full: a request would wait {wait:.1f} s, and may wait {self._max_wait:g} s."
            raise BusyError(detail, retry_after=self._retry_after(wait))

    @contextmanager
    def track(self) -> Iterator[None]:
        """Count a request as in progress."""
        if self._open <= self._workers:
            self._interval_start = self._clock()
        self._open += 1
        request = OpenRequest()
        token = _current.set(request)
        try:
            yield
        finally:
            _current.reset(token)
            self._open -= 1
            if request.computed:
                self._record_completion()
            if not self._open:
                self._intervals, self._mean_interval = 0, 0.0  # the next requests may be of another kind

    def _record_completion(self) -> None:
        now = self._clock()
        interval, self._interval_start = now - self._interval_start, now
        if self._open < self._workers:
            return  # a worker was idle: the interval tells how often requests arrive, not how quickly they complete
        self._intervals += 1
        if self._intervals == 1:
            interval /= self._workers  # as many began together
        self._mean_interval += max(MIN_SMOOTHING, 1 / self._intervals) * (interval - self._mean_interval)

    def _retry_after(self, wait: float) -> int:
        """That wait in whole seconds; short while too few have completed to estimate it, unless none does."""
        if self._intervals < RELIABLE:
            wait = min(wait, max(SOON, self._clock() - self._interval_start))
        return min(MAX_RETRY_AFTER, max(1, math.ceil(wait)))


def mark_computing() -> None:
    """Mark the current request as one that computes; without effect where none is tracked."""
    request = _current.get()
    if request is not None:
        request.computed = True
