"""Leader election among the services on one database: the leader holds a lock that ends with its process.

On PostgreSQL a leader that hangs loses the lock too. The server notes when the connection that holds it was last used,
by its own clock. Where that is too long ago, who waits for the lock has the server end all connections of the hanging
service: what that one had begun to write is rolled back, and when it wakes, what it wants to write as the leader fails.
"""

import asyncio
import contextlib
import logging
from collections.abc import AsyncIterator, Callable
from concurrent.futures import ThreadPoolExecutor
from functools import partial
from pathlib import Path
from typing import ParamSpec, TypeVar

from filelock import FileLock, Timeout
from sqlalchemy import Connection, text
from sqlalchemy.exc import SQLAlchemyError

from backend.db.server import APPLICATION
from backend.store import Store

logger = logging.getLogger(__name__)

P = ParamSpec("P")
T = TypeVar("T")

LOCK_ID = 7236544  # of PostgreSQL's advisory locks; migrations have the number before it
RETRY = 2.0  # between two tries to get it [s]
BEAT = 2.0  # the leader uses its connection so often [s]
HUNG = 12.0  # a leader that has not used it for so long hangs [s]
END_TIMEOUT = 5.0  # for its connections to end [s]

_HOLDER = """
    FROM pg_locks JOIN pg_stat_activity AS holder USING (pid)
    WHERE locktype = 'advisory' AND classid = 0 AND objid = :id AND objsubid = 1 AND granted
    AND database = (SELECT oid FROM pg_database WHERE datname = current_database())
"""
_IS_OURS = text(f"SELECT application_name = current_setting('application_name') {_HOLDER}")
_HUNG = text(
    f"SELECT pid, application_name {_HOLDER} AND clock_timestamp() - state_change > :seconds * interval '1 second'"
)
_END_OTHERS = text(
    "SELECT pg_terminate_backend(pid, :timeout) FROM pg_stat_activity "
    "WHERE datname = current_database() AND application_name = :name AND pid <> :pid"
)
_END_HOLDER = text("SELECT pg_terminate_backend(:pid, :timeout)")


class LeadershipLostError(Exception):
    """The lock is not held any more."""


class Leadership:
    """The lock: PostgreSQL's advisory lock of a session, or a lock on a file beside the SQLite database."""

    def __init__(self, store: Store) -> None:
        self._store = store
        self._on_server = store.engine.dialect.name != "sqlite"
        self._connection: Connection | None = None
        self._thread: ThreadPoolExecutor | None = None  # of the connection: it is for one thread at a time

    @contextlib.asynccontextmanager
    async def held(self) -> AsyncIterator[None]:
        """Wait until this service is the leader, and stay it for the length of the block."""
        url = self._store.engine.url
        if self._on_server:
            async with self._session_lock():
                yield
        else:
            lock = FileLock(Path(f"{url.database}.driver-lock"), thread_local=False)
            while True:
                try:
                    lock.acquire(timeout=0)
                    break
                except Timeout:
                    await asyncio.sleep(RETRY)
            try:
                yield
            finally:
                lock.release()

    async def confirm(self) -> None:
        """Raise where the lock is lost; else show that this leader does not hang.

        Raises:
            LeadershipLostError: It is.
        """
        connection, thread = self._connection, self._thread
        if connection is None or thread is None:
            return
        try:
            await asyncio.get_running_loop().run_in_executor(thread, _use, connection)
        except SQLAlchemyError as error:
            raise LeadershipLostError from error

    async def write(self, method: Callable[P, T], *args: P.args, **kwargs: P.kwargs) -> T:
        """Write as `Store.write` does, but nothing where another service has become the leader.

        Raises:
            LeadershipLostError: One has.
        """
        if not self._on_server:
            return await self._store.write(method, *args, **kwargs)
        return await self._store.write(partial(self._store.guarded, _check_lead, partial(method, *args, **kwargs)))

    @contextlib.asynccontextmanager
    async def _session_lock(self) -> AsyncIterator[None]:
        connection = await self._wait_for_session_lock()
        thread = ThreadPoolExecutor(1, thread_name_prefix="leadership")
        self._connection, self._thread = connection, thread
        beating = asyncio.create_task(self._beat())
        try:
            yield
        finally:
            beating.cancel()
            self._connection = self._thread = None
            # Closed, not given back to the pool: with the session its lock ends.
            await asyncio.get_running_loop().run_in_executor(thread, _end, connection)
            thread.shutdown(wait=False)

    async def _beat(self) -> None:
        """Show that this leader does not hang, also where it waits for something else."""
        with contextlib.suppress(LeadershipLostError):  # the leader's own `confirm` finds out
            while True:
                await asyncio.sleep(BEAT)
                await self.confirm()

    async def _wait_for_session_lock(self) -> Connection:
        while True:
            with contextlib.suppress(SQLAlchemyError):  # a database that is down now may come back
                connection = await self._store.read(_try_lock, self._store)
                if connection is not None:
                    return connection
                if await self._store.read(_end_hung_leader, self._store):
                    continue
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


def _end_hung_leader(store: Store) -> bool:
    """Have the server end the connections of a leader that hangs; return whether there was one."""
    with store.engine.connect().execution_options(isolation_level="AUTOCOMMIT") as connection:
        holder = connection.execute(_HUNG, {"id": LOCK_ID, "seconds": HUNG}).first()
        if holder is None:
            return False
        values = {"pid": holder.pid, "timeout": int(1000 * END_TIMEOUT)}
        if holder.application_name.startswith(APPLICATION):  # else it cannot be told from other programs
            connection.execute(_END_OTHERS, {**values, "name": holder.application_name}).all()
        # The lock last: when another service gets it, nothing else of the hanging one is left.
        ended = bool(connection.execute(_END_HOLDER, values).scalar_one())
    if ended:
        logger.warning(
            "The leader had not used its lock's connection for more than %g s; its connections were ended", HUNG
        )
    return ended


def _use(connection: Connection) -> None:
    connection.execute(text("SELECT 1")).all()


def _check_lead(connection: Connection) -> None:
    """Raise where no connection of this service has the lock."""
    if True not in connection.execute(_IS_OURS, {"id": LOCK_ID}).scalars().all():
        raise LeadershipLostError


def _end(connection: Connection) -> None:
    with contextlib.suppress(SQLAlchemyError):
        connection.invalidate()
    connection.close()
