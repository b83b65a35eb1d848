"""Leader election among the services on one database: the leader holds a lock that ends with its process."""

import asyncio
import contextlib
from collections.abc import AsyncIterator
from pathlib import Path

from filelock import FileLock, Timeout
from sqlalchemy import Connection, text
from sqlalchemy.exc import SQLAlchemyError

from backend.store import Store

LOCK_ID = 7236544  # of PostgreSQL's advisory locks; migrations have the number before it
RETRY = 2.0  # between two tries to get it [s]


class LeadershipLostError(Exception):
    """The connection that held the lock is closed, and the lock with it."""


class Leadership:
    """The lock: PostgreSQL's advisory lock of a session, or a lock on a file beside the SQLite database."""

    def __init__(self, store: Store) -> None:
        self._store = store
        self._connection: Connection | None = None

    @contextlib.asynccontextmanager
    async def held(self) -> AsyncIterator["Leadership"]:
        """Wait until this service is the leader, and stay it for the length of the block."""
        url = self._store.engine.url
        if url.get_backend_name() != "sqlite":
            async with self._session_lock():
                yield self
        elif url.database in (None, "", ":memory:"):
            yield self
        else:
            lock = FileLock(Path(str(url.database) + ".driver-lock"), thread_local=False)
            while True:
                try:
                    lock.acquire(timeout=0)
                    break
                except Timeout:
                    await asyncio.sleep(RETRY)
            try:
                yield self
            finally:
                lock.release()

    async def confirm(self) -> None:
        """Raise where the lock is lost.

        Raises:
            LeadershipLostError: It is not.
        """
        connection = self._connection
        if connection is None:
            return
        try:
            await self._store.read(lambda: connection.execute(text("SELECT 1")).all())
        except SQLAlchemyError as error:
            raise LeadershipLostError from error

    @contextlib.asynccontextmanager
    async def _session_lock(self) -> AsyncIterator[None]:
        connection = await self._wait_for_session_lock()
        self._connection = connection
        try:
            yield
        finally:
            self._connection = None
            # Closed, not given back to the pool: with the session its lock ends.
            await self._store.read(_end, connection)

    async def _wait_for_session_lock(self) -> Connection:
        while True:
            with contextlib.suppress(SQLAlchemyError):  # a database that is down now may come back
                connection = await self._store.read(_try_lock, self._store)
                if connection is not None:
                    return connection
            await asyncio.sleep(RETRY)


def _try_lock(store: Store) -> Connection | None:
    connection = store.engine.connect().execution_options(isolation_level="AUTOCOMMIT")
    try:
        if connection.execute(text("SELECT pg_try_advisory_lock(:id)"), {"id": LOCK_ID}).scalar_one():
            return connection
    except SQLAlchemyError:
        connection.close()
        raise
    connection.close()
    return None


def _end(connection: Connection) -> None:
    with contextlib.suppress(SQLAlchemyError):
        connection.invalidate()
    connection.close()
