"""The one gate: requests wait for their turn, and only what exceeds a stated length, cost or sum is refused."""

from collections.abc import Iterator
from contextlib import contextmanager

from backend.compute.fair_queue import SHORT
from backend.errors import CHEAPER_RUN, CostLimitError
from backend.gate.budget import Budget
from backend.gate.rate import TokenBucket
from backend.gate.turns import Turns, current_ticket
from backend.settings import MAX_BATCH_RUNS, MEBIBYTE, Settings

MEMORY = 128 * MEBIBYTE  # of long request bodies and pinned time histories that are being read
STREAMS = 256
LINKS, LINKS_EACH_SECOND = 120, 2.0  # of one client; a link counts three for each time history that it pins
CLIENT_PLACES = 2  # of one client, beside one for each worker
OTHERS_PLACES = 4  # beside those of one client
SERVICE_QUEUES = 2  # of one client's length is the queue of all


class Gate:
    """What every request passes.

    Attributes:
        computing_turns: Of requests that may compute.
        reading_turns: Of those that look something up, name it or remove it.
        memory: For long bodies and pinned time histories [bytes].
        streams: What is sent while it is made: events of jobs, results of batches.
    """

    def __init__(self, settings: Settings) -> None:
        longest = settings.max_client_requests
        places = settings.workers + CLIENT_PLACES
        self.computing_turns, self.reading_turns = (
            Turns(
                client_places=places,
                places=places + OTHERS_PLACES,
                client_queue=longest,
                queue=SERVICE_QUEUES * longest,
            )
            for _ in range(2)
        )
        self.memory = Budget("the memory for long bodies and pinned time histories", MEMORY)
        self.streams = Budget("the event streams", STREAMS)
        self._settings = settings
        self._links = TokenBucket(what="new links", burst=LINKS, each_second=LINKS_EACH_SECOND)
        self._cost = 0.0

    @property
    def load(self) -> dict[str, float]:
        """`cost` [s of one core] in progress; `requests` open and `waiting`, `streams`, bytes in `memory`."""
        both = (self.computing_turns, self.reading_turns)
        return {
            "cost": self._cost,
            "requests": self.computing_turns.open,
            "waiting": sum(each.waiting for each in both),
            "streams": self.streams.held,
            "memory": self.memory.held,
        }

    def check_cost(self, cost: float) -> None:
        """Refuse a request whose estimated cost [s of one core] is too large for any client; raises CostLimitError."""
        most = self._settings.max_request_cost
        if cost > most:
            raise CostLimitError(
                f"The estimated cost of {cost:.3g} s of computing is over the limit of {most:g} s "
                f"a request; fewer roads, {CHEAPER_RUN}",
                pointer="/scenario",
            )

    @contextmanager
    def computing(self, client: str, cost: float) -> Iterator[None]:
        """Count work of that estimated cost [s of one core]; the others do not wait for the place of a long one.

        Args:
            client: Whose request it is; its ticket is the current one.
            cost: Estimated.
        """
        ticket = current_ticket()
        if cost > SHORT and ticket is not None and ticket.client == client:
            ticket.leave_place()
        self._cost += cost
        try:
            yield
        finally:
            self._cost -= cost

    def linking(self, client: str, *, links: int = 1, pinned: int = 0) -> None:
        """Count new links of that client, and the strategies whose time histories they pin (0.8 MB each).

        Links are kept for ever, so nobody makes them by the thousand. Whoever has made none lately is never refused.
        """
        self._links.take(client, links + 3 * pinned)

    def limits(self) -> list[dict[str, str]]:
        """Return each limit, its value, and what whoever is beyond it gets."""
        limits, turns = self._settings, self.computing_turns
        more = CLIENT_PLACES + OTHERS_PLACES
        places = f"one for each worker and {more} more, of one client {CLIENT_PLACES} more"
        links = f"{LINKS} at once, then {LINKS_EACH_SECOND:g} a second; a pinned time history counts three"
        files = f"{limits.spool_bytes // MEBIBYTE} MiB, of one client half, in one file a quarter"
        rows = (
            ("requests handled at once", places, "waits for its turn"),
            ("requests of one client, waiting or handled", f"{turns.client_queue}", "429"),
            ("requests of all clients", f"{turns.queue}", "503, where its client has its share of them"),
            ("estimated cost of one request", f"{limits.max_request_cost:g} s of one core", "422"),
            ("runs of a batch", f"{MAX_BATCH_RUNS}", "422"),
            ("estimated cost of a batch", f"{limits.max_batch_cost:g} s of one core", "422"),
            ("long bodies and pinned time histories", f"{MEMORY // MEBIBYTE} MiB, of one client half", "429, 503"),
            ("answers in files", files, "429, 503, 422"),
            ("streams of events and of results", f"{STREAMS}, of one client half", "429, 503"),
            ("links of one client", links, "429"),
        )
        return [dict(zip(("limit", "value", "beyond"), row, strict=True)) for row in rows]


def explained(limits: list[dict[str, str]]) -> str:
    """Return the limits as a table in Markdown."""
    lines = ["| limit | value | beyond it |", "|---|---|---|"]
    return "\n".join([*lines, *(f"| {' | '.join(row.values())} |" for row in limits)])
