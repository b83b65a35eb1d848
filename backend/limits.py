"""Limits for one client and for all: how many at once, how many a second, and who counts as one client."""

import ipaddress
import math
import time
from collections import Counter
from collections.abc import Callable, Iterator
from contextlib import contextmanager

from backend.problems import ProblemError

RETRY_AFTER = 2  # [s]
NETWORK = 64  # of IPv6 one customer gets 2^64 addresses


class ConcurrencyLimit:
    """A number of places, so many of them for one client."""

    def __init__(self, *, what: str, per_client: int, total: int | None = None) -> None:
        self._what = what
        self._per_client = per_client
        self._total = total
        self._held: Counter[str] = Counter()

    @property
    def held(self) -> int:
        """Places taken now."""
        return self._held.total()

    def held_by(self, client: str) -> int:
        """Places that client has taken now."""
        return self._held[client]

    def check(self, client: str) -> None:
        """Refuse where the next place would be one too many.

        Raises:
            ProblemError: 429 for the client's own limit, 503 for everybody's.
        """
        if self._held[client] >= self._per_client:
            raise ProblemError(
                429,
                f"At most {self._per_client} {self._what} of one client may be open at once.",
                kind="too-many-requests",
                retry_after=RETRY_AFTER,
            )
        if self._total is not None and self.held >= self._total:
            raise ProblemError(
                503, f"The service is full: too many {self._what} are open.", kind="full", retry_after=RETRY_AFTER
            )

    @contextmanager
    def taken(self, client: str) -> Iterator[None]:
        """Hold one place."""
        self._held[client] += 1
        try:
            yield
        finally:
            self._held[client] -= 1
            if not self._held[client]:
                del self._held[client]


class TokenBucket:
    """So many at once, and after that so many a second, for each client.

    Args:
        what: Its name in the refusal.
        burst: How many at once.
        each_second: How many come back [1/s].
        clock: Seconds, monotonic.
    """

    MOST_CLIENTS = 10_000

    def __init__(
        self, *, what: str, burst: int, each_second: float, clock: Callable[[], float] = time.monotonic
    ) -> None:
        self._what = what
        self._burst = burst
        self._each_second = each_second
        self._clock = clock
        self._full_at: dict[str, float] = {}

    def take(self, client: str) -> None:
        """Count one.

        Raises:
            ProblemError: 429, with the time after which one more is taken.
        """
        now = self._clock()
        full_at = max(now, self._full_at.get(client, now)) + 1 / self._each_second
        wait = full_at - now - self._burst / self._each_second
        if wait > 1e-9:
            raise ProblemError(
                429,
                f"Too many {self._what}: {self._burst} at once, then {self._each_second:g} a second.",
                kind="too-many-requests",
                retry_after=max(1, math.ceil(wait)),
            )
        if len(self._full_at) >= self.MOST_CLIENTS:
            self._full_at = {name: at for name, at in self._full_at.items() if at > now}
        self._full_at[client] = full_at


def client_key(address: str) -> str:
    """Who counts as one client: an IPv4 address, a whole IPv6 network, or whatever else the server calls it."""
    try:
        found = ipaddress.ip_address(address.partition("%")[0])
    except ValueError:
        return address
    if isinstance(found, ipaddress.IPv4Address):
        return str(found)
    if found.ipv4_mapped is not None:
        return str(found.ipv4_mapped)
    return str(ipaddress.ip_network((found, NETWORK), strict=False).network_address)
