"""The one place that looks whether a stored result can be answered, and what becomes of one that cannot.

Such a result is dropped as one that retention removes, so that whoever asks for it has it computed again: a run at
once, the runs of a batch by whoever drives the jobs. The links that show a damaged one say so from then on.
"""

import logging
from collections.abc import Iterable, Sequence
from typing import Any

from sqlalchemy import Connection, Row, Table, delete, or_, select, update

from backend.db.columns import Now, is_intact
from backend.db.database import Database
from backend.db.tables import (
    EXPIRED,
    EXPIRED_RESULT,
    REMOVED,
    job_runs,
    jobs,
    links,
    pinned_series,
    results,
    run_results,
)
from backend.metrics import DAMAGED_RESULTS
from backend.store.job import FINAL
from backend.store.jobs import change_state, lock

logger = logging.getLogger(__name__)


def drop_damaged_results(database: Database, rows: Iterable[Row[Any]], prefix: str = "") -> set[str]:
    """Compare results with their checksums and drop those that are not as they were written; return their keys.

    Args:
        database: It has them.
        rows: As they were read, with all columns of `results`.
        prefix: What the names of these begin with in the rows.
    """
    damaged = {row._mapping[f"{prefix}key"] for row in rows if not is_intact(results, row, prefix)}
    if damaged:
        drop_results(database, damaged)
    return damaged


def drop_results(database: Database, keys: Iterable[str]) -> None:
    """Remove those of these results that are damaged or have expired; the runs of batches that had them wait again.

    Results are locked before jobs, elsewhere jobs before results: of two transactions that meet, PostgreSQL rolls one
    back, and `Database` begins it again.
    """
    with database.writing() as connection:
        rows = _locked(connection, results, keys)
        damaged = [row.key for row in rows if not is_intact(results, row)]
        expired = [row.key for row in rows if row.status == EXPIRED]
        connection.execute(update(results).where(results.c.key.in_(damaged)).values(**EXPIRED_RESULT))
        _tell_links(connection, damaged)
        reopened = _reopen_jobs(connection, damaged + expired)
    _report("result", damaged)
    database.changed(*reopened)


def drop_damaged_pins(database: Database, rows: Iterable[Row[Any]]) -> set[str]:
    """Remove those of these pinned time histories that are not as they were written; return their keys."""
    keys = {row.result_key for row in rows if not is_intact(pinned_series, row)}
    if keys:
        with database.writing() as connection:
            rows = _locked(connection, pinned_series, keys)
            damaged = [row.result_key for row in rows if not is_intact(pinned_series, row)]
            connection.execute(delete(pinned_series).where(pinned_series.c.result_key.in_(damaged)))
            _tell_links(connection, damaged)
        _report("series", damaged)
    return keys


def _locked(connection: Connection, table: Table, keys: Iterable[str]) -> Sequence[Row[Any]]:
    """Lock these rows and read them again: another may have replaced some since."""
    (key,) = table.primary_key.columns
    return connection.execute(select(table).where(key.in_(list(keys))).order_by(key).with_for_update()).all()


def _tell_links(connection: Connection, keys: Sequence[str]) -> None:
    of_run = links.c.run_id.in_(select(run_results.c.run_id).where(run_results.c.result_key.in_(keys)))
    of_job = links.c.job_id.in_(select(job_runs.c.job_id).where(job_runs.c.result_key.in_(keys)))
    connection.execute(update(links).where(or_(of_run, of_job)).values(damaged_at=Now()))


def _reopen_jobs(connection: Connection, keys: Sequence[str]) -> list[str]:
    """Have the runs of jobs that had these results wait for them again; those of cancelled jobs once they resume."""
    # A run that failed with a reason of its own had none: it waits for nobody.
    had = job_runs.c.result_key.in_(keys) & or_(job_runs.c.status == "ok", job_runs.c.reason.is_(None))
    ids = list(
        connection.execute(select(job_runs.c.job_id).where(had).distinct().order_by(job_runs.c.job_id)).scalars()
    )
    for job_id in ids:
        lock(connection, job_id)
        job = connection.execute(select(jobs.c.kind, jobs.c.state).where(jobs.c.id == job_id)).one()
        if job.kind == REMOVED:
            continue
        waiting = "cancelled" if job.state in ("cancelled", "failed") else "waiting"
        lost = {"done": "ok", "failed": "failed"}
        for counter, status in lost.items():
            rows = update(job_runs).where(job_runs.c.job_id == job_id, had, job_runs.c.status == status)
            count = connection.execute(rows.values(status=waiting)).rowcount
            less = {counter: jobs.c[counter] - count}
            connection.execute(update(jobs).where(jobs.c.id == job_id).values(**less))
        if waiting == "waiting":
            # Also of one that runs: where another core version submitted it, it begins anew with this one's keys.
            change_state(connection, job_id, (*FINAL, "running"), "queued")
    return ids


def _report(what: str, damaged: Sequence[str]) -> None:
    if damaged:
        DAMAGED_RESULTS.labels(what).inc(len(damaged))
        logger.error("Stored, damaged and dropped, so that it is computed again: %s %s", what, ", ".join(damaged))
