"""The one gate: requests wait for their turn, and only what exceeds a stated length, cost or sum is refused."""

import asyncio
import math
import time
from collections import Counter, deque
from collections.abc import Callable, Iterator
from contextlib import contextmanager, suppress
from contextvars import ContextVar
from dataclasses import dataclass

from cachetools import TTLCache

from backend.compute.fair_queue import SHORT
from backend.errors import CHEAPER_RUN, BusyError, CostLimitError, TooManyRequestsError
from backend.settings import MAX_BATCH_RUNS, MEBIBYTE, Settings

MEMORY = 128 * MEBIBYTE  # of long request bodies and pinned time histories that are being read
STREAMS = 256
LINKS, LINKS_EACH_SECOND = 120, 2.0  # of one client
PIN_WEIGHT = 3  # so many links counts a time history that one pins (0.8 MB)
CLIENT_SLOTS = 2  # of one client, beside one for each worker
OTHERS_SLOTS = 4  # beside those of one client
SERVICE_QUEUES = 2  # of one client's length is the queue of all
MOST_CLIENTS = 10_000  # whose rates are remembered
ROUNDING = 0.5  # sums of estimated sizes are not exact; what is held is a byte or a stream at least


class RequestQueue:
    """Open requests, of which so many are handled at once. Of several clients each is next once a round.

    Args:
        client_slots: Requests of one client that are handled at once.
        slots: Those of all; more, so that another client finds a slot at once.
        max_client_requests: Requests that one client may have open, waiting or handled.
        max_requests: Requests that all may have open; a client with less than its share of them may have one more.
    """

    def __init__(self, *, client_slots: int, slots: int, max_client_requests: int, max_requests: int) -> None:
        self.client_slots = client_slots
        self.slots = slots
        self.max_client_requests = max_client_requests
        self.max_requests = max_requests
        self.open: Counter[str] = Counter()  # by client, waiting or handled
        self.handled: Counter[str] = Counter()  # by client, those in a slot
        self.waiting_clients: dict[str, deque[asyncio.Future[None]]] = {}  # whose turn is next first

    @property
    def waiting(self) -> int:
        """Return how many requests wait for a slot."""
        return sum(map(len, self.waiting_clients.values()))

    @contextmanager
    def admit(self, client: str) -> Iterator["Admission"]:
        """Count a request, from before its body is read to its answer.

        Raises:
            TooManyRequestsError: Its client's queue is full.
            BusyError: The service's is, and its client has its share of it.
        """
        own = self.open[client]
        if own >= self.max_client_requests:
            raise TooManyRequestsError(f"One client may have {self.max_client_requests} requests open at once.")
        clients = len(self.open.keys() | {client})
        if self.open.total() >= self.max_requests and own >= self.max_requests // clients:
            raise BusyError(f"The service is full: {self.max_requests} requests are open.")
        self.open[client] += 1
        admission = Admission(self, client)
        token = _current.set(admission)
        try:
            yield admission
        finally:
            _current.reset(token)
            admission.release_slot()
            self.open[client] -= 1
            for counts in (self.open, self.handled):
                if not counts[client]:
                    del counts[client]

    async def wait_in_line(self, client: str) -> None:
        """Wait for a slot that another request releases."""
        slot = asyncio.get_running_loop().create_future()
        self.waiting_clients.setdefault(client, deque()).append(slot)
        try:
            await slot
        except asyncio.CancelledError:
            if slot.done() and not slot.cancelled():  # its turn came just then
                self.handled[client] -= 1
                self.hand_out_slots()
            with suppress(KeyError, ValueError):  # it was passed over already
                self.waiting_clients[client].remove(slot)
                if not self.waiting_clients[client]:
                    del self.waiting_clients[client]
            raise

    def hand_out_slots(self) -> None:
        """Give free slots to those who wait, one to each client in turn."""
        while self.handled.total() < self.slots:
            client = next((each for each in self.waiting_clients if self.handled[each] < self.client_slots), None)
            if client is None:
                return
            line = self.waiting_clients.pop(client)
            slot = line.popleft()
            if line:
                self.waiting_clients[client] = line  # behind the others
            if not slot.cancelled():
                self.handled[client] += 1
                slot.set_result(None)


@dataclass(eq=False, slots=True)
class Admission:
    """A request in a queue, waiting or in one of the slots."""

    queue: RequestQueue
    client: str
    has_slot: bool = False

    async def wait_for_slot(self) -> None:
        """Take a free slot at once, or wait for one."""
        queue = self.queue
        if queue.handled.total() < queue.slots and queue.handled[self.client] < queue.client_slots:
            queue.handled[self.client] += 1  # nobody who waits could have it: they would have been given it
        else:
            await queue.wait_in_line(self.client)
        self.has_slot = True

    def release_slot(self) -> None:
        """Let the next request have the slot; this one goes on without."""
        if self.has_slot:
            self.has_slot = False
            self.queue.handled[self.client] -= 1
            if self.queue.waiting_clients:
                self.queue.hand_out_slots()


_current: ContextVar[Admission | None] = ContextVar("admission", default=None)  # of the request that is handled


class Budget:
    """A sum that all requests share, bytes or streams: so much may be held at once, half of it by one client.

    Args:
        what: The thing, in refusals.
        total: How much there is.
    """

    def __init__(self, what: str, total: float) -> None:
        self.total = total
        self._what = what
        self._held: dict[str, float] = {}  # by client

    @property
    def held(self) -> float:
        """Return how much is held."""
        return sum(self._held.values())

    @contextmanager
    def hold(self, client: str, amount: float) -> Iterator[None]:
        """Hold so much for the length of the block.

        Raises:
            TooManyRequestsError: The client would hold more than half.
            BusyError: All together would hold more than there is.
        """
        own = self._held.get(client, 0.0)
        if own + amount > self.total / 2:
            raise TooManyRequestsError(f"This client has used its share of {self._what}.")
        if self.held + amount > self.total:
            raise BusyError(f"The service is full: nothing is left of {self._what}.")
        self._held[client] = own + amount
        try:
            yield
        finally:
            left = self._held.pop(client, 0.0) - amount
            if left > ROUNDING:
                self._held[client] = left


class LinkRate:
    """A limit on each client's new links, which are kept for ever: a burst, then so many each second.

    Args:
        burst: How many links a client has at first, and at most.
        each_second: How many are added [1/s].
        clock: Seconds, monotonic.
    """

    def __init__(self, burst: int, each_second: float, clock: Callable[[], float] = time.monotonic) -> None:
        self.burst = burst
        self.each_second = each_second
        self._clock = clock
        # By client when all its links are there again; after that it is as good as unknown.
        self._full_at: TTLCache[str, float] = TTLCache(MOST_CLIENTS, burst / each_second, clock)

    def take(self, client: str, links: int = 1) -> None:
        """Take links, at most the whole burst.

        Raises:
            TooManyRequestsError: With the time after which there are as many again.
        """
        now = self._clock()
        full_at = max(now, self._full_at.get(client, now)) + min(links, self.burst) / self.each_second
        wait = full_at - now - self.burst / self.each_second
        if wait > 1e-9:
            message = f"Too many new links: {self.burst} at once, then {self.each_second:g} a second."
            raise TooManyRequestsError(message, retry_after=max(1, math.ceil(wait)))
        self._full_at[client] = full_at


class Gate:
    """Queues, sums and rates that every request passes.

    Attributes:
        compute_queue: The requests that may compute.
        read_queue: Those that look something up, name it or remove it.
        memory: For long bodies and pinned time histories [bytes].
        streams: What is sent while it is made: events of jobs, results of batches.
        links: New links.
        cost: In progress, as estimated [s of one core].
    """

    def __init__(self, settings: Settings) -> None:
        slots, longest = settings.workers + CLIENT_SLOTS, settings.max_client_requests
        self.compute_queue, self.read_queue = (
            RequestQueue(
                client_slots=slots,
                slots=slots + OTHERS_SLOTS,
                max_client_requests=longest,
                max_requests=SERVICE_QUEUES * longest,
            )
            for _ in range(2)
        )
        self.memory = Budget("the memory for long bodies and pinned time histories", MEMORY)
        self.streams = Budget("the event streams", STREAMS)
        self.links = LinkRate(LINKS, LINKS_EACH_SECOND)
        self.cost = 0.0
        self._settings = settings

    @property
    def load(self) -> dict[str, float]:
        """Return `cost` [s of one core], `requests` open and `waiting`, `streams`, bytes in `memory`."""
        return {
            "cost": self.cost,
            "requests": self.compute_queue.open.total(),
            "waiting": self.compute_queue.waiting + self.read_queue.waiting,
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
        """Count a client's work of that estimated cost [s of one core]; others do not wait for a long one's slot."""
        admission = _current.get()
        if cost > SHORT and admission is not None and admission.client == client:
            admission.release_slot()
        self.cost += cost
        try:
            yield
        finally:
            self.cost -= cost

    def limits(self) -> list[dict[str, str]]:
        """Return each limit, its value, and what whoever is beyond it gets."""
        limits, queue = self._settings, self.compute_queue
        more = CLIENT_SLOTS + OTHERS_SLOTS
        places = f"one for each worker and {more} more, of one client {CLIENT_SLOTS} more"
        links = f"{LINKS} at once, then {LINKS_EACH_SECOND:g} a second; a pinned time history counts three"
        files = f"{limits.spool_bytes // MEBIBYTE} MiB, of one client half, in one file a quarter"
        rows = (
            ("requests handled at once", places, "waits for its turn"),
            ("requests of one client, waiting or handled", f"{queue.max_client_requests}", "429"),
            ("requests of all clients", f"{queue.max_requests}", "503, where its client has its share of them"),
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
