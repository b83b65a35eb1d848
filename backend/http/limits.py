"""Limits for each client and for all: open at the same time, in fair shares, and per second; who is one client."""

import ipaddress
import math
import time
from collections import Counter
from collections.abc import Callable, Iterator, Mapping
from contextlib import contextmanager

from cachetools import TTLCache

from backend.errors import BusyError, TooManyRequestsError

IPV6_PREFIX = 64  # bits: one customer of a provider usually has 2^64 addresses
MOST_CLIENTS = 10_000  # whose rates are remembered


class ConcurrencyLimit:
    """How many of something may be open at once, for one client and in all."""

    def __init__(self, *, what: str, per_client: int, total: float = math.inf) -> None:
        self._what = what
        self._per_client = per_client
        self._total = total
        self._open: Counter[str] = Counter()

    @property
    def open(self) -> int:
        """Number open now."""
        return self._open.total()

    def open_by(self, client: str) -> int:
        """Number that this client has open now."""
        return self._open[client]

    def check(self, client: str) -> None:
        """Refuse where one more would be over a limit.

        Raises:
            TooManyRequestsError: The client's own limit.
            BusyError: Everybody's.
        """
        if self.open_by(client) >= self._per_client:
            raise TooManyRequestsError(f"At most {self._per_client} {self._what} of one client may be open at once.")
        if self.open >= self._total:
            raise BusyError(f"The service is full: too many {self._what} are open.")

    @contextmanager
    def acquired(self, client: str) -> Iterator[None]:
        """Count one as open for the length of the block.

        Raises:
            TemporaryError: As `check`.
        """
        self.check(client)
        self._open[client] += 1
        try:
            yield
        finally:
            self._open[client] -= 1
            if not self._open[client]:
                del self._open[client]


def fair_share(amounts: Mapping[str, float], client: str, more: float) -> float:
    """What comes before a client is through with so much more, where clients take turns.

    All it has itself, and of each other client's amount no more than that: nobody waits for the rest of a larger one.
    """
    own = amounts.get(client, 0.0) + more
    return own + sum(min(own, amount) for other, amount in amounts.items() if other != client)


class FairLimit:
    """An amount that all clients share: each is measured by `fair_share`, so that a greedy one fills its share alone.

    Args:
        what: Its name in the refusal.
        total: The greatest share; one client alone may have any amount at once.
    """

    def __init__(self, *, what: str, total: float) -> None:
        self._what = what
        self._total = total
        self._amounts: dict[str, float] = {}

    @property
    def amount(self) -> float:
        """Of all clients."""
        return sum(self._amounts.values())

    def check(self, client: str, amount: float) -> None:
        """Refuse so much more of that client where its share would be over the total.

        Raises:
            TooManyRequestsError: It is, by what the client has already.
            BusyError: It would be without that.
        """
        if not self._amounts or fair_share(self._amounts, client, amount) <= self._total:
            return
        others = {other: each for other, each in self._amounts.items() if other != client}
        if fair_share(others, client, amount) <= self._total:
            raise TooManyRequestsError(f"This client has used its share: too much {self._what} of its own is open.")
        raise BusyError(f"The service is full: too much {self._what} is open.")

    @contextmanager
    def acquired(self, client: str, amount: float) -> Iterator[None]:
        """Count so much of the client's for the length of the block.

        Raises:
            TemporaryError: As `check`.
        """
        self.check(client, amount)
        self._amounts[client] = self._amounts.get(client, 0.0) + amount
        try:
            yield
        finally:
            left = self._amounts.pop(client, 0.0) - amount
            if left > 1e-9:  # else it is rounding
                self._amounts[client] = left


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


def client_key(address: str) -> str:
    """Who counts as one client: an IPv4 address, a whole IPv6 network, or whatever else the server calls it."""
    try:
        parsed = ipaddress.ip_address(address.partition("%")[0])
    except ValueError:
        return address
    if isinstance(parsed, ipaddress.IPv4Address):
        return str(parsed)
    if parsed.ipv4_mapped is not None:
        return str(parsed.ipv4_mapped)
    return str(ipaddress.ip_network((parsed, IPV6_PREFIX), strict=False).network_address)
