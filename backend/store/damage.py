"""What becomes of stored results that turn out to be damaged, or to be none.

Such a result is dropped as one that retention removes, so that whoever asks for it has it computed again: a run at
once, the runs of a batch by whoever drives the jobs. The links that show a damaged one say so from then on.

Until 0.4.0 every failure was stored, also one that the machine was to blame for. Those have no kind.
"""

import logging
from collections.abc import Callable, Iterable, Sequence
from functools import partial
from typing import Any

from sqlalchemy import Connection, Row, Table, delete, or_, select, update

from backend.db.checksum import is_intact
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
from backend.db.types import Now
from backend.metrics import DAMAGED_RESULTS
from backend.outcome import FAILED, UNSTORED_FAILURE
from backend.store.job import FINAL
from backend.store.jobs import change_state, lock

logger = logging.getLogger(__name__)

DROPPED_AT_ONCE = 10_000  # failures of jobs that have one of them; a statement may name 32,766 values


def is_intact_result(row: Row[Any], prefix: str = "") -> bool:
    """Whether a row of `results` is as it was written; one that a version without checksums has emptied counts as such.

    Args:
        row: With all its columns.
        prefix: Of their names in the row.
    """
    return row._mapping[f"{prefix}status"] == EXPIRED or is_intact(results, row, prefix)


def may_have_passed(status: str, summary: str) -> bool:
    """Check whether a stored result is a failure of before there were kinds: the machine may have been to blame."""
    return status == FAILED and '"kind":' not in str(summary)


def is_result(row: Row[Any], prefix: str = "") -> bool:
    """Check whether a row of `results` can be answered; arguments as of `is_intact_result`."""
    columns = row._mapping
    return is_intact_result(row, prefix) and not may_have_passed(
        columns[f"{prefix}status"], columns[f"{prefix}summary"]
    )


def drop_results(database: Database, keys: Iterable[str]) -> None:
    """Remove those of these results that cannot be answered; the runs of batches that had them wait again.

    Results are locked before jobs, elsewhere jobs before results: of two transactions that meet, PostgreSQL rolls one
    back, and `Database` begins it again.
    """
    with database.writing() as connection:
        keys = set(keys)
        dropped = _unlike(connection, results, keys | _other_failures(connection, keys), is_result)
        damaged = _unlike(connection, results, dropped, is_intact_result)
        expire = update(results).where(results.c.key.in_(dropped))
        connection.execute(expire.values(**EXPIRED_RESULT | {"summary": UNSTORED_FAILURE.decode()}))
        connection.execute(expire.where(results.c.key.in_(damaged)).values(**EXPIRED_RESULT))
        _tell_links(connection, damaged)
        reopened = _reopen_jobs(connection, dropped)
    _report("result", damaged)
    database.changed(*reopened)


def _other_failures(connection: Connection, keys: Iterable[str]) -> set[str]:
    """Return failures without a kind that jobs have beside these: a job that goes on looks for its runs once."""
    ids = select(job_runs.c.job_id).where(job_runs.c.result_key.in_(keys))
    beside = job_runs.c.result_key == results.c.key
    unknown = results.c.status == FAILED, results.c.summary.not_like('%"kind":%')
    query = select(results.c.key).join_from(results, job_runs, beside).where(job_runs.c.job_id.in_(ids), *unknown)
    return set(connection.execute(query.limit(DROPPED_AT_ONCE)).scalars())


def drop_pins(database: Database, keys: Iterable[str]) -> None:
    """Remove those of these pinned time histories that are damaged."""
    with database.writing() as connection:
        damaged = _unlike(connection, pinned_series, keys, partial(is_intact, pinned_series))
        connection.execute(delete(pinned_series).where(pinned_series.c.result_key.in_(damaged)))
        _tell_links(connection, damaged)
    _report("series", damaged)


def _unlike(connection: Connection, table: Table, keys: Iterable[str], sound: Callable[[Row[Any]], bool]) -> list[str]:
    """Lock these rows; return the keys of those that still are not sound: another may have replaced some meanwhile."""
    (key,) = table.primary_key.columns
    rows = connection.execute(select(table).where(key.in_(list(keys))).order_by(key).with_for_update()).all()
    return [row[0] for row in rows if not sound(row)]


def _tell_links(connection: Connection, keys: Sequence[str]) -> None:
    of_run = links.c.run_id.in_(select(run_results.c.run_id).where(run_results.c.result_key.in_(keys)))
    of_job = links.c.job_id.in_(select(job_runs.c.job_id).where(job_runs.c.result_key.in_(keys)))
    connection.execute(update(links).where(or_(of_run, of_job)).values(damaged_at=Now()))


def _reopen_jobs(connection: Connection, keys: Sequence[str]) -> list[str]:
    """Have the runs of jobs that had these results wait for them again; those of cancelled jobs once they resume."""
    had = job_runs.c.result_key.in_(keys) & job_runs.c.status.in_(("ok", "failed"))
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
