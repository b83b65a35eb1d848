"""Looks for controllers of one's own at the time of need, beside the event loop."""

import asyncio
from collections.abc import Callable

from backend.custom_controllers.registry import adopt, close, controller_sources, refresh, retry_due, stale, try_again

WAIT = 10.0  # a request waits so long for files that have changed; one that never ends holds nobody up for longer [s]


class Watch:
    """Notices files that have come, gone or changed.

    Args:
        limit: A run of a controller may take so long [s].
    """

    def __init__(self, limit: float) -> None:
        self._limit = limit
        adopt(controller_sources())  # from here on this process loads no file itself
        self._looks: dict[Callable[[float], None], asyncio.Task[None]] = {}

    async def current(self) -> None:
        """What there is now is known, or it takes long; nobody waits for another try of a file that was slow."""
        self._begin(refresh, stale)
        self._begin(try_again, retry_due)
        if refresh in self._looks:
            await asyncio.wait({self._looks[refresh]}, timeout=WAIT)

    async def close(self) -> None:
        """Call every look off."""
        if self._looks:
            close()
            await asyncio.wait(self._looks.values())

    def _begin(self, look: Callable[[float], None], due: Callable[[], bool]) -> None:
        if look not in self._looks and due():
            self._looks[look] = asyncio.create_task(asyncio.to_thread(look, self._limit))
            self._looks[look].add_done_callback(lambda task: self._done(look, task))

    def _done(self, look: Callable[[float], None], task: "asyncio.Task[None]") -> None:
        del self._looks[look]
        if not task.cancelled():
            task.result()
