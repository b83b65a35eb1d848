"""How much is accepted at the same time, so that an overload is refused early and nobody waits for ever."""

from collections.abc import Iterable, Iterator
from contextlib import AbstractContextManager, contextmanager

from backend.errors import CHEAPER_RUN, BusyError, CostLimitError
from backend.http.backlog import Backlog, mark_computing
from backend.http.limits import ConcurrencyLimit, TokenBucket
from sim_core.scenario import Scenario
from sim_core.workload import estimate

MOST_LINK_TOKENS = 120  # of one client at once; a link takes no more, however much it pins


class Admission:
    """Counts open requests that compute (also their estimated seconds) and streams, for each client and in all.

    What counts as open raises a TemporaryError where the client has too much of it (TooManyRequestsError) or the
    service has (BusyError).

    Args:
        max_request_cost: Greatest estimate of one request [s of one core].
        max_queued_cost: Greatest estimate of all that is open [s of one core].
        max_client_requests: Computing requests of one client.
        max_wait: Longest expected wait with which a request that may compute is admitted [s].
        workers: Processes that compute.
        max_client_streams: Event streams of one client.
        max_streams: Event streams in all.
    """

    def __init__(
        self,
        *,
        max_request_cost: float,
        max_queued_cost: float,
        max_client_requests: int,
        max_wait: float = 1.0,
        workers: int = 1,
        max_client_streams: int = 16,
        max_streams: int = 256,
    ) -> None:
        self._max_request_cost = max_request_cost
        self._max_queued_cost = max_queued_cost
        self._queued_cost = 0.0
        self._background_cost = 0.0
        self._computing = ConcurrencyLimit(what="computing requests", per_client=max_client_requests)
        self._streams = ConcurrencyLimit(what="event streams", per_client=max_client_streams, total=max_streams)
        self._requests = ConcurrencyLimit(
            what="requests", per_client=max_client_requests, total=8 * max_client_requests
        )
        self._bodies = ConcurrencyLimit(what="long request bodies", per_client=4, total=16)
        self._backlog = Backlog(workers=workers, max_wait=max_wait)
        self._links = TokenBucket(what="new links", burst=MOST_LINK_TOKENS, each_second=2)

    @property
    def load(self) -> dict[str, float]:
        """`cost` [s of one core] in progress; expected `wait` [s]; `requests`, `streams`, long `bodies` open."""
        return {
            "cost": self._queued_cost,
            "wait": self._backlog.expected_wait,
            "requests": self._computing.open,
            "streams": self._streams.open,
            "bodies": self._bodies.open,
        }

    def check(self, scenario: Scenario, strategies: Iterable[str], beside: float = 0.0) -> None:
        """Refuse a request that is too large for any client; its cost beside the runs counts too [s of one core].

        Raises:
            CostLimitError: Naming limit and estimate.
        """
        self.check_cost(beside + sum(estimate(scenario, strategy) for strategy in strategies))

    def check_cost(self, cost: float) -> None:
        """Refuse a request whose estimated cost is too large for any client [s of one core].

        Raises:
            CostLimitError: Naming limit and estimate.
        """
        if cost > self._max_request_cost:
            raise CostLimitError(
                f"The estimated cost of {cost:.3g} s of computing is over the limit of {self._max_request_cost:g} s "
                f"a request; fewer roads, {CHEAPER_RUN}",
                pointer="/scenario",
            )

    def check_admission(self, client: str) -> None:
        """Refuse a request that may compute before any work on it, so that refusals cost next to nothing.

        Raises:
            TemporaryError: As above, or the wait would be long.
        """
        self._requests.check(client)
        self._backlog.check(self._requests.open_by(client))

    @contextmanager
    def admitted(self, client: str) -> Iterator[None]:
        """Admit a request that may compute, from before its body is parsed to its answer.

        A lookup in the database costs much more than a refusal: without this limit a flood would keep the database's
        threads from the requests that were admitted.
        """
        self.check_admission(client)
        with self._requests.acquired(client), self._backlog.track():
            yield

    def reading(self, client: str) -> AbstractContextManager[None]:
        """Admit a request that only reads, but much."""
        return self._requests.acquired(client)

    @contextmanager
    def background(self, client: str, cost: float) -> Iterator[None]:
        """Count a background computation of that client, of that estimated cost [s of one core].

        Raises:
            TooManyRequestsError: The client has too many open.
            BusyError: The service is full.
        """
        if self._background_cost and self._background_cost + cost > self._max_queued_cost:
            raise BusyError("The service is full: too much is being planned or summarised.")
        with self.reading(client):
            self._background_cost += cost
            try:
                yield
            finally:
                self._background_cost = max(0.0, self._background_cost - cost)

    @contextmanager
    def computing(self, client: str, scenario: Scenario, strategies: Iterable[str]) -> Iterator[None]:
        """Count a computation of that client."""
        with self._computing.acquired(client):
            cost = sum(estimate(scenario, strategy) for strategy in strategies)
            if self._queued_cost and self._queued_cost + cost > self._max_queued_cost:
                raise BusyError("The service is full: too much computing is waiting.")
            mark_computing()
            self._queued_cost += cost
            try:
                yield
            finally:
                self._queued_cost -= cost
                if self._computing.open == 1:  # this one, which ends
                    self._queued_cost = 0.0  # no drift from rounding

    def streaming(self, client: str) -> AbstractContextManager[None]:
        """Count an open event stream."""
        return self._streams.acquired(client)

    def receiving(self, client: str) -> AbstractContextManager[None]:
        """Count a long request body, from its first byte to the answer."""
        return self._bodies.acquired(client)

    def linking(self, client: str, *, links: int = 1, pinned: int = 0) -> None:
        """Count new links of that client, and the strategies whose time histories they pin (0.8 MB each).

        Links are kept for ever, so nobody makes them by the thousand. Whoever has made none lately is never refused.
        """
        self._links.take(client, min(MOST_LINK_TOKENS, links + 3 * pinned))
