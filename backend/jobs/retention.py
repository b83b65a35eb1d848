"""Keeps the database within an age and a size, where its operator has set them."""

import logging
import time
from datetime import UTC, datetime, timedelta

from backend.metrics import REMOVED, STORED_BYTES
from backend.settings import Settings
from backend.store import Store

logger = logging.getLogger(__name__)

INTERVAL = 600.0  # between two looks [s]
YOUNGEST = timedelta(hours=1)  # what is younger stays, however large the database


class Retention:
    """Removes what is too old or too much; its methods belong to the event loop."""

    def __init__(self, store: Store, settings: Settings) -> None:
        self._store = store
        self._days = settings.retention_days
        self._bytes = settings.retention_bytes
        self._due = time.monotonic()

    async def apply(self) -> None:
        """Remove what is to be removed, if it is time for it."""
        if (self._days is None and self._bytes is None) or time.monotonic() < self._due:
            return
        if self._days is not None:
            await self._remove_before(datetime.now(UTC) - timedelta(days=self._days))
        size = await self._store.read(self._store.retention.size)
        while self._bytes is not None and size > self._bytes:
            before = await self._store.read(self._store.retention.oldest)
            if before is None or before > datetime.now(UTC) - YOUNGEST:
                logger.warning("The database has %d bytes, and nothing more of it may be removed", size)
                break
            await self._remove_before(before + timedelta(microseconds=1))
            size = await self._store.read(self._store.retention.size)
        STORED_BYTES.set(size)
        self._due = time.monotonic() + INTERVAL

    async def _remove_before(self, before: datetime) -> None:
        """Jobs first: then nothing needs their results."""
        for what, remove in (
            ("jobs", self._store.retention.remove_jobs),
            ("results", self._store.retention.remove_results),
        ):
            while removed := await self._store.write(remove, before):
                REMOVED.labels(what).inc(removed)
