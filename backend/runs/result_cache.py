"""A cache in memory of results with their time histories, bounded in bytes."""

from cachetools import LRUCache

from backend.outcome import Outcome, Sampling


class ResultCache:
    """A cache that drops the least recently used result first; bounded in bytes."""

    def __init__(self, limit: int) -> None:
        self._items: LRUCache[str, Outcome] = LRUCache(limit, getsizeof=lambda outcome: outcome.size)

    def get(self, key: str, sampling: Sampling | None) -> Outcome | None:
        """The result of that key if its series has those samples (None: any), marked as just used."""
        outcome = self._items.get(key)
        return outcome if outcome is not None and sampling in (None, outcome.sampling) else None

    def put(self, key: str, outcome: Outcome) -> None:
        """Cache a result, replacing one of the same key, unless only the old one has series.

        One larger than all that is allowed is not cached.
        """
        if key in self._items and outcome.sampling is None:
            return
        self._items.pop(key, None)
        if outcome.size <= self._items.maxsize:
            self._items[key] = outcome
