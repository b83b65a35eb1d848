"""A sum that all requests share: bytes in memory, bytes on the disk, open streams."""

from collections.abc import Iterator
from contextlib import contextmanager

from backend.errors import BusyError, TooManyRequestsError

ROUNDING = 0.5  # sums of estimated sizes are not exact; what is held is a byte or a stream at least


class Budget:
    """So much of one thing may be held at once, half of it by one client.

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
        """How much is held."""
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
