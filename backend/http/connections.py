"""Open connections by client: where there are too many, idle ones are closed, so that no client locks others out."""

from collections.abc import Callable
from enum import Enum, auto
from typing import NamedTuple, Protocol

from backend.http.client_key import client_key

HEALTH_CONNECTIONS = 16  # beyond all others, for health checks
PROXIES, HEALTH = "proxies", "health"  # groups beside those of clients


class Connection(Protocol):
    """The interface of a counted connection."""

    @property
    def idle(self) -> bool:
        """Whether it waits for a request."""

    def evict(self) -> None:
        """Close it while it is idle, to make room for another one."""


class Served(Enum):
    """What a new connection may ask for."""

    ALL = auto()
    HEALTH = auto()
    NOTHING = auto()


class Admission(NamedTuple):
    """How a new connection is treated.

    Attributes:
        served: What it may ask for.
        status: Of the answer to all else: 429 where its client has used its share, 503 where the service is full.
    """

    served: Served
    status: int = 503


class Connections:
    """Which connections are open, each client's with the longest idle one first.

    Args:
        per_client: How many one client may have; many people may be behind one address.
        total: How many there may be in all. Beyond either there are some more that may only ask for health.
        is_proxy: Whether an address is no client: its connections count in the total, and are never closed.
    """

    def __init__(self, *, per_client: int, total: int, is_proxy: Callable[[str], bool] = lambda _: False) -> None:
        self._per_client = per_client
        self._total = total
        self._is_proxy = is_proxy
        self._groups: dict[str, dict[Connection, None]] = {}  # by client, the longest unused first
        self._group_of: dict[Connection, str] = {}

    def add(self, connection: Connection, address: str) -> Admission:
        """Count a new connection, where there is room or an idle one can be closed."""
        group = PROXIES if self._is_proxy(address) else client_key(address)
        within_share = group == PROXIES or self._size(group) < self._per_client or self._evict(group)
        if within_share and (self._has_room() or self._evict_of_largest_client()):
            self._insert(connection, group)
            return Admission(Served.ALL)
        status = 503 if within_share else 429
        if self._size(HEALTH) < HEALTH_CONNECTIONS or self._evict(HEALTH):
            self._insert(connection, HEALTH)
            return Admission(Served.HEALTH, status)
        return Admission(Served.NOTHING, status)

    def mark_used(self, connection: Connection) -> None:
        """Note that it answered a request: of its client's idle connections it is closed last."""
        if connection in self._group_of:
            group = self._groups[self._group_of[connection]]
            group[connection] = group.pop(connection)

    def remove(self, connection: Connection) -> None:
        """Count a connection as ended."""
        name = self._group_of.pop(connection, None)
        if name is not None:
            del self._groups[name][connection]
            if not self._groups[name]:
                del self._groups[name]

    def _has_room(self) -> bool:
        return len(self._group_of) - self._size(HEALTH) < self._total

    def _size(self, group: str) -> int:
        return len(self._groups.get(group, ()))

    def _insert(self, connection: Connection, group: str) -> None:
        self._groups.setdefault(group, {})[connection] = None
        self._group_of[connection] = group

    def _evict_of_largest_client(self) -> bool:
        clients = self._groups.keys() - {PROXIES, HEALTH}
        return any(self._evict(group) for group in sorted(clients, key=self._size, reverse=True))

    def _evict(self, group: str) -> bool:
        """Close the connection that has been idle for longest; False where none is idle."""
        connection = next((each for each in self._groups.get(group, ()) if each.idle), None)
        if connection is None:
            return False
        self.remove(connection)
        connection.evict()
        return True
