"""Reads a whole database and says what in it is not as it was written.

Answers check the rows that they show. This also finds what no answer reads, and what a damaged index hides.
"""

import logging
from collections.abc import Iterator, Sequence
from dataclasses import dataclass, field
from typing import Any

import orjson
from sqlalchemy import Column, Connection, Row, Select, Table, case, func, or_, select, true, tuple_
from sqlalchemy.exc import SQLAlchemyError

from backend.db.checksum import UNCHECKED, is_intact
from backend.db.database import DAMAGED, Database
from backend.db.tables import (
    REMOVED,
    job_events,
    job_runs,
    jobs,
    links,
    pinned_series,
    recordings,
    results,
    roads,
    runs,
    trials,
)
from backend.errors import DamagedError
from backend.store.damage import drop_pins, drop_results, is_intact_result

logger = logging.getLogger(__name__)

ROWS_AT_ONCE = 500  # rows read in one transaction
UNREADABLE = (DamagedError, ValueError, TypeError)  # text that is no JSON, no time, or no text; a number for text
SEALED = (results, pinned_series, runs, links, roads, recordings, jobs, job_runs, trials)


@dataclass(frozen=True, slots=True, kw_only=True)
class Verdict:
    """What was found in a database.

    Attributes:
        rows: By table, how many were read.
        unchecked: By table, how many of them are of a version that wrote no checksums.
        damaged: By table, the keys of those that are not as they were written.
        structure: What the database itself says of its pages, indexes and references.
    """

    rows: dict[str, int] = field(default_factory=dict)
    unchecked: dict[str, int] = field(default_factory=dict)
    damaged: dict[str, list[str]] = field(default_factory=dict)
    structure: list[str] = field(default_factory=list)

    @property
    def sound(self) -> bool:
        """Whether nothing was found."""
        return not self.structure and not any(self.damaged.values())

    def lines(self) -> list[str]:
        """It in words, a line a table and a line for each thing that was found."""
        lines = []
        for table, count in self.rows.items():
            damaged = self.damaged[table]
            old = f", {self.unchecked[table]} of a version without checksums" if self.unchecked[table] else ""
            lines.append(f"{table}: {count} rows, {len(damaged)} damaged{old}")
            lines += [f"  {key}" for key in damaged]
        return lines + self.structure


def verify(database: Database) -> Verdict:
    """Read every row and compare it with its checksum; of SQLite also pages, indexes and references.

    Rows are read page by page, so that writers wait for no more than one, and for SQLite's own check.

    Raises:
        SQLAlchemyError: A page cannot be read at all.
    """
    verdict = Verdict()
    verdict.structure.extend(_structure(database))
    for table in SEALED:
        verdict.rows[table.name] = verdict.unchecked[table.name] = 0
        damaged = verdict.damaged[table.name] = []
        for key, row in _rows(database, table):
            verdict.rows[table.name] += 1
            verdict.unchecked[table.name] += row is not None and row.checksum == UNCHECKED
            if row is None or not (is_intact_result(row) if table is results else is_intact(table, row)):
                damaged.append(" ".join(map(str, key)))
    with database.reading() as connection:
        damaged = verdict.damaged[jobs.name]
        damaged += [job_id for job_id in _unlike_their_last_event(connection) if job_id not in damaged]
        verdict.structure.extend(_counts(connection))
    return verdict


async def verify_at_start(database: Database) -> None:
    """Say in the log what a SQLite file has that was not written so, and drop what can be computed again."""
    if database.engine.dialect.name != "sqlite":
        return
    try:
        verdict = await database.read(verify, database)
        if verdict.sound or database.closed:
            return
        logger.error("The database is damaged (docs/how-to/operations.md):\n%s", "\n".join(verdict.lines()))
        if verdict.structure:
            database.damage = DAMAGED
        else:
            await database.write(_drop_damaged, database, verdict)
    except SQLAlchemyError as error:  # damage that was met is noted by the database
        logger.error("The database cannot be read as a whole: %s", getattr(error, "orig", error))


def _drop_damaged(database: Database, verdict: Verdict) -> None:
    """Remove what can be computed again: results and pinned time histories."""
    if keys := verdict.damaged["results"]:
        drop_results(database, keys)
    if keys := verdict.damaged["pinned_series"]:
        drop_pins(database, keys)


def _structure(database: Database) -> Iterator[str]:
    """What SQLite says of its file; PostgreSQL checks its pages itself where it has checksums (initdb -k)."""
    if database.engine.dialect.name != "sqlite":
        return
    with database.reading() as connection:
        said = [row[0] for row in connection.exec_driver_sql("PRAGMA integrity_check").all()]
        lost = connection.exec_driver_sql("PRAGMA foreign_key_check").all()
    yield from (f"database: {line}" for line in said if line != "ok")
    yield from (f"{row[0]}: row {row[1]} names a row of {row[2]} that is not there" for row in lost)


def _rows(database: Database, table: Table) -> Iterator[tuple[Sequence[Any], Row[Any] | None]]:
    """All rows with their keys, in the keys' order; None for one that cannot even be read as what it is."""
    columns = list(table.primary_key)
    keys, whole = select(*columns).order_by(*columns).limit(ROWS_AT_ONCE), select(table).order_by(*columns)
    after: Sequence[Any] | None = None
    while not database.closed:
        behind = true() if after is None else tuple_(*columns) > tuple_(*after)
        with database.reading() as connection:
            page = [tuple(key) for key in connection.execute(keys.where(behind)).all()]
            if not page or page[-1] == after:  # a key that is no text is read as another one
                return
            try:
                rows: list[Row[Any] | None] = [*connection.execute(whole.where(behind).limit(ROWS_AT_ONCE)).all()]
            except UNREADABLE:
                rows = [_row(connection, whole, columns, key) for key in page]
        yield from zip(page, rows, strict=True)
        after = page[-1]


def _row(
    connection: Connection, whole: Select[Any], columns: Sequence[Column[Any]], key: Sequence[Any]
) -> Row[Any] | None:
    try:
        return connection.execute(whole.where(tuple_(*columns) == tuple_(*key))).one()
    except UNREADABLE:
        return None


def _unlike_their_last_event(connection: Connection) -> Iterator[str]:
    """Jobs that are not where their last event says: what changes as they go on has no checksum.

    The counts of a sweep are those of its runs (`_counts`); a tuning's batch changes without an event.
    """
    ids = select(jobs.c.id).where(jobs.c.kind != REMOVED, jobs.c.checksum != UNCHECKED).order_by(jobs.c.id)
    last = (
        select(jobs.c.state, jobs.c.done, jobs.c.failed, jobs.c.progress, job_events.c.data)
        .join(job_events, job_events.c.job_id == jobs.c.id)
        .order_by(job_events.c.number.desc())
        .limit(1)
    )
    for job_id in connection.execute(ids).scalars().all():
        try:
            row = connection.execute(last.where(jobs.c.id == job_id)).one_or_none()
            event = {} if row is None else orjson.loads(row.data)
        except UNREADABLE:
            yield job_id
            continue
        if row is None:
            continue
        now = {name: value for name, value in row.progress.items() if name != "batch"}
        if now:
            now |= {"done": row.done, "failed": row.failed}
        now["state"] = row.state
        if {name: event.get(name) for name in now} != now:
            yield job_id


def _counts(connection: Connection) -> Iterator[str]:
    """Jobs whose counts are not those of their runs, and runs that have a result which is not there."""
    count = {status: func.sum(case((job_runs.c.status == status, 1), else_=0)) for status in ("ok", "failed")}
    of_job = (
        select(jobs.c.id)
        .join(job_runs, job_runs.c.job_id == jobs.c.id)
        .where(jobs.c.kind != REMOVED)
        .group_by(jobs.c.id, jobs.c.total, jobs.c.done, jobs.c.failed)
        .having(
            or_(func.count() != jobs.c.total, count["ok"] != jobs.c.done, count["failed"] != jobs.c.failed),
        )
    )
    for job_id in connection.execute(of_job.order_by(jobs.c.id)).scalars():
        yield f"jobs: {job_id} counts other runs than it has"
    without = (
        select(job_runs.c.job_id, job_runs.c.position)
        .join_from(job_runs, results, job_runs.c.result_key == results.c.key, isouter=True)
        .join(jobs, jobs.c.id == job_runs.c.job_id)
        .where(job_runs.c.status == "ok", results.c.key.is_(None), jobs.c.kind != REMOVED)
        .order_by(job_runs.c.job_id, job_runs.c.position)
    )
    for job_id, position in connection.execute(without).all():
        yield f"job_runs: {job_id} {position} names a result that is not there"
