"""Keeps the database within the age and the size that its operator has set."""

import asyncio
import logging
import time
from collections.abc import Awaitable, Callable
from datetime import datetime, timedelta
from typing import Any

from backend.jobs.leadership import LeadershipLostError
from backend.metrics import REMOVED, STORED_BYTES
from backend.settings import Settings
from backend.store import Store
from backend.store.retention import REMOVABLE

logger = logging.getLogger(__name__)

INTERVAL = 600.0  # between two looks [s]
YOUNGEST = timedelta(hours=1)  # what is younger stays, however large the database
JUMP = timedelta(hours=1)  # by which the database's clock goes ahead of this machine's, which nobody sets
BELIEVED_AFTER = 86400.0  # such a jump makes nothing old before then [s]


class Retention:
    """Removes what is too old, and the oldest where there is too much.

    Args:
        store: The database.
        settings: Have the limits.
        write: As `Store.write`.
    """

    def __init__(self, store: Store, settings: Settings, write: Callable[..., Awaitable[Any]]) -> None:
        self._store = store
        self._write = write
        self._days = settings.retention_days
        self._bytes = settings.retention_bytes
        self._due = time.monotonic()
        self._clock: tuple[datetime, float] | None = (
            None  # the database's, when it was last believed, and this machine's [s]
        )
        self._task: asyncio.Task[None] | None = None

    def begin_if_due(self) -> None:
        """Start a removal in the background, if it is due."""
        if time.monotonic() < self._due or (self._task is not None and not self._task.done()):
            return
        self._due = time.monotonic() + INTERVAL
        self._task = asyncio.create_task(self._apply_safely())

    async def now(self) -> datetime:
        """Return the time by which rows are old: the database's, but for a day not after its clock has jumped ahead."""
        now, seconds = await self._store.read(self._store.now), time.monotonic()
        before, since = self._clock or (now, seconds)
        expected = before + timedelta(seconds=seconds - since)
        if now > expected + JUMP and seconds < since + BELIEVED_AFTER:
            return expected
        self._clock = now, seconds
        return now

    def cancel(self) -> None:
        """Stop: another service is the leader and removes from now on."""
        if self._task is not None:
            self._task.cancel()

    async def _apply_safely(self) -> None:
        try:
            await self.apply()
        except LeadershipLostError:
            return
        except Exception:  # whatever it was, jobs go on, and it is tried again
            logger.exception("Old jobs and results could not be removed")

    async def apply(self) -> None:
        """Remove everything beyond the limits now, and what somebody's deletion left when a service ended."""
        await self._purge()
        if self._days is None and self._bytes is None:
            return
        now = await self.now()
        if self._days is not None:
            await self._remove_before(now - timedelta(days=self._days))
        size = await self._store.read(self._store.retention.size)
        while self._bytes is not None and size > self._bytes:
            before = await self._store.read(self._store.retention.oldest)
            if before is None or before > now - YOUNGEST:
                logger.warning("The database has %d bytes, and nothing more of it may be removed", size)
                break
            await self._remove_before(before + timedelta(microseconds=1))
            size = await self._store.read(self._store.retention.size)
        STORED_BYTES.set(size)

    async def _remove_before(self, before: datetime) -> None:
        for what in REMOVABLE:
            while removed := await self._write(self._store.retention.remove, what, before):
                REMOVED.labels(what).inc(removed)
                await self._purge()

    async def _purge(self) -> None:
        while await self._write(self._store.jobs.purge):
            pass
