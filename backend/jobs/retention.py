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

logger = logging.getLogger(__name__)

INTERVAL = 600.0  # between two looks [s]
YOUNGEST = timedelta(hours=1)  # what is younger stays, however large the database


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
        self._task: asyncio.Task[None] | None = None

    def begin_if_due(self) -> None:
        """Start a removal in the background, if it is due."""
        if time.monotonic() < self._due or (self._task is not None and not self._task.done()):
            return
        self._due = time.monotonic() + INTERVAL
        self._task = asyncio.create_task(self._apply_safely())

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
        now = await self._store.read(self._store.now)
        if self._days is not None:
            await self._remove_before(now - timedelta(days=self._days))
        size = await self._store.read(self._store.retention.size)
        while self._bytes is not None and size > self._bytes:
            before = await self._store.read(self._store.retention.oldest)
            if before is None or before > now - YOUNGEST:
                logger.warning("The database has %d bytes, and nothing more of it may be removed", size)
                break
            removed = await self._remove_before(before + timedelta(microseconds=1))
            size = await self._store.read(self._store.retention.size_without, size, removed)
        STORED_BYTES.set(size)

    async def _remove_before(self, before: datetime) -> int:
        """Remove jobs first: after that nothing needs their results or their roads; returns their size [bytes]."""
        size = 0
        for what, remove in (
            ("jobs", self._store.retention.remove_jobs),
            ("results", self._store.retention.remove_results),
            ("roads", self._store.retention.remove_roads),
            ("recordings", self._store.retention.remove_recordings),
        ):
            while (removed := await self._write(remove, before)).rows:
                REMOVED.labels(what).inc(removed.rows)
                size += removed.size
                await self._purge()
        return size

    async def _purge(self) -> None:
        while await self._write(self._store.jobs.purge):
            pass
