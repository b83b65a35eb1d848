"""Whose turn it is: one computation at a time, what a reader waits for before what fills the rest of the page."""

import asyncio
from collections import Counter
from collections.abc import AsyncIterator, Iterator
from contextlib import asynccontextmanager, contextmanager


class Turns:
    """Turns are given in the order asked for; while something is `ahead`, to that alone. For one event loop."""

    def __init__(self) -> None:
        self._taken = False
        self._ahead: Counter[str] = Counter()
        self._waiting: list[tuple[str, asyncio.Future[None]]] = []

    @contextmanager
    def ahead(self, key: str) -> Iterator[None]:
        """Meanwhile the turns are for this key, and for others that are ahead."""
        self._ahead[key] += 1
        try:
            yield
        finally:
            self._ahead[key] -= 1
            self._ahead += Counter()  # without what has come to nought
            self._give()

    @asynccontextmanager
    async def turn(self, key: str) -> AsyncIterator[None]:
        """Wait for one's turn and have it."""
        place = (key, asyncio.get_running_loop().create_future())
        self._waiting.append(place)
        self._give()
        try:
            await place[1]
            yield
        finally:
            if place in self._waiting:  # called off before its turn came
                self._waiting.remove(place)
            else:
                self._taken = False
            self._give()

    def _give(self) -> None:
        if self._taken:
            return
        for place in self._waiting:
            if not place[1].cancelled() and (not self._ahead or place[0] in self._ahead):
                self._taken = True
                self._waiting.remove(place)
                place[1].set_result(None)
                return
