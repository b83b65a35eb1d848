"""Results with their time histories, kept in memory while there is room."""

from collections import OrderedDict

from backend.worker import Outcome


class Memory:
    """Least recently used goes first; bounded in bytes."""

    def __init__(self, limit: int) -> None:
        self._limit = limit
        self._size = 0
        self._items: OrderedDict[str, Outcome] = OrderedDict()

    def get(self, key: str) -> Outcome | None:
        """The result of that key, now the most recently used."""
        outcome = self._items.get(key)
        if outcome is not None:
            self._items.move_to_end(key)
        return outcome

    def put(self, key: str, outcome: Outcome) -> None:
        """Keep a result; one that is larger than everything allowed is not kept."""
        if key in self._items or outcome.size > self._limit:
            return
        self._items[key] = outcome
        self._size += outcome.size
        while self._size > self._limit:
            _, oldest = self._items.popitem(last=False)
            self._size -= oldest.size
