"""How long a new request would wait: from the requests in progress and the measured interval of completions."""

import math
import time
from collections import Counter
from collections.abc import Callable, Iterator
from contextlib import contextmanager
from contextvars import ContextVar
from dataclasses import dataclass

from backend.errors import BusyError, TooManyRequestsError
from backend.gate.quota import fair_share

# Least weight of the newest interval in the moving average (test_the_wait_follows_requests_of_another_kind).
MIN_SMOOTHING = 0.1
MAX_RETRY_AFTER = 60  # [s]
SOON = 2  # [s]
# Intervals: the first ones of a burst last as long as the service reads all of it
# (test_the_first_completions_of_a_burst_send_nobody_away_for_long).
RELIABLE = 8


@dataclass(slots=True)
class OpenRequest:
    """A request in progress.

    Attributes:
        client: Who sent it.
        computed: Whether it had to compute anything.
        long: Whether that takes long: then it counts no more.
    """

    client: str
    computed: bool = False
    long: bool = False


_current: ContextVar[OpenRequest | None] = ContextVar("open_request", default=None)


class Backlog:
    """Requests in progress that may compute, but for those known to take long: others do not wait for them.

    Clients take turns, so before a new request come its client's own and as many of each other client. By Little's law
    it waits for that number times the mean interval between two completions. An interval counts only if it ends with a
    request that computed, while all workers were busy: then it is what machine, database and neighbours make of it, and
    neither idle times nor cheap requests distort it.

    Args:
        workers: Processes that compute; a request before which fewer than twice as many come is always admitted.
        max_wait: Longest expected wait with which a request is admitted [s].
        clock: Seconds, monotonic.
    """

    def __init__(self, *, workers: int, max_wait: float, clock: Callable[[], float] = time.monotonic) -> None:
        self._workers = workers
        self._max_wait = max_wait
        self._clock = clock
        self._open: Counter[str] = Counter()  # by client
        self._intervals = 0
        self._mean_interval = 0.0  # between two completions [s]
        self._interval_start = clock()  # the last completion, or the moment at which all workers became busy

    @property
    def expected_wait(self) -> float:
        """How long a request of a new client would wait [s]."""
        return self._wait(len(self._open))

    def check(self, client: str) -> None:
        """Refuse a request that would wait too long.

        Raises:
            TooManyRequestsError: For other requests of its client.
            BusyError: For those of others.
            Both with the time after which those before it will be complete.
        """
        wait = self._wait(fair_share(self._open, client, 1) - 1)
        if wait <= self._max_wait:
            return
        others = len(self._open) - (client in self._open)
        if self._wait(others) <= self._max_wait:
            detail = "This client has used its share: its open requests fill the time that one may wait."
            raise TooManyRequestsError(detail, retry_after=self._retry_after(wait))
        detail = f"The service is full: a request would wait {wait:.1f} s, and may wait {self._max_wait:g} s."
        raise BusyError(detail, retry_after=self._retry_after(wait))

    @contextmanager
    def track(self, client: str) -> Iterator[None]:
        """Count a request of that client as in progress."""
        if self._open.total() <= self._workers:
            self._interval_start = self._clock()
        self._open[client] += 1
        request = OpenRequest(client)
        token = _current.set(request)
        try:
            yield
        finally:
            _current.reset(token)
            if not request.long:
                self._remove(request)
                if request.computed:
                    self._record_completion()
            if not self._open:
                self._intervals, self._mean_interval = 0, 0.0  # the next requests may be of another kind

    def mark_computing(self, *, long: bool) -> None:
        """Mark the current request as one that computes, perhaps for long; without effect where none is tracked."""
        request = _current.get()
        if request is None:
            return
        request.computed = True
        if long and not request.long:
            request.long = True
            self._remove(request)

    def _remove(self, request: OpenRequest) -> None:
        self._open[request.client] -= 1
        if not self._open[request.client]:
            del self._open[request.client]

    def _wait(self, before: float) -> float:
        """How long a request waits before which come so many [s]."""
        if before < 2 * self._workers:
            return 0.0
        return max(self._clock() - self._interval_start, before * self._mean_interval)

    def _record_completion(self) -> None:
        now = self._clock()
        interval, self._interval_start = now - self._interval_start, now
        if self._open.total() < self._workers:
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
