"""Looks for controllers of one's own at the time of need, beside the event loop."""

import asyncio

from backend.own.registry import adopt, close, controller_sources, refresh, stale

WAIT = 10.0  # a request waits so long for files that have changed; one that never ends holds nobody up for longer [s]


class Watch:
    """Notices files that have come, gone or changed.

    Args:
        limit: A run of a controller may take so long [s].
    """

    def __init__(self, limit: float) -> None:
        self._limit = limit
        adopt(controller_sources())  # from here on this process loads no file itself
        self._looking: asyncio.Task[None] | None = None

    def begin(self) -> None:
        """Have a look where something may have changed."""
        if self._looking is None and stale():
            self._looking = asyncio.create_task(asyncio.to_thread(refresh, self._limit))
            self._looking.add_done_callback(self._done)

    async def current(self) -> None:
        """What there is now is known, or it takes long."""
        self.begin()
        if self._looking is not None:
            await asyncio.wait({self._looking}, timeout=WAIT)

    async def close(self) -> None:
        """Call a look off."""
        if self._looking is not None:
            close()
            await asyncio.wait({self._looking})

    def _done(self, looking: "asyncio.Task[None]") -> None:
        self._looking = None
        if not looking.cancelled():
            looking.result()
