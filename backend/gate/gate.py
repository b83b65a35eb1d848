"""The one gate: named quotas, the expected wait, and the rate of new links decide what is accepted.

So an overload is refused early, no client keeps others waiting, and nobody waits for ever.
"""

import asyncio
import math
import time
from collections.abc import Callable, Iterator
from contextlib import contextmanager
from contextvars import ContextVar
from weakref import WeakValueDictionary

from cachetools import TTLCache

from backend.compute.fair_queue import SHORT
from backend.errors import CHEAPER_RUN, CostLimitError, TooManyRequestsError
from backend.gate.backlog import Backlog
from backend.gate.quotas import quotas
from backend.settings import Settings

MOST_CLIENTS = 10_000  # whose rates are remembered


class TokenBucket:
    """A rate limit for each client: a burst, then so many each second.

    Args:
        what: Its name in the refusal.
        burst: How many tokens a client has at first, and at most.
        each_second: How many tokens are added [1/s].
        clock: Seconds, monotonic.
    """

    def __init__(
        self, *, what: str, burst: int, each_second: float, clock: Callable[[], float] = time.monotonic
    ) -> None:
        self._what = what
        self._burst = burst
        self._each_second = each_second
        self._clock = clock
        # By client when its bucket is full again; after that it is as good as unknown.
        self._full_at: TTLCache[str, float] = TTLCache(MOST_CLIENTS, burst / each_second, clock)

    def take(self, client: str, tokens: int = 1) -> None:
        """Take a token, or several.

        Raises:
            TooManyRequestsError: With the time after which there is a token again.
        """
        now = self._clock()
        full_at = max(now, self._full_at.get(client, now)) + tokens / self._each_second
        wait = full_at - now - self._burst / self._each_second
        if wait > 1e-9:
            message = f"Too many {self._what}: {self._burst} at once, then {self._each_second:g} a second."
            raise TooManyRequestsError(message, retry_after=max(1, math.ceil(wait)))
        self._full_at[client] = full_at


# A browser asks a server for six at once. Each step of another client's request waits for a step of every read begun.
READS_AT_ONCE = 8
MOST_LINK_TOKENS, LINK_TOKENS_EACH_SECOND = 120, 2  # of one client; a link takes no more, however much it pins
_computing: ContextVar[bool] = ContextVar("computing", default=False)  # whether what follows is counted already


class Gate:
    """Counts what is open, for each client and in all.

    What is over a limit raises a TemporaryError: TooManyRequestsError (429) where the client has used its share,
    BusyError (503) where the service as a whole is full.

    Attributes:
        quotas: By name.
    """

    def __init__(self, settings: Settings) -> None:
        self.quotas = quotas(settings)
        self._open: dict[str, dict[str, float]] = {name: {} for name in self.quotas}  # by quota and client
        self._max_request_cost = settings.max_request_cost
        self._backlog = Backlog(workers=settings.workers, max_wait=settings.max_wait)
        self._reads: WeakValueDictionary[str, asyncio.Semaphore] = WeakValueDictionary()  # by client
        self._links = TokenBucket(what="new links", burst=MOST_LINK_TOKENS, each_second=LINK_TOKENS_EACH_SECOND)

    @property
    def load(self) -> dict[str, float]:
        """`cost` [s of one core] in progress; expected `wait` [s]; `requests`, `streams`, long `bodies` open."""
        return {
            "cost": self.open("cost"),
            "wait": self._backlog.expected_wait,
            "requests": self.open("computing"),
            "streams": self.open("streams"),
            "bodies": self.open("bodies"),
        }

    def open(self, name: str) -> float:
        """How much of that quota is open."""
        return sum(self._open[name].values())

    def check(self, client: str, **amounts: float) -> None:
        """Refuse where so much more of these quotas, by name, would be over a limit; raises a TemporaryError."""
        for name, more in amounts.items():
            refusal = self.quotas[name].refusal(self._open[name], client, more)
            if refusal is not None:
                raise refusal

    @contextmanager
    def hold(self, client: str, **amounts: float) -> Iterator[None]:
        """Count so much of these quotas, by name, for the length of the block; raises what `check` raises."""
        self.check(client, **amounts)
        for name, amount in amounts.items():
            self._open[name][client] = self._open[name].get(client, 0.0) + amount
        try:
            yield
        finally:
            for name, amount in amounts.items():
                left = self._open[name].pop(client, 0.0) - amount  # there is none where all that is open costs nothing
                if left > 1e-9:  # else it is rounding
                    self._open[name][client] = left

    def check_cost(self, cost: float) -> None:
        """Refuse a request whose estimated cost [s of one core] is too large for any client; raises CostLimitError."""
        if cost > self._max_request_cost:
            raise CostLimitError(
                f"The estimated cost of {cost:.3g} s of computing is over the limit of {self._max_request_cost:g} s "
                f"a request; fewer roads, {CHEAPER_RUN}",
                pointer="/scenario",
            )

    def check_admission(self, client: str) -> None:
        """Refuse a request that may compute before any work on it, so that refusals cost next to nothing."""
        self.check(client, requests=1)
        self._backlog.check(client)

    @contextmanager
    def admitted(self, client: str) -> Iterator[None]:
        """Admit a request that may compute, from before its body is parsed to its answer.

        A lookup in the database costs much more than a refusal: without this limit a flood would keep the database's
        threads from the requests that were admitted.
        """
        self.check_admission(client)
        with self.hold(client, requests=1), self._backlog.track(client):
            yield

    @contextmanager
    def computing(self, client: str, cost: float, **more: float) -> Iterator[None]:
        """Count a computation of that client, of that estimated cost [s of one core], and so much of further quotas.

        Inside it others are part of it: what was admitted as a whole is not refused half way.
        """
        if _computing.get():
            yield
            return
        with self.hold(client, computing=1, cost=cost, **more):
            self._backlog.mark_computing(long=cost > SHORT)
            token = _computing.set(True)
            try:
                yield
            finally:
                _computing.reset(token)

    def reading(self, client: str) -> asyncio.Semaphore:
        """Places for requests of that client that only read; one that finds none waits until another is answered."""
        return self._reads.setdefault(client, asyncio.Semaphore(READS_AT_ONCE))

    def linking(self, client: str, *, links: int = 1, pinned: int = 0) -> None:
        """Count new links of that client, and the strategies whose time histories they pin (0.8 MB each).

        Links are kept for ever, so nobody makes them by the thousand. Whoever has made none lately is never refused.
        """
        self._links.take(client, min(MOST_LINK_TOKENS, links + 3 * pinned))
