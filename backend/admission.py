"""How much work is accepted at once, so that an overload is refused early and nobody waits for ever."""

from collections import Counter
from collections.abc import Iterable, Iterator
from contextlib import contextmanager

from backend.problems import ProblemError
from sim_core.scenario import Scenario
from sim_core.workload import estimate

RETRY_AFTER = 2  # [s]


class Admission:
    """Counts the computing requests that are open, for each client and in estimated seconds of one core."""

    def __init__(self, *, max_request_cost: float, max_queued_cost: float, max_client_requests: int) -> None:
        self._max_request_cost = max_request_cost
        self._max_queued_cost = max_queued_cost
        self._max_client_requests = max_client_requests
        self._queued_cost = 0.0
        self._open: Counter[str] = Counter()

    def check(self, scenario: Scenario, strategies: Iterable[str]) -> None:
        """Refuse a request that is too big for anybody.

        Raises:
            ProblemError: 422, naming limit and estimate.
        """
        cost = sum(estimate(scenario, strategy) for strategy in strategies)
        if cost > self._max_request_cost:
            message = (
                f"The estimated cost of {cost:.3g} s of computing is over the limit of {self._max_request_cost:g} s "
                "a request; a shorter road, a higher speed, a longer sample time or shorter horizons cost less"
            )
            raise ProblemError(422, message, kind="cost-limit", errors=[{"pointer": "/scenario", "message": message}])

    @contextmanager
    def computing(self, client: str, scenario: Scenario, strategies: Iterable[str]) -> Iterator[None]:
        """Hold a place while something is computed for that client.

        Raises:
            ProblemError: 429 where the client has too many open, 503 where the service is full.
        """
        if self._open[client] >= self._max_client_requests:
            raise ProblemError(
                429,
                f"At most {self._max_client_requests} computing requests of one client may be open at once.",
                kind="too-many-requests",
                retry_after=RETRY_AFTER,
            )
        cost = sum(estimate(scenario, strategy) for strategy in strategies)
        if self._queued_cost and self._queued_cost + cost > self._max_queued_cost:
            raise ProblemError(
                503, "The service is full: too much computing is waiting.", kind="full", retry_after=RETRY_AFTER
            )
        self._open[client] += 1
        self._queued_cost += cost
        try:
            yield
        finally:
            self._queued_cost -= cost
            self._open[client] -= 1
            if not self._open[client]:
                del self._open[client]
                self._queued_cost = self._queued_cost if self._open else 0.0  # no drift from rounding
