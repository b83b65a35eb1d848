"""Looks for custom controllers at the time of need, beside the event loop."""

import asyncio

from backend.custom_controllers.registry import close, controller_sources, due, refresh, set_sources

WAIT = 10.0  # a request waits so long for files that have changed; one that never ends holds nobody up for longer [s]


class Watch:
    """Notices files that have come, gone or changed.

    Args:
        limit: A run of a controller may take so long [s].
    """

    def __init__(self, limit: float) -> None:
        self._limit = limit
        set_sources(controller_sources())  # from here on this process loads no file itself
        self._look: asyncio.Task[None] | None = None

    async def refresh_if_changed(self) -> None:
        """Know what there is now, unless that takes long; nobody waits for another try of a file that was slow."""
        for _ in range(2):  # a look that began before the change does not have it
            why = due()
            if why is None:
                return
            if self._look is None or self._look.done():
                self._look = asyncio.create_task(asyncio.to_thread(refresh, self._limit))
            if why == "retry":
                return
            await asyncio.wait({self._look}, timeout=WAIT)

    async def close(self) -> None:
        """Call a look off."""
        if self._look is not None and not self._look.done():
            close()
            await asyncio.wait({self._look})
