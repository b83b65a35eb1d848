"""The runs of a sweep: a run refers to its result by key, and each result is stored once."""

from collections.abc import Iterable, Mapping, Sequence
from typing import Any

from sqlalchemy import Connection, Row, bindparam, exists, select, update

from backend.db.database import RowStore
from backend.db.tables import EXPIRED, job_runs, jobs, results
from backend.errors import DamagedError
from backend.job_run import JobRow, JobRun
from backend.outcome import Outcome
from backend.store.damage import drop_damaged_results, drop_results
from backend.store.job import UNPLANNED
from backend.store.job_events import add_event
from backend.store.jobs import failed_without_result, lock, waiting_runs
from backend.store.runs import insert_results

RESULT = "result_"  # before the names of a result's columns beside those of its run


class JobRunStore(RowStore):
    """Reads and writes the runs of jobs; every method is one short transaction."""

    def waiting(self, job_id: str, positions: Iterable[int]) -> list[JobRun]:
        """Return the runs at these positions that wait."""
        query = select(job_runs).where(waiting_runs(job_id), job_runs.c.position.in_(positions))
        with self._database.reading() as connection:
            rows = connection.execute(query.order_by(job_runs.c.position)).all()
        return [JobRun(row.position, row.changes, row.strategy, row.result_key or "") for row in rows]

    def waiting_positions(self, job_id: str) -> list[int]:
        """Return the positions of the runs that wait."""
        with self._database.reading() as connection:
            return list(connection.execute(select(job_runs.c.position).where(waiting_runs(job_id))).scalars())

    def hand_out(self, job_id: str, runs: Sequence[JobRun]) -> list[JobRun]:
        """Store the keys of waiting runs that are to be computed now; return those whose result is not stored.

        The others get that result; one with a reason fails.

        Args:
            job_id: Of a job; where it does not run any more nothing is handed out.
            runs: With the keys that they have from now on.
        """
        stored = self._stored(run.key for run in runs if run.reason is None)
        keys = [{"at": run.position, "key": run.key} for run in runs if run.key]
        failures = {run.position: run.reason for run in runs if run.reason is not None}
        with self._database.writing() as connection:
            if lock(connection, job_id) != "running":
                return []
            if keys:
                at = update(job_runs).where(waiting_runs(job_id), job_runs.c.position == bindparam("at"))
                connection.execute(at.values(result_key=bindparam("key")), keys)
            ended = _fail(connection, job_id, failures) + _mark_finished(connection, job_id, stored)
        if ended:
            self._database.changed(job_id)
        return [run for run in runs if run.reason is None and run.key not in stored]

    def _stored(self, keys: Iterable[str]) -> dict[str, str]:
        """Return by key the status of the results that are stored."""
        query = select(results.c.key, results.c.status)
        with self._database.reading() as connection:
            rows = connection.execute(query.where(results.c.key.in_(list(keys)), results.c.status != EXPIRED)).all()
        return {row.key: row.status for row in rows}

    def save(
        self,
        job_id: str,
        computed: Sequence[Outcome],
        core_version: str,
        failures: Mapping[int, str] | None = None,
    ) -> tuple[set[str], int]:
        """Commit results of a job, and for runs (by position) without one the reason.

        Returns:
            The keys of the results that were not stored yet, and how many runs got a reason.
        """
        with self._database.writing() as connection:
            lock(connection, job_id)
            new = insert_results(connection, computed, core_version)
            failed = _fail(connection, job_id, failures or {})
            _mark_finished(connection, job_id, {item.key: item.status for item in computed})
        self._database.changed(job_id)
        return new, failed

    def may_be_tried_again(self, job_id: str) -> bool:
        """Check whether a run of the job failed for a reason that may have passed."""
        query = select(job_runs.c.position).where(failed_without_result(job_id)).limit(1)
        with self._database.reading() as connection:
            return connection.execute(query).first() is not None

    def rows(self, job_id: str, after: int, limit: int) -> list[JobRow]:
        """The next runs behind position `after`, each with its result if it has one; where that is damaged it waits.

        None of a job that is not planned. The reason of a cancelled run is that of its job.
        """
        of_result = [each.label(f"{RESULT}{each.name}") for each in results.c]
        planned = exists().where(jobs.c.id == job_id, jobs.c.estimated_cost != UNPLANNED)
        settled = (job_runs.c.result_key == results.c.key) & job_runs.c.status.in_(("ok", "failed"))
        query = (
            select(*(each for each in job_runs.c if each.name != "result_key"), *of_result)
            .join_from(job_runs, results, settled, isouter=True)
            .where(job_runs.c.job_id == job_id, job_runs.c.position > after, planned)
            .order_by(job_runs.c.position)
            .limit(limit)
        )
        failed_job = select(jobs.c.reason).where(jobs.c.id == job_id, jobs.c.state == "failed")
        with self._database.reading() as connection:
            rows = connection.execute(query).all()
            cancelled = any(row.status == "cancelled" for row in rows)
            cancelled_for = connection.execute(failed_job).scalar() if cancelled else None
        lost = drop_damaged_results(self._database, [row for row in rows if row.result_key is not None], RESULT)
        expired = {row.result_key for row in rows if row.result_status == EXPIRED and row.reason is None}
        if expired:
            drop_results(self._database, expired)
        return [_row(row, cancelled_for, lost=row.result_key in lost | expired) for row in rows]


def _row(row: Row[Any], cancelled_for: str | None, *, lost: bool) -> JobRow:
    if row.status == "ok" and row.result_status is None:
        raise DamagedError("batch")  # its key is of no result
    # A run that ended after its job was resumed can have the reason of before, stored by an older version.
    of_run = row.reason if row.status == "failed" and row.result_status != "failed" else None
    # It failed for a reason that may have passed, and for another job it has.
    without_result = lost or (row.status == "failed" and row.result_status != "failed")
    return JobRow(
        position=row.position,
        changes=row.changes,
        strategy=row.strategy,
        status="waiting" if lost else row.status,
        reason=cancelled_for if row.status == "cancelled" else of_run,
        core_version=None if without_result else row.result_core_version,
        summary=None if without_result else row.result_summary,
        compute_ms=None if without_result else row.result_compute_ms,
    )


def _mark_finished(connection: Connection, job_id: str, statuses: Mapping[str, str]) -> int:
    """Set waiting runs to the status of their stored result, by its key in `statuses`; return how many there are."""
    counts = dict.fromkeys(("ok", "failed"), 0)
    for status in set(statuses.values()):
        keys = [key for key, each in statuses.items() if each == status]
        # Locked, so that retention sees that the run has it before it removes it.
        of_status = select(results.c.key).where(results.c.key.in_(keys), results.c.status == status)
        there = list(connection.execute(of_status.order_by(results.c.key).with_for_update(read=True)).scalars())
        matching = update(job_runs).where(waiting_runs(job_id), job_runs.c.result_key.in_(there))
        counts[status] = connection.execute(matching.values(status=status)).rowcount
    _count(connection, job_id, done=counts["ok"], failed=counts["failed"])
    return sum(counts.values())


def _fail(connection: Connection, job_id: str, reasons: Mapping[int, str]) -> int:
    """Set waiting runs (by position) to failed, with the reason; returns how many did wait."""
    of_run = job_runs.c.job_id == job_id, job_runs.c.status == "waiting", job_runs.c.position == bindparam("at")
    failed = 0
    for position, reason in reasons.items():
        fail = update(job_runs).where(*of_run).values(status="failed", reason=reason)
        failed += connection.execute(fail, {"at": position}).rowcount
    _count(connection, job_id, done=0, failed=failed)
    return failed


def _count(connection: Connection, job_id: str, *, done: int, failed: int) -> None:
    """Add to the job's counts of ended runs, with an event."""
    if not done and not failed:
        return
    changed = {"done": jobs.c.done + done, "failed": jobs.c.failed + failed}
    connection.execute(update(jobs).where(jobs.c.id == job_id).values(**changed))
    add_event(connection, job_id, "progress")
