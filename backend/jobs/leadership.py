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
END_TIMEOUT = 5.0  # for a connection to end [s]

_TRY_LOCK = text("SELECT pg_try_advisory_lock(:id)")
_HOLDER = """
    FROM pg_locks JOIN pg_stat_activity AS holder USING (pid)
    WHERE locktype = 'advisory' AND classid = 0 AND objid = :id AND objsubid = 1 AND granted
    AND database = (SELECT oid FROM pg_database WHERE datname = current_database())
"""
_IS_OURS = text(f"SELECT application_name = current_setting('application_name') {_HOLDER}")
_END_HUNG = text(
    f"""
    WITH hung AS (SELECT application_name AS name {_HOLDER}
        AND clock_timestamp() - state_change > :seconds * interval '1 second' AND starts_with(application_name, :ours))
    SELECT pg_terminate_backend(pid, :timeout) FROM pg_stat_activity JOIN hung ON application_name = name
    WHERE datname = current_database()
    """  # noqa: S608 - of constants
)


class LeadershipLostError(Exception):
    """The lock is not held any more."""


class Leadership:
    """The lock: PostgreSQL's advisory lock of a session, or a lock on a file beside the SQLite database."""

    def __init__(self, store: Store) -> None:
        self._store = store
        self._on_server = store.engine.dialect.name != "sqlite"
        self._file = FileLock(f"{store.engine.url.database}.driver-lock", thread_local=False)
        self._connection: Connection | None = None  # that holds the lock of a server
        self._thread: ThreadPoolExecutor | None = None  # of the connection: it is for one thread at a time

    @contextlib.asynccontextmanager
    async def held(self) -> AsyncIterator[None]:
        """Wait until this service is the leader, and stay it for the length of the block."""
        self._thread = ThreadPoolExecutor(1, thread_name_prefix="leadership")
        beating = None
        try:
            while True:
                if await self._call(self._take):
                    break
                await asyncio.sleep(RETRY)
            beating = asyncio.create_task(self._beat())
            yield
        finally:
            if beating is not None:
                beating.cancel()
            await self._call(self._release)
            self._thread.shutdown(wait=False)

    async def confirm(self) -> None:
        """Raise where the lock is lost; else show that this leader does not hang.

        Raises:
            LeadershipLostError: It is.
        """
        try:
            await self._call(self._use)
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

    async def _call(self, method: Callable[[], T]) -> T:
        return await asyncio.get_running_loop().run_in_executor(self._thread, method)

    async def _beat(self) -> None:
        """Show that this leader does not hang, also where it waits for something else."""
        with contextlib.suppress(LeadershipLostError):  # the leader's own `confirm` finds out
            while True:
                await asyncio.sleep(BEAT)
                await self.confirm()

    def _take(self) -> bool:
        """Try to take the lock; where its holder hangs, have the server end that one's connections."""
        if not self._on_server:
            with contextlib.suppress(Timeout):
                self._file.acquire(timeout=0)
            return self._file.is_locked
        with contextlib.suppress(SQLAlchemyError), contextlib.ExitStack() as opened:  # one that is down may come back
            connection = self._store.engine.connect().execution_options(isolation_level="AUTOCOMMIT")
            opened.callback(connection.close)
            if connection.execute(_TRY_LOCK, {"id": LOCK_ID}).scalar_one():
                opened.pop_all()
                self._connection = connection
                return True
            limits = {"seconds": HUNG, "timeout": int(1000 * END_TIMEOUT)}
            if connection.execute(_END_HUNG, {"id": LOCK_ID, "ours": APPLICATION, **limits}).all():
                logger.warning("The leader had not used its lock for more than %g s; its connections were ended", HUNG)
        return False

    def _use(self) -> None:
        if self._connection is not None:
            self._connection.execute(text("SELECT 1")).all()

    def _release(self) -> None:
        self._file.release()
        if self._connection is not None:  # closed, not given back to the pool: with the session its lock ends
            with contextlib.suppress(SQLAlchemyError):
                self._connection.invalidate()
            self._connection.close()
            self._connection = None


def _check_lead(connection: Connection) -> None:
    """Raise where no connection of this service has the lock."""
    if True not in connection.execute(_IS_OURS, {"id": LOCK_ID}).scalars().all():
        raise LeadershipLostError
