"""Requests of several clients take turns: who is alone has nearly every place, and nobody waits for all of others."""

import asyncio
from collections import Counter, deque
from collections.abc import Iterator
from contextlib import contextmanager, suppress
from contextvars import ContextVar

from backend.errors import BusyError, TooManyRequestsError


class Ticket:
    """A request in a queue, or in one of the places.

    Attributes:
        client: Who sent it.
    """

    def __init__(self, turns: "Turns", client: str) -> None:
        self.client = client
        self._turns = turns
        self._has_place = False

    async def turn(self) -> None:
        """Wait for a place."""
        await self._turns.take_place(self.client)
        self._has_place = True

    def leave_place(self) -> None:
        """Let the next request have the place; this one goes on without."""
        if self._has_place:
            self._has_place = False
            self._turns.free_place(self.client)


_current: ContextVar[Ticket | None] = ContextVar("ticket", default=None)


def current_ticket() -> Ticket | None:
    """Return the ticket of the request that is being handled; None outside one."""
    return _current.get()


class Turns:
    """A queue of each client, and the places of those whose turn it is. Of several clients each is next once a round.

    Args:
        client_places: Requests of one client that are handled at once.
        places: Those of all; more, so that another client finds a place at once.
        client_queue: Requests that one client may have open, waiting or handled.
        queue: Requests that all may have open; a client with less than its share of them may have one more.
    """

    def __init__(self, *, client_places: int, places: int, client_queue: int, queue: int) -> None:
        self.client_places = client_places
        self.places = places
        self.client_queue = client_queue
        self.queue = queue
        self._open: Counter[str] = Counter()  # by client, waiting or handled
        self._handled: Counter[str] = Counter()  # by client, those in a place
        self._waiting: dict[str, deque[asyncio.Future[None]]] = {}  # by client, whose turn is next first

    @property
    def open(self) -> int:
        """How many requests wait or are handled."""
        return self._open.total()

    @property
    def waiting(self) -> int:
        """How many requests wait for a place."""
        return sum(map(len, self._waiting.values()))

    @contextmanager
    def ticket(self, client: str) -> Iterator[Ticket]:
        """Count a request, from before its body is read to its answer.

        Raises:
            TooManyRequestsError: Its client's queue is full.
            BusyError: The service's is, and its client has its share of it.
        """
        self._check(client)
        self._open[client] += 1
        ticket = Ticket(self, client)
        token = _current.set(ticket)
        try:
            yield ticket
        finally:
            _current.reset(token)
            ticket.leave_place()
            self._open[client] -= 1
            self._open += Counter()  # forgets whoever has none

    def _check(self, client: str) -> None:
        own = self._open[client]
        if own >= self.client_queue:
            raise TooManyRequestsError(f"One client may have {self.client_queue} requests open at once.")
        clients = len(self._open.keys() | {client})
        if self.open >= self.queue and own >= self.queue // clients:
            raise BusyError(f"The service is full: {self.queue} requests are open.")

    async def take_place(self, client: str) -> None:
        """Wait for a place; one that is free is taken at once."""
        place = asyncio.get_running_loop().create_future()
        self._waiting.setdefault(client, deque()).append(place)
        self._dispatch()
        try:
            await place
        except asyncio.CancelledError:
            if place.done() and not place.cancelled():  # its turn came just then
                self.free_place(client)
            else:
                self._forget(client, place)
            raise

    def free_place(self, client: str) -> None:
        """Give a place back, which the next one takes."""
        self._handled[client] -= 1
        self._handled += Counter()
        self._dispatch()

    def _dispatch(self) -> None:
        while self._handled.total() < self.places:
            client = next((each for each in self._waiting if self._handled[each] < self.client_places), None)
            if client is None:
                return
            queue = self._waiting.pop(client)
            place = queue.popleft()
            if queue:
                self._waiting[client] = queue  # behind the others
            if not place.cancelled():
                self._handled[client] += 1
                place.set_result(None)

    def _forget(self, client: str, place: "asyncio.Future[None]") -> None:
        queue = self._waiting.get(client, deque())
        with suppress(ValueError):  # it was passed over already
            queue.remove(place)
            if not queue:
                del self._waiting[client]
