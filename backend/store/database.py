"""The database: SQLAlchemy Core over SQLite (default) or PostgreSQL, its connections, threads and migrations."""

import asyncio
import contextlib
import sqlite3
import threading
from collections.abc import Callable, Iterator, Sequence
from concurrent.futures import ThreadPoolExecutor
from contextlib import AbstractContextManager
from datetime import UTC, datetime
from pathlib import Path
from typing import Any, ParamSpec, TypeVar

from alembic import command
from alembic.config import Config
from sqlalchemy import URL, Connection, Engine, Table, create_engine, event, make_url, select
from sqlalchemy.dialects import postgresql, sqlite

from backend.store.tables import runs

P = ParamSpec("P")
T = TypeVar("T")

BUSY_TIMEOUT = 10.0  # waiting for another process's transaction [s]
CONNECT_TIMEOUT = 5  # to a PostgreSQL server [s]
# A server that hears nothing from a client for so long frees what that client held, its advisory locks too.
KEEPALIVES = {"tcp_keepalives_idle": 8, "tcp_keepalives_interval": 3, "tcp_keepalives_count": 3}


class Database:
    """Connections and transactions; safe for several threads, and several processes may share what is behind it."""

    THREADS = 4

    def __init__(self, url: str) -> None:
        self.engine = _engine(make_url(url))
        self._writer = self.engine.execution_options(writing=True)
        # SQLite lets one write at a time, and who waits looks again only now and then: our own queue is quicker.
        self._turn = threading.Lock() if self.engine.dialect.name == "sqlite" else contextlib.nullcontext()
        self._threads = ThreadPoolExecutor(self.THREADS, thread_name_prefix="store")

    async def call(self, method: Callable[P, T], *args: P.args, **kwargs: P.kwargs) -> T:
        """Run a method that reads or writes in a thread: it waits for the disk, the event loop must not."""
        return await asyncio.get_running_loop().run_in_executor(self._threads, lambda: method(*args, **kwargs))

    def reading(self) -> AbstractContextManager[Connection]:
        """A short transaction that reads; a long one would keep SQLite's writers waiting."""
        return self.engine.connect()

    @contextlib.contextmanager
    def writing(self) -> Iterator[Connection]:
        """A transaction that commits at the end of its block."""
        with self._turn, self._writer.begin() as connection:
            yield connection

    def migrate(self, revision: str = "head") -> None:
        """Bring the database up to the newest schema, or that step; safe when several processes start at once."""
        url = self.engine.url
        if url.get_backend_name() == "sqlite" and url.database:
            Path(url.database).parent.mkdir(parents=True, exist_ok=True)
        config = Config()
        config.set_main_option("script_location", "backend:migrations")
        with self.writing() as connection:
            if connection.dialect.name == "postgresql":
                connection.exec_driver_sql("SELECT pg_advisory_xact_lock(7236543)")
            config.attributes["connection"] = connection
            command.upgrade(config, revision)

    def close(self) -> None:
        """Let the threads end and give every connection back."""
        self._threads.shutdown()
        self.engine.dispose()

    def ping(self) -> None:
        """Read something; raises SQLAlchemyError where the database is not usable."""
        with self.reading() as connection:
            connection.execute(select(runs.c.id).limit(1)).all()


def utc(time: datetime) -> datetime:
    """A time from the database: SQLite forgets the zone, what is stored is UTC."""
    return time.replace(tzinfo=UTC) if time.tzinfo is None else time.astimezone(UTC)


def insert_new(connection: Connection, table: Table, rows: Sequence[dict[str, Any]]) -> None:
    """Insert the rows whose key is not there yet.

    In the key's order, whoever inserts: PostgreSQL locks row by row, and two orders would wait for each other.
    """
    key = [column.name for column in table.primary_key]
    ordered = sorted(rows, key=lambda row: [row[name] for name in key])
    insert = postgresql.insert if connection.dialect.name == "postgresql" else sqlite.insert
    connection.execute(insert(table).on_conflict_do_nothing(), ordered)


def _engine(url: URL) -> Engine:
    if url.get_backend_name() != "sqlite":
        engine = create_engine(url, pool_pre_ping=True, connect_args={"connect_timeout": CONNECT_TIMEOUT})
        event.listen(engine, "connect", _set_up_server)
        return engine
    # isolation_level None: the driver begins nothing on its own, the listener below does.
    engine = create_engine(url, connect_args={"timeout": BUSY_TIMEOUT, "isolation_level": None})
    event.listen(engine, "connect", _set_up_sqlite)
    event.listen(engine, "begin", _begin_sqlite)
    return engine


def _set_up_server(connection: Any, _: object) -> None:
    with connection.cursor() as cursor:
        for name, value in KEEPALIVES.items():
            cursor.execute(f"SET {name} = {value}")
    connection.commit()


def _set_up_sqlite(connection: sqlite3.Connection, _: object) -> None:
    mode = "WAL" if wal_is_safe(sqlite3.sqlite_version_info) else "DELETE"
    for pragma in (f"journal_mode={mode}", "synchronous=FULL", "foreign_keys=ON"):
        connection.execute(f"PRAGMA {pragma}").close()


def _begin_sqlite(connection: Connection) -> None:
    """A writer takes its lock at once: one that upgrades a read lock may fail without waiting."""
    writing = connection.get_execution_options().get("writing", False)
    connection.exec_driver_sql("BEGIN IMMEDIATE" if writing else "BEGIN")


def wal_is_safe(version: tuple[int, ...]) -> bool:
    """Whether that SQLite has the fix of the WAL-reset race (3.51.3, and 3.50.7 and 3.44.6 on their branches)."""
    return version >= (3, 51, 3) or (3, 50, 7) <= version < (3, 51) or (3, 44, 6) <= version < (3, 45)
