"""Answers that wait in memory for their clients to read them: bounded in sum."""

from collections import Counter
from typing import Protocol


class Reader(Protocol):
    """The interface of a connection whose client reads more slowly than the service sends."""

    @property
    def reader(self) -> str:
        """Who reads."""

    @property
    def unread(self) -> int:
        """What waits in memory [bytes]."""

    def cut_off(self) -> None:
        """End the connection and forget what waits."""


class UnreadAnswers:
    """The connections whose clients have not read their answers yet.

    Where more waits than is allowed, the client for which most waits loses the connection that has waited longest.

    Args:
        limit: How much may wait in all [bytes].
    """

    def __init__(self, limit: int) -> None:
        self._limit = limit
        self._waiting: dict[Reader, None] = {}  # the longest waiting first

    def add(self, connection: Reader) -> None:
        """A connection whose client does not keep up; the only one of all may hold as much as it has."""
        self._waiting[connection] = None
        while len(self._waiting) > 1 and sum(each.unread for each in self._waiting) > self._limit:
            sizes: Counter[str] = Counter()
            for each in self._waiting:
                sizes[each.reader] += each.unread
            ((most, _),) = sizes.most_common(1)
            loser = next(each for each in self._waiting if each.reader == most)
            self.remove(loser)
            loser.cut_off()

    def remove(self, connection: Reader) -> None:
        """Its client has caught up, or is gone."""
        self._waiting.pop(connection, None)
