"""Results, with the time histories they were asked for, kept in memory while there is room."""

from collections import OrderedDict

from backend.runs.work import Outcome


class Memory:
    """Least recently used goes first; bounded in bytes."""

    def __init__(self, limit: int) -> None:
        self._limit = limit
        self._size = 0
        self._items: OrderedDict[str, Outcome] = OrderedDict()

    def get(self, key: str, points: int | None) -> Outcome | None:
        """The result of that key if it has series of so many points (None: any do), now the most recently used."""
        outcome = self._items.get(key)
        if outcome is None or points not in (None, outcome.points):
            return None
        self._items.move_to_end(key)
        return outcome

    def put(self, key: str, outcome: Outcome) -> None:
        """Keep a result in place of another of that key, unless that has series and this has none.

        One larger than all that is allowed is not kept.
        """
        present = self._items.get(key)
        if present is not None and outcome.points is None:
            return
        if present is not None:
            self._size -= self._items.pop(key).size
        if outcome.size > self._limit:
            return
        self._items[key] = outcome
        self._size += outcome.size
        while self._size > self._limit:
            _, oldest = self._items.popitem(last=False)
            self._size -= oldest.size
