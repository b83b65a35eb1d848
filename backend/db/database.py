"""The database: SQLAlchemy Core over SQLite (default) or PostgreSQL, its connections, threads and migrations."""

import asyncio
import contextlib
import logging
import sqlite3
import threading
import time
from collections.abc import Callable, Iterator, Sequence
from concurrent.futures import ThreadPoolExecutor
from datetime import datetime
from functools import partial
from importlib import import_module
from typing import Any, ParamSpec, TypeVar

from sqlalchemy import Connection, ExceptionContext, Row, Select, Table, event, inspect, make_url, select
from sqlalchemy.exc import DBAPIError, OperationalError, SQLAlchemyError

from backend.db import sqlite
from backend.db.columns import Now, is_intact
from backend.db.commits import Commits
from backend.db.migrations import BASELINE, REVISIONS, create, upgrade
from backend.db.server import ReadOnlyError, SilentServerError, is_deadlock, is_silent, server_engine
from backend.db.tables import runs, schema_version
from backend.errors import DamagedError

logger = logging.getLogger(__name__)

P = ParamSpec("P")
T = TypeVar("T")

READERS = 4  # threads
SERVER_WRITERS = 2  # PostgreSQL locks rows, not the database: a batch of 100,000 runs keeps no other writer waiting
MOST_DEADLOCKS = 5  # that one transaction may meet; PostgreSQL takes a second to notice one
START_TIMEOUT = 30.0  # a start waits so long for another one's migration, or for a backup [s]
DAMAGED = (
    "The database is damaged: stop the service, put a backup in its place and start again "
    "(docs/how-to/operations.md, Backup and restore)"
)


class Database:
    """Connections and transactions; safe for several threads, and several processes may share what is behind it.

    Reads and writes have threads of their own, so that no read waits behind writes. SQLite takes one write at a time:
    writes of this process queue for their one thread, and those of other processes for the file's lock.

    Attributes:
        read: Calls a method that reads in a thread: it waits for the disk, which the event loop must not.
        write: Calls a method that writes, in one transaction, in a thread of its own.
        damage: What to do about it, once a damaged page was met; None before.
    """

    def __init__(self, url: str) -> None:
        parsed = make_url(url)
        self._file = sqlite.database_file(parsed)
        self._is_sqlite = parsed.get_backend_name() == "sqlite"
        self.engine = sqlite.sqlite_engine(parsed, self._file) if self._is_sqlite else server_engine(parsed)
        self._reads = _RetryingThreads("read", READERS, self._is_locked_by_us)
        self._writes = _RetryingThreads("write", 1 if self._is_sqlite else SERVER_WRITERS, self._is_read_by_us)
        self.read, self.write = self._reads.run, self._writes.run
        event.listen(self.engine, "handle_error", self._note_damage)
        self.damage: str | None = None
        self._usable = True
        self._open_writes = 0
        self._committing = False
        self._guard = threading.local()
        self._readers: dict[Connection, float] = {}  # since when [s]
        self.commits = Commits()
        self.closed = False

    def changed(self, *job_ids: str) -> None:
        """Tell those who follow them that these jobs were changed."""
        self.commits.notify(*job_ids)

    @contextlib.contextmanager
    def reading(self, *, large: bool = False) -> Iterator[Connection]:
        """Begin a transaction that reads, a large one perhaps all rows of a table.

        Rows are processed after its end, for which SQLite's writers wait.
        """
        with self.engine.connect() as connection:
            if large:
                connection.execution_options(large=True)
            self._readers[connection] = time.monotonic()
            try:
                yield connection
            finally:
                del self._readers[connection]

    def now(self) -> datetime:
        """Return the time by the database's clock."""
        with self.reading() as connection:
            time_there: datetime = connection.execute(select(Now())).scalar_one()
        return time_there

    def guarded(self, check: Callable[[Connection], None], method: Callable[[], T]) -> T:
        """Call the method, and at the beginning of each of its transactions that write `check`, which may raise."""
        self._guard.check = check
        try:
            return method()
        finally:
            self._guard.check = None

    @contextlib.contextmanager
    def writing(self, *, large: bool = False) -> Iterator[Connection]:
        """Begin a transaction that commits at its block's end; a large one may last and need not fit into memory."""
        with self.engine.connect().execution_options(lock_timeout=sqlite.LOCK_TIMEOUT, large=large) as connection:
            transaction = connection.begin()
            self._open_writes += 1
            self._committing = False
            try:
                with transaction:
                    if (check := getattr(self._guard, "check", None)) is not None:
                        check(connection)
                    yield connection
                    self._committing = True
            finally:
                self._open_writes -= 1

    def migrate(self) -> None:
        """Bring the database to the newest schema; safe when several processes start at once.

        Raises:
            UnusableDatabaseError: It cannot be opened, is damaged, is another program's or a newer version's.
        """
        if self._file is not None:
            self._file.create()
        end = time.monotonic() + START_TIMEOUT
        while True:
            try:
                return self._migrate()
            except DBAPIError as error:
                if not sqlite.is_locked(error) or time.monotonic() > end:
                    raise sqlite.UnusableDatabaseError(f"{self._name}: {sqlite.reason(error)}") from error
            except UnicodeDecodeError as error:  # a name in the schema
                raise sqlite.UnusableDatabaseError(f"{self._name}: {sqlite.REASONS[sqlite3.SQLITE_CORRUPT]}") from error

    def close(self) -> None:
        """Wait for the threads and close every connection."""
        self.closed = True
        self._reads.close()
        self._writes.close()
        self.engine.dispose()

    def ping(self) -> None:
        """Check that the database can be read and written; raises SQLAlchemyError where it cannot.

        Damage is not searched for: it is known once a request, or a job, has met it, and stays until the next start.
        """
        if self.damage is not None:
            raise sqlite.DamagedDatabaseError(self.damage)
        with self.reading() as connection:
            connection.execute(select(runs.c.id).limit(1)).all()
            if not self._is_sqlite and connection.exec_driver_sql("SHOW transaction_read_only").scalar_one() == "on":
                raise ReadOnlyError
        if self._is_sqlite:
            sqlite.try_writing(self.engine)

    async def usable(self) -> bool:
        """Check whether the database answers and can be written to; the log has why not, once."""
        try:
            await self.read(self.ping)
        except SQLAlchemyError as error:
            if self._usable:
                logger.error("Not ready: %s", getattr(error, "orig", None) or type(error).__name__)
            self._usable = False
        else:
            self._usable = True
        return self._usable

    def _note_damage(self, context: ExceptionContext) -> None:
        if self.damage is None and sqlite.is_damaged(context.original_exception):
            self.damage = DAMAGED
            where = "" if self._file is None else f"{self._file.path}: "
            logger.error("%s%s. The first error was: %s", where, DAMAGED, context.original_exception)

    def _is_locked_by_us(self, _: float) -> bool:
        """Check whether our own lock keeps us from reading SQLite: while we write, nobody else holds one."""
        return self._is_sqlite and self._open_writes > 0

    def _is_read_by_us(self, since: float) -> bool:
        """Check whether a reader of our own, who was there before this try, keeps us from committing to SQLite."""
        return self._is_sqlite and self._committing and any(begun < since for begun in tuple(self._readers.values()))

    @property
    def _name(self) -> str:
        """Return the database as messages name it, without a password."""
        return "The database" if self._file is None else str(self._file.path)

    def _migrate(self) -> None:
        with self.writing(large=True) as connection:
            if not self._is_sqlite:
                connection.exec_driver_sql("SELECT pg_advisory_xact_lock(7236543)")
            tables = inspect(connection).get_table_names()
            if schema_version.name in tables:
                stored = connection.execute(select(schema_version)).scalar_one()
                self._check_revision(stored)
                upgrade(connection, stored)
            elif self._is_sqlite and tables:
                raise sqlite.UnusableDatabaseError(f"{self._name} is another program's database")
            else:
                create(connection)

    def _check_revision(self, stored: str) -> None:
        if stored < BASELINE:
            raise sqlite.UnusableDatabaseError(
                f"{self._name} is of Ridelab 0.3.0 or before (schema {stored}): start 0.4.0 on it once"
            )
        if stored not in REVISIONS:
            raise sqlite.UnusableDatabaseError(
                f"{self._name} is of a newer version of Ridelab (schema {stored}, this one knows {REVISIONS[-1]}): "
                "upgrade, or put the backup from before in its place"
            )


class RowStore:
    """Reads and writes the rows of one kind; every method is one short transaction, in whatever thread."""

    def __init__(self, database: Database) -> None:
        self._database = database

    def _checked(self, table: Table, query: Select[Any], what: str) -> Sequence[Row[Any]]:
        """Return the table's rows that the query finds; raises DamagedError where one is not as it was written.

        Args:
            table: Whose rows they are.
            query: Finds them.
            what: One of them, for the reader of the error.
        """
        with self._database.reading() as connection:
            rows = connection.execute(query).all()
        if not all(is_intact(table, row) for row in rows):
            raise DamagedError(what)
        return rows


class _RetryingThreads:
    """Threads for one kind of transaction, which retry while SQLite is locked, and after a deadlock on PostgreSQL.

    What queued behind one that waited in vain fails with it, and while a server is silent one at a time asks it: else
    each would wait as long, one after the other.
    """

    def __init__(self, name: str, threads: int, locked_by_us: Callable[[float], bool]) -> None:
        self._threads = ThreadPoolExecutor(threads, thread_name_prefix=f"store-{name}")
        # Checks whether a try that began then met a lock of our own, which is waited for without a time limit.
        self._locked_by_us = locked_by_us
        self._timed_out_at = 0.0
        self._timed_out: type[sqlite.DatabaseLockedError | SilentServerError] = sqlite.DatabaseLockedError
        self._asking_silent = threading.Lock()

    async def run(self, method: Callable[P, T], *args: P.args, **kwargs: P.kwargs) -> T:
        """Call a method of one transaction, and again while SQLite is locked or after a deadlock, which rolls it back.

        Raises:
            DatabaseLockedError: Another program has held a lock for longer than `LOCK_TIMEOUT`.
            SilentServerError: One before it got no answer.
        """
        submitted, work = time.monotonic(), partial(method, *args, **kwargs)
        call = self._ask_silent_server if self._timed_out is SilentServerError else self._call
        return await asyncio.get_running_loop().run_in_executor(self._threads, call, work, submitted)

    def close(self) -> None:
        """Wait for the threads to end."""
        self._threads.shutdown()

    def _ask_silent_server(self, method: Callable[[], T], submitted: float) -> T:
        if not self._asking_silent.acquire(blocking=False):
            raise self._timed_out
        try:
            answer = self._call(method, submitted)
            self._timed_out = sqlite.DatabaseLockedError
            return answer
        finally:
            self._asking_silent.release()

    def _call(self, method: Callable[[], T], submitted: float) -> T:
        end, deadlocks = time.monotonic() + sqlite.LOCK_TIMEOUT, 0
        while submitted > self._timed_out_at:
            begun = time.monotonic()
            try:
                return method()
            except OperationalError as error:
                if is_silent(error):
                    self._timed_out, self._timed_out_at = SilentServerError, time.monotonic()
                deadlocks += is_deadlock(error)
                if is_deadlock(error) and deadlocks < MOST_DEADLOCKS:
                    continue  # the transaction that it met has what it waited for
                if not sqlite.is_locked(error):
                    raise
                if time.monotonic() > end and not self._locked_by_us(begun):
                    self._timed_out, self._timed_out_at = sqlite.DatabaseLockedError, time.monotonic()
            time.sleep(sqlite.COMMIT_TIMEOUT / 2)  # readers may begin
        raise self._timed_out


def insert_new(connection: Connection, table: Table, rows: Sequence[dict[str, object]]) -> None:
    """Insert the rows whose key is not there yet.

    In the key's order, whoever inserts: PostgreSQL locks row by row, and two orders would wait for each other.
    """
    key = [column.name for column in table.primary_key]
    ordered = sorted(rows, key=lambda row: [row[name] for name in key])
    connection.execute(dialect_insert(connection, table).on_conflict_do_nothing(), ordered)


def dialect_insert(connection: Connection, table: Table) -> Any:
    """Return an INSERT of its dialect, which may say what becomes of rows that are there; imports no other dialect."""
    return import_module(f"sqlalchemy.dialects.{connection.dialect.name}").insert(table)
