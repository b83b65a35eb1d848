"""How much is accepted at once, so that an overload is refused early and nobody waits for ever."""

import ipaddress
import math
import time
from collections import Counter
from collections.abc import Callable, Iterable, Iterator
from contextlib import contextmanager

from backend.problems import ProblemError
from sim_core.scenario import Scenario
from sim_core.workload import estimate

RETRY_AFTER = 2  # [s]
NETWORK = 64  # of IPv6 one customer gets 2^64 addresses


class Places:
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


class Rate:
    """So many at once, and after that so many a second: a token bucket for each client.

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


class Admission:
    """Counts what is open, for each client and in all: requests that compute (also in estimated seconds), streams.

    Args:
        max_request_cost: Greatest estimate of one request [s of one core].
        max_queued_cost: Greatest estimate of all that is open [s of one core].
        max_client_requests: Computing requests of one client.
        max_client_streams: Event streams of one client.
        max_streams: Event streams in all.
    """

    def __init__(
        self,
        *,
        max_request_cost: float,
        max_queued_cost: float,
        max_client_requests: int,
        max_client_streams: int = 16,
        max_streams: int = 256,
    ) -> None:
        self._max_request_cost = max_request_cost
        self._max_queued_cost = max_queued_cost
        self._queued_cost = 0.0
        self._requests = Places(what="computing requests", per_client=max_client_requests)
        self._streams = Places(what="event streams", per_client=max_client_streams, total=max_streams)
        self._entered = Places(what="requests", per_client=max_client_requests, total=8 * max_client_requests)
        self._bodies = Places(what="long request bodies", per_client=4, total=16)
        self._links = Rate(what="new links", burst=120, each_second=2)

    @property
    def load(self) -> dict[str, float]:
        """`cost` [s of one core] accepted and not finished; `requests`, `streams` and long `bodies` open."""
        return {
            "cost": self._queued_cost,
            "requests": self._requests.held,
            "streams": self._streams.held,
            "bodies": self._bodies.held,
        }

    def check(self, scenario: Scenario, strategies: Iterable[str], beside: float = 0.0) -> None:
        """Refuse a request that is too big for anybody; what it costs beside the runs counts too [s of one core].

        Raises:
            ProblemError: 422, naming limit and estimate.
        """
        cost = beside + sum(estimate(scenario, strategy) for strategy in strategies)
        if cost > self._max_request_cost:
            message = (
                f"The estimated cost of {cost:.3g} s of computing is over the limit of {self._max_request_cost:g} s "
                "a request; fewer or shorter roads, a higher speed, a longer sample time or shorter horizons cost less"
            )
            raise ProblemError(422, message, kind="cost-limit", errors=[{"pointer": "/scenario", "message": message}])

    @contextmanager
    def entering(self, client: str) -> Iterator[None]:
        """Hold a place from the door on, while it is looked up whether anything has to be computed at all.

        Looking up costs the database's threads more than refusing does: without this a flood would keep them from
        those who were let in.

        Raises:
            ProblemError: 429 where the client has too many open, 503 where the service has.
        """
        client = client_key(client)
        self._entered.check(client)
        with self._entered.taken(client):
            yield

    @contextmanager
    def computing(self, client: str, scenario: Scenario, strategies: Iterable[str]) -> Iterator[None]:
        """Hold a place while something is computed for that client.

        Raises:
            ProblemError: 429 where the client has too many open, 503 where the service is full.
        """
        client = client_key(client)
        self._requests.check(client)
        cost = sum(estimate(scenario, strategy) for strategy in strategies)
        if self._queued_cost and self._queued_cost + cost > self._max_queued_cost:
            raise ProblemError(
                503, "The service is full: too much computing is waiting.", kind="full", retry_after=RETRY_AFTER
            )
        with self._requests.taken(client):
            self._queued_cost += cost
            try:
                yield
            finally:
                self._queued_cost -= cost
                if self._requests.held == 1:  # this one, which ends
                    self._queued_cost = 0.0  # no drift from rounding

    @contextmanager
    def streaming(self, client: str) -> Iterator[None]:
        """Hold a place while that client listens to an event stream.

        Raises:
            ProblemError: 429 where the client has too many open, 503 where the service has.
        """
        client = client_key(client)
        self._streams.check(client)
        with self._streams.taken(client):
            yield

    @contextmanager
    def receiving(self, client: str) -> Iterator[None]:
        """Hold a place while a long request body of that client is received and worked on.

        Raises:
            ProblemError: 429 where the client has too many open, 503 where the service has.
        """
        client = client_key(client)
        self._bodies.check(client)
        with self._bodies.taken(client):
            yield

    def linking(self, client: str) -> None:
        """Count a new link of that client: links are kept for ever, so nobody makes them by the thousand.

        Raises:
            ProblemError: 429.
        """
        self._links.take(client_key(client))


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
