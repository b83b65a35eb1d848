"""Checksums of stored results, and what becomes of those that turn out to be damaged.

A damaged result is dropped as one that retention removes, so that whoever asks for it has it computed again: a run at
once, the runs of a batch by whoever drives the jobs. The links that show it say so from then on.
"""

import hashlib
import logging
from collections.abc import Callable, Iterable, Sequence
from typing import Any

from sqlalchemy import Connection, Row, Table, delete, or_, select, update

from backend.db.clock import Now
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


def of_result(key: str, status: str, summary: bytes) -> str:
    """The checksum of a result; it names its key, so that a row in another one's place is noticed."""
    return _digest(key.encode(), status.encode(), summary)


def of_series(key: str, content: bytes) -> str:
    """The checksum of pinned time histories."""
    return _digest(key.encode(), content)


def is_intact(row: Row[Any]) -> bool:
    """Whether a row of `results` is as it was written.

    One of an older version, without a checksum, counts as such; so does one that its retention has emptied meanwhile.
    """
    unchecked = row.checksum is None or row.status == EXPIRED
    return unchecked or row.checksum == of_result(row.key, row.status, row.summary.encode())


def drop_results(database: Database, keys: Iterable[str]) -> None:
    """Remove those of these results that are damaged; the runs of batches that had them wait again."""
    with database.writing() as connection:
        damaged = _damaged(connection, results, keys, is_intact)
        connection.execute(update(results).where(results.c.key.in_(damaged)).values(**EXPIRED_RESULT))
        _tell_links(connection, damaged)
        reopened = _reopen_jobs(connection, damaged)
    _report("result", damaged)
    database.changed(*reopened)


def drop_pins(database: Database, keys: Iterable[str]) -> None:
    """Remove those of these pinned time histories that are damaged."""
    with database.writing() as connection:
        damaged = _damaged(connection, pinned_series, keys, is_intact_pin)
        connection.execute(delete(pinned_series).where(pinned_series.c.result_key.in_(damaged)))
        _tell_links(connection, damaged)
    _report("series", damaged)


def is_intact_pin(row: Row[Any]) -> bool:
    """Whether a row of `pinned_series` is as it was written."""
    return row.checksum is None or row.checksum == of_series(row.result_key, bytes(row.content))


def _damaged(
    connection: Connection, table: Table, keys: Iterable[str], intact: Callable[[Row[Any]], bool]
) -> list[str]:
    """Those that still are: another one may have replaced some meanwhile. They are locked."""
    (key,) = table.primary_key.columns
    rows = connection.execute(select(table).where(key.in_(list(keys))).order_by(key).with_for_update()).all()
    return [row[0] for row in rows if not intact(row)]


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
            change_state(connection, job_id, FINAL, "queued")
    return ids


def _report(what: str, damaged: Sequence[str]) -> None:
    if damaged:
        DAMAGED_RESULTS.labels(what).inc(len(damaged))
        logger.error("Stored, damaged and dropped, so that it is computed again: %s %s", what, ", ".join(damaged))


def _digest(*parts: bytes) -> str:
    digest = hashlib.blake2b(digest_size=8)
    for part in parts:
        digest.update(len(part).to_bytes(8, "big"))
        digest.update(part)
    return digest.hexdigest()
