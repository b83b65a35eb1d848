"""How often one client may do what is stored for ever."""

import math
import time
from collections.abc import Callable

from cachetools import TTLCache

from backend.errors import TooManyRequestsError

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
        self.burst = burst
        self.each_second = each_second
        self._what = what
        self._clock = clock
        # By client when its bucket is full again; after that it is as good as unknown.
        self._full_at: TTLCache[str, float] = TTLCache(MOST_CLIENTS, burst / each_second, clock)

    def take(self, client: str, tokens: int = 1) -> None:
        """Take tokens, at most the whole burst.

        Raises:
            TooManyRequestsError: With the time after which there are as many again.
        """
        now = self._clock()
        full_at = max(now, self._full_at.get(client, now)) + min(tokens, self.burst) / self.each_second
        wait = full_at - now - self.burst / self.each_second
        if wait > 1e-9:
            message = f"Too many {self._what}: {self.burst} at once, then {self.each_second:g} a second."
            raise TooManyRequestsError(message, retry_after=max(1, math.ceil(wait)))
        self._full_at[client] = full_at
