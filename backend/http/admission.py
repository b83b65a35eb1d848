"""How much is accepted at the same time, so that an overload is refused early and nobody waits for ever."""

from collections.abc import Iterable, Iterator
from contextlib import AbstractContextManager, contextmanager
from contextvars import ContextVar

from backend.compute.fair_queue import SHORT
from backend.cost.estimate import estimate
from backend.errors import CHEAPER_RUN, CostLimitError
from backend.http.backlog import Backlog
from backend.http.limits import ConcurrencyLimit, FairLimit, TokenBucket
from sim_core.scenario import Scenario

REPORT_COST = 0.1  # [s of one core]
MOST_LINK_TOKENS = 120  # of one client at once; a link takes no more, however much it pins
_computing: ContextVar[bool] = ContextVar("computing", default=False)  # whether what follows is counted already


class Admission:
    """Counts open requests that compute (also their estimated seconds) and streams, for each client and in all.

    What counts as open raises a TemporaryError: TooManyRequestsError where the client has used its share, BusyError
    where the service as a whole is full.

    Args:
        max_request_cost: Greatest estimate of one request [s of one core].
        max_queued_cost: Greatest estimate of all that comes before a client's turn is over [s of one core].
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
        self._cost = FairLimit(what="computing", total=max_queued_cost)
        self._background_cost = FairLimit(what="planning and summarising", total=max_queued_cost)
        self._computing = ConcurrencyLimit(what="computing requests", per_client=max_client_requests)
        self._streams = ConcurrencyLimit(what="event streams", per_client=max_client_streams, total=max_streams)
        self._requests = ConcurrencyLimit(what="requests", per_client=max_client_requests)
        self._reports = ConcurrencyLimit(what="reports", per_client=2)
        self._bodies = ConcurrencyLimit(what="long request bodies", per_client=4, total=16)
        self._backlog = Backlog(workers=workers, max_wait=max_wait)
        self._links = TokenBucket(what="new links", burst=MOST_LINK_TOKENS, each_second=2)

    @property
    def load(self) -> dict[str, float]:
        """`cost` [s of one core] in progress; expected `wait` [s]; `requests`, `streams`, long `bodies` open."""
        return {
            "cost": self._cost.amount,
            "wait": self._backlog.expected_wait,
            "requests": self._computing.open,
            "streams": self._streams.open,
            "bodies": self._bodies.open,
        }

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
        self._backlog.check(client)

    @contextmanager
    def admitted(self, client: str) -> Iterator[None]:
        """Admit a request that may compute, from before its body is parsed to its answer.

        A lookup in the database costs much more than a refusal: without this limit a flood would keep the database's
        threads from the requests that were admitted.
        """
        self.check_admission(client)
        with self._requests.acquired(client), self._backlog.track(client):
            yield

    def reading(self, client: str) -> AbstractContextManager[None]:
        """Admit a request that only reads, but much."""
        return self._requests.acquired(client)

    @contextmanager
    def background(self, client: str, cost: float) -> Iterator[None]:
        """Count a background computation of that client, of that estimated cost [s of one core]."""
        with self.reading(client), self._background_cost.acquired(client, cost):
            yield

    @contextmanager
    def computing(self, client: str, cost: float) -> Iterator[None]:
        """Count a computation of that client, of that estimated cost [s of one core].

        Inside it others are part of it: what was admitted as a whole is not refused half way.
        """
        if _computing.get():
            yield
            return
        with self.downloading(client, cost):
            self._backlog.mark_computing(long=cost > SHORT)
            token = _computing.set(True)
            try:
                yield
            finally:
                _computing.reset(token)

    @contextmanager
    def downloading(self, client: str, cost: float) -> Iterator[None]:
        """Count a download of that client, of that estimated cost [s of one core], until all of it was sent."""
        with self._computing.acquired(client), self._cost.acquired(client, cost):
            yield

    @contextmanager
    def reporting(self, client: str) -> Iterator[None]:
        """Count a report that is being made: one thread makes all, one after the other."""
        with self._reports.acquired(client), self.computing(client, REPORT_COST):
            yield

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


def cost_of(scenario: Scenario, strategies: Iterable[str]) -> float:
    """Estimated cost of these strategies [s of one core]."""
    return sum(estimate(scenario, strategy) for strategy in strategies)
