"""The database: which runs exist, and each strategy's result once, by its content's key.

SQLAlchemy Core over SQLite (default) or PostgreSQL. Methods are synchronous and short; the service runs them
through `Store.call`.
"""

import asyncio
import sqlite3
from collections.abc import Callable, Iterable, Mapping, Sequence
from concurrent.futures import ThreadPoolExecutor
from dataclasses import dataclass
from datetime import UTC, datetime
from pathlib import Path
from typing import Any, ParamSpec, TypeVar

import orjson
from alembic import command
from alembic.config import Config
from sqlalchemy import (
    Column,
    Connection,
    DateTime,
    Engine,
    Float,
    ForeignKey,
    Integer,
    MetaData,
    Row,
    String,
    Table,
    Text,
    create_engine,
    event,
    make_url,
    select,
)
from sqlalchemy.dialects import postgresql, sqlite

P = ParamSpec("P")
T = TypeVar("T")

BUSY_TIMEOUT = 10.0  # waiting for another process's transaction [s]

metadata = MetaData(
    naming_convention={
        "pk": "pk_%(table_name)s",
        "fk": "fk_%(table_name)s_%(column_0_name)s",
        "ix": "ix_%(column_0_label)s",
    }
)

results = Table(
    "results",
    metadata,
    Column("key", String(43), primary_key=True),
    Column("strategy", String(64), nullable=False),
    Column("core_version", String(32), nullable=False),
    Column("status", String(16), nullable=False),
    Column("summary", Text, nullable=False),
    Column("compute_ms", Float, nullable=False),
    Column("created_at", DateTime(timezone=True), nullable=False),
)

runs = Table(
    "runs",
    metadata,
    Column("id", String(22), primary_key=True),
    Column("core_version", String(32), nullable=False),
    Column("schema_version", Integer, nullable=False),
    Column("scenario", Text, nullable=False),
    Column("created_at", DateTime(timezone=True), nullable=False),
)

run_results = Table(
    "run_results",
    metadata,
    Column("run_id", String(22), ForeignKey("runs.id"), primary_key=True),
    Column("position", Integer, primary_key=True),
    Column("result_key", String(43), ForeignKey("results.key"), nullable=False, index=True),
)


@dataclass(frozen=True, slots=True, kw_only=True)
class StoredResult:
    """One strategy's result without its series; `summary` holds plain JSON values."""

    key: str
    strategy: str
    status: str
    summary: dict[str, Any]
    compute_ms: float


@dataclass(frozen=True, slots=True, kw_only=True)
class StoredRun:
    """A run and its results in the order they are shown; immutable once stored."""

    id: str
    core_version: str
    schema_version: int
    scenario: dict[str, Any]
    results: tuple[StoredResult, ...]


class Store:
    """Reads and writes runs; safe for several threads and several processes."""

    THREADS = 4

    def __init__(self, url: str) -> None:
        self.engine = _engine(url)
        self._writing = self.engine.execution_options(writing=True)
        self._threads = ThreadPoolExecutor(self.THREADS, thread_name_prefix="store")

    async def call(self, method: Callable[P, T], *args: P.args, **kwargs: P.kwargs) -> T:
        """Run one of the methods below in a thread: it waits for the disk, the event loop must not."""
        return await asyncio.get_running_loop().run_in_executor(self._threads, lambda: method(*args, **kwargs))

    def migrate(self) -> None:
        """Bring the database to the newest schema; safe when several processes start at once."""
        url = self.engine.url
        if url.get_backend_name() == "sqlite" and url.database:
            Path(url.database).parent.mkdir(parents=True, exist_ok=True)
        config = Config()
        config.set_main_option("script_location", "backend:migrations")
        with self._writing.begin() as connection:
            if connection.dialect.name == "postgresql":
                connection.exec_driver_sql("SELECT pg_advisory_xact_lock(7236543)")
            config.attributes["connection"] = connection
            command.upgrade(config, "head")

    def close(self) -> None:
        """Let the threads end and give every connection back."""
        self._threads.shutdown()
        self.engine.dispose()

    def ping(self) -> None:
        """Read something; raises SQLAlchemyError where the database is not usable."""
        with self.engine.connect() as connection:
            connection.execute(select(runs.c.id).limit(1)).all()

    def load_run(self, run_id: str) -> StoredRun | None:
        """The run of that id, if it is stored."""
        with self.engine.connect() as connection:
            return _load_run(connection, run_id)

    def load_results(self, keys: Iterable[str]) -> dict[str, StoredResult]:
        """Those of the results that are stored, by key."""
        with self.engine.connect() as connection:
            rows = connection.execute(select(results).where(results.c.key.in_(list(keys)))).all()
        return {row.key: _result(row) for row in rows}

    def save_run(
        self,
        *,
        run_id: str,
        core_version: str,
        schema_version: int,
        scenario: Mapping[str, Any],
        outcomes: Sequence[StoredResult],
    ) -> StoredRun:
        """Commit a run and what is not yet stored of its results; returns it as it stands in the database.

        Where another process stored the same run first, that one stays: content-addressed results never change.
        """
        now = datetime.now(UTC)
        with self._writing.begin() as connection:
            _insert_new(connection, results, [_result_row(item, core_version, now) for item in outcomes])
            _insert_new(
                connection,
                runs,
                [
                    {
                        "id": run_id,
                        "core_version": core_version,
                        "schema_version": schema_version,
                        "scenario": orjson.dumps(scenario).decode(),
                        "created_at": now,
                    }
                ],
            )
            members = [
                {"run_id": run_id, "position": position, "result_key": item.key}
                for position, item in enumerate(outcomes)
            ]
            _insert_new(connection, run_results, members)
            stored = _load_run(connection, run_id)
        if stored is None:
            raise RuntimeError("A run was not there right after it was stored")
        return stored


def _load_run(connection: Connection, run_id: str) -> StoredRun | None:
    head = connection.execute(select(runs).where(runs.c.id == run_id)).one_or_none()
    if head is None:
        return None
    members = connection.execute(
        select(results)
        .join(run_results, run_results.c.result_key == results.c.key)
        .where(run_results.c.run_id == run_id)
        .order_by(run_results.c.position)
    ).all()
    return StoredRun(
        id=head.id,
        core_version=head.core_version,
        schema_version=head.schema_version,
        scenario=orjson.loads(head.scenario),
        results=tuple(_result(row) for row in members),
    )


def _result(row: Row[Any]) -> StoredResult:
    return StoredResult(
        key=row.key,
        strategy=row.strategy,
        status=row.status,
        summary=orjson.loads(row.summary),
        compute_ms=row.compute_ms,
    )


def _result_row(item: StoredResult, core_version: str, now: datetime) -> dict[str, Any]:
    return {
        "key": item.key,
        "strategy": item.strategy,
        "core_version": core_version,
        "status": item.status,
        "summary": orjson.dumps(item.summary).decode(),
        "compute_ms": item.compute_ms,
        "created_at": now,
    }


def _insert_new(connection: Connection, table: Table, rows: list[dict[str, Any]]) -> None:
    """Insert the rows whose key is not there yet."""
    insert = postgresql.insert if connection.dialect.name == "postgresql" else sqlite.insert
    connection.execute(insert(table).on_conflict_do_nothing(), rows)


def _engine(url: str) -> Engine:
    if make_url(url).get_backend_name() != "sqlite":
        return create_engine(url, pool_pre_ping=True)
    # isolation_level None: the driver begins nothing on its own, the listener below does.
    engine = create_engine(url, connect_args={"timeout": BUSY_TIMEOUT, "isolation_level": None})
    event.listen(engine, "connect", _set_up_sqlite)
    event.listen(engine, "begin", _begin_sqlite)
    return engine


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
