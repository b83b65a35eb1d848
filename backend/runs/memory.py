"""Results, with the time histories they were asked for, cached in memory while there is room."""

from cachetools import LRUCache

from backend.runs.work import ComputedResult


class Memory:
    """Least recently used goes first; bounded in bytes."""

    def __init__(self, limit: int) -> None:
        self._items: LRUCache[str, ComputedResult] = LRUCache(limit, getsizeof=lambda outcome: outcome.size)

    def get(self, key: str, points: int | None) -> ComputedResult | None:
        """The result of that key if it has series of so many points (None: any do), now the most recently used."""
        outcome = self._items.get(key)
        return outcome if outcome is not None and points in (None, outcome.points) else None

    def put(self, key: str, outcome: ComputedResult) -> None:
        """Cache a result in place of another of that key, unless that has series and this has none.

        One larger than all that is allowed is not cached.
        """
        if key in self._items and outcome.points is None:
            return
        self._items.pop(key, None)
        if outcome.size <= self._items.maxsize:
            self._items[key] = outcome
