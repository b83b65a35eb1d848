"""Jobs of every kind: their requests, states and progress.

A job that has not ended is driven until it has, whatever crashes: what is still to be done is a query.
"""

import hashlib
from collections.abc import Iterable, Sequence
from dataclasses import fields, replace
from datetime import datetime
from itertools import islice
from typing import Any

import sqlalchemy as sa
from sqlalchemy.exc import IntegrityError

from backend.db.columns import UNSTORED, Now
from backend.db.database import RowStore
from backend.db.tables import REMOVED, job_events, job_roads, job_runs, jobs, links, results, roads, trials
from backend.job_run import JobRun
from backend.json_types import JsonObject
from backend.outcome import FAILED
from backend.store.job import FINAL, UNFINISHED, UNPLANNED, State, StoredJob
from backend.store.job_events import add_event
from backend.store.pages import read_page
from backend.store.trials import StoredTrial


class ParentEndedError(Exception):
    """A job cannot be submitted for one that has ended."""


INSERTED = 1000  # rows named in one statement
PURGED = 2000  # rows deleted in one transaction
LONGEST_KEY = 255  # characters, as the column has them

NAMES = [each.name for each in fields(StoredJob)]
WHOLE = [jobs.c[name] for name in NAMES]
WITHOUT_SWEEP = [jobs.c[name] for name in NAMES if name != "sweep"]


class JobStore(RowStore):
    """Reads and writes jobs; every method is one short transaction."""

    def create(
        self, job: StoredJob, runs: Iterable[JobRun] = (), idempotency_key: str | None = None
    ) -> tuple[StoredJob, bool]:
        """Commit a job; if its idempotency key exists, return that key's job and False.

        A cancelled job gives its key away. `runs` are those of a job that needs no planning.

        Raises:
            ParentEndedError: The job that submits it has ended meanwhile.
        """
        stored_key = None if idempotency_key is None else _shortened(idempotency_key)
        row = {name: getattr(job, name) for name in NAMES} | {"idempotency_key": stored_key}
        if job.created_at is UNSTORED:
            del row["created_at"]
        try:
            with self._database.writing() as connection:
                if job.parent_id is not None and lock(connection, job.parent_id) not in UNFINISHED:
                    raise ParentEndedError
                if stored_key is not None:
                    connection.execute(
                        sa.update(jobs)
                        .where(jobs.c.kind == job.kind, jobs.c.idempotency_key == stored_key)
                        .where(jobs.c.state == "cancelled")
                        .values(idempotency_key=None)
                    )
                created = connection.execute(sa.insert(jobs).returning(jobs.c.created_at), row).scalar_one()
                _hold_roads(connection, job.id, job.road_ids)
                if rows := [run.row(job.id) for run in runs]:
                    connection.execute(sa.insert(job_runs), rows)
                add_event(connection, job.id, "state")
        except IntegrityError:
            existing = None if idempotency_key is None else self.by_idempotency_key(job.kind, idempotency_key)
            if existing is None:
                raise
            return existing, False
        self._database.changed(job.id)
        return replace(job, created_at=created), True

    def load(self, job_id: str) -> StoredJob | None:
        """Return the job of that id, if it is stored."""
        return self._one(sa.select(*WHOLE).where(jobs.c.id == job_id, jobs.c.kind != REMOVED))

    def by_idempotency_key(self, kind: str, key: str) -> StoredJob | None:
        """Return the job that was accepted with that key and was not cancelled."""
        keys = {key, _shortened(key)}  # until 0.3.0 SQLite took long ones as they were
        of_key = sa.and_(jobs.c.kind == kind, jobs.c.idempotency_key.in_(keys), jobs.c.state != "cancelled")
        return self._one(sa.select(*WHOLE).where(of_key))

    def page(
        self, kind: str, limit: int, cursor: str | None = None, *, state: State | None = None, label: str | None = None
    ) -> tuple[list[StoredJob], str | None]:
        """Return the newest jobs that users submitted, without sweeps; see `read_page`.

        Args:
            kind: Of these jobs.
            limit: At most so many.
            cursor: Of the page before.
            state: Only those in that state.
            label: Only those with that label.
        """
        query = sa.select(*WITHOUT_SWEEP).where(jobs.c.kind == kind, jobs.c.parent_id.is_(None))
        for column, value in ((jobs.c.state, state), (jobs.c.label, label)):
            query = query if value is None else query.where(column == value)
        with self._database.reading() as connection:
            rows, following = read_page(connection, jobs, query, limit, cursor)
        return [_job(row) for row in rows], following

    def unfinished(self) -> list[StoredJob]:
        """Return jobs of every kind that have not ended, without sweeps, in the order they were accepted."""
        query = sa.select(*WITHOUT_SWEEP).where(jobs.c.state.in_(UNFINISHED)).order_by(jobs.c.created_at, jobs.c.id)
        with self._database.reading() as connection:
            rows = connection.execute(query).all()
        return [_job(row) for row in rows]

    def counts(self) -> dict[tuple[str, State], tuple[int, int]]:
        """Count jobs and their open runs, by kind and state; those that have ended have none."""
        open_runs = sa.func.sum(
            sa.case((jobs.c.state.in_(UNFINISHED), jobs.c.total - jobs.c.done - jobs.c.failed), else_=0)
        )
        query = sa.select(jobs.c.kind, jobs.c.state, sa.func.count(), open_runs).group_by(jobs.c.kind, jobs.c.state)
        with self._database.reading() as connection:
            return {
                (kind, state): (count, int(runs or 0)) for kind, state, count, runs in connection.execute(query).all()
            }

    def add_planned(self, job_id: str, runs: Sequence[JobRun]) -> bool:
        """Add runs to a job that is being planned, in their order; False where it is not any more.

        The first ones take the place of those of a planning that was interrupted.
        """
        with self._database.writing() as connection:
            if lock(connection, job_id) != "planning":
                return False
            if runs[0].position == 0:
                connection.execute(sa.delete(job_runs).where(job_runs.c.job_id == job_id))
            connection.execute(sa.insert(job_runs), [run.row(job_id) for run in runs])
        return True

    def end_planning(self, job_id: str, **values: Any) -> None:
        """Set a job that is being planned to queued, with these values changed."""
        self._change_state(job_id, ("planning",), "queued", **values)

    def start(self, job_id: str) -> None:
        """Set a queued job to running."""
        self._change_state(job_id, ("queued",), "running", started_at=_now_or(jobs.c.created_at))

    def explain(self, job_id: str, reason: str | None) -> None:
        """Say why a job that has not ended does not advance; None where it does."""
        with self._database.writing() as connection:
            if lock(connection, job_id) in UNFINISHED:
                connection.execute(sa.update(jobs).where(jobs.c.id == job_id).values(reason=reason))
                add_event(connection, job_id, "state")
        self._database.changed(job_id)

    def finish(self, job_id: str) -> bool:
        """Set a job to done; False, and no change, while one of its runs waits."""
        waiting = sa.select(job_runs.c.position).where(waiting_runs(job_id))
        with self._database.writing() as connection:
            lock(connection, job_id)
            if connection.execute(waiting.limit(1)).first() is not None:
                return False
            change_state(connection, job_id, UNFINISHED, "done", reason=None)
        self._database.changed(job_id)
        return True

    def fail(self, job: StoredJob, reason: str, **values: Any) -> None:
        """Set a job to failed, with these values changed, and cancel its runs that wait.

        Not where it has ended, or has advanced beyond `job`.
        """
        with self._database.writing() as connection:
            if _stands(connection, job):
                change_state(connection, job.id, UNFINISHED, "failed", reason=reason, **values)
                connection.execute(sa.update(job_runs).where(waiting_runs(job.id)).values(status="cancelled"))
        self._database.changed(job.id)

    def cancel(self, job_id: str) -> None:
        """Cancel a job and the jobs it submitted; those that have ended stay unchanged."""
        with self._database.writing() as connection:
            lock(connection, job_id)  # what it submits at this moment is seen, or refused
            children = sa.select(jobs.c.id).where(jobs.c.parent_id == job_id, jobs.c.state.in_(UNFINISHED))
            family = [job_id, *connection.execute(children).scalars()]
            for each in family:
                if change_state(connection, each, UNFINISHED, "cancelled", reason=None):
                    connection.execute(sa.update(job_runs).where(waiting_runs(each)).values(status="cancelled"))
        self._database.changed(*family)

    def resume(self, job_id: str, **values: Any) -> None:
        """Continue a job that has ended, with these values changed.

        Its cancelled runs wait again, and those that failed for a reason that may have passed.
        """
        with self._database.writing() as connection:
            if lock(connection, job_id) in FINAL:
                again = sa.update(job_runs).where(failed_without_result(job_id)).values(status="waiting")
                count = {"failed": jobs.c.failed - connection.execute(again).rowcount}
                connection.execute(sa.update(jobs).where(jobs.c.id == job_id).values(**count))
                cancelled = sa.update(job_runs).where(job_runs.c.job_id == job_id, job_runs.c.status == "cancelled")
                connection.execute(cancelled.values(status="waiting"))
                cost = connection.execute(sa.select(jobs.c.estimated_cost).where(jobs.c.id == job_id)).scalar()
                state: State = "planning" if cost == UNPLANNED else "queued"
                change_state(connection, job_id, FINAL, state, reason=None, **values)
        self._database.changed(job_id)

    def advance(
        self,
        job: StoredJob,
        *,
        event: str | None,
        details: JsonObject | None = None,
        new_trials: Sequence[StoredTrial] = (),
        drop_trials: bool = False,
        **values: Any,
    ) -> bool:
        """Commit a step of a job that is not a sweep; False where it has ended or has advanced beyond `job`.

        Args:
            job: As it was when the step began.
            event: What to tell; None tells nothing.
            details: With the event, beside the counts and the progress.
            new_trials: To add.
            drop_trials: Whether those that are there go.
            values: Columns to change.
        """
        with self._database.writing() as connection:
            if not _stands(connection, job):
                return False
            if "state" in values:
                values |= _times(values["state"])
            if drop_trials:
                connection.execute(sa.delete(trials).where(trials.c.job_id == job.id))
            if new_trials:
                connection.execute(sa.insert(trials), [trial.row(job.id) for trial in new_trials])
            connection.execute(sa.update(jobs).where(jobs.c.id == job.id).values(**values))
            if event is not None:
                add_event(connection, job.id, event, details)
        self._database.changed(job.id)
        return True

    def set_label(self, job_id: str, label: str | None) -> None:
        """Set its label, or (None) remove it."""
        with self._database.writing() as connection:
            connection.execute(sa.update(jobs).where(jobs.c.id == job_id).values(label=label))

    def delete(self, job_id: str) -> bool:
        """Delete a job and the jobs it submitted; `purge` then deletes their rows.

        False where one of them runs or a link shows it, or where it belongs to a job.
        """
        family = sa.or_(jobs.c.id == job_id, jobs.c.parent_id == job_id)
        with self._database.writing() as connection:
            lock(connection, job_id)
            members = connection.execute(sa.select(jobs.c.id, jobs.c.state, jobs.c.parent_id).where(family)).all()
            ids = [member.id for member in members]
            if any(member.id == job_id and member.parent_id is not None for member in members):
                return False
            linked = connection.execute(sa.select(links.c.slug).where(links.c.job_id.in_(ids)).limit(1)).first()
            if linked is not None or any(member.state in UNFINISHED for member in members):
                return False
            mark_removed(connection, ids)
        self._database.changed(*ids)
        return True

    def purge(self) -> bool:
        """Delete some rows of a deleted job, or the job where it has none; False where there is no such job.

        A job may have 100,000 rows, and SQLite lets nobody else write while they are deleted.
        """
        with self._database.writing() as connection:
            job_id = connection.execute(sa.select(jobs.c.id).where(jobs.c.kind == REMOVED).limit(1)).scalar()
            if job_id is None:
                return False
            for number in (job_runs.c.position, job_events.c.number, trials.c.number):
                of_job = number.table.c.job_id == job_id
                piece = sa.select(number).where(of_job).order_by(number).limit(PURGED).subquery()
                last = connection.execute(sa.select(sa.func.max(piece.c[number.name]))).scalar()
                if last is not None:
                    connection.execute(sa.delete(number.table).where(of_job, number <= last))
                    return True
            connection.execute(sa.delete(job_roads).where(job_roads.c.job_id == job_id))
            connection.execute(sa.delete(jobs).where(jobs.c.id == job_id))
        return True

    def _one(self, query: sa.Select[Any]) -> StoredJob | None:
        with self._database.reading() as connection:
            row = connection.execute(query).one_or_none()
        return None if row is None else _job(row)

    def _change_state(self, job_id: str, before: Sequence[str], state: State, **values: Any) -> None:
        with self._database.writing() as connection:
            change_state(connection, job_id, before, state, **values)
        self._database.changed(job_id)


def _hold_roads(connection: sa.Connection, job_id: str, road_ids: Iterable[str]) -> None:
    """Keep retention from removing the roads that a job names; planning finds those that are not there."""
    ids = iter(road_ids)
    while some := list(islice(ids, INSERTED)):
        present = sa.select(sa.literal(job_id), roads.c.id).where(roads.c.id.in_(some))
        connection.execute(sa.insert(job_roads).from_select(["job_id", "road_id"], present))


def _shortened(key: str) -> str:
    """An idempotency key as its column holds it; a long one, which follows a token's name, as a digest of it."""
    return key if len(key) <= LONGEST_KEY else f"{len(key)} characters: {hashlib.sha256(key.encode()).hexdigest()}"


def lock(connection: sa.Connection, job_id: str) -> str | None:
    """Lock a job's row, so that its writers keep counts and event numbers in order (SQLite locks everything).

    Who adds a row that refers to the job, or changes such a row twice, goes on meanwhile: PostgreSQL only looks whether
    the job is there.

    Returns:
        The job's state; None where there is no such job.
    """
    row = sa.select(jobs.c.state).where(jobs.c.id == job_id).with_for_update(key_share=True)
    state: str | None = connection.execute(row).scalar()
    return state


def waiting_runs(job_id: str) -> sa.ColumnElement[bool]:
    """Return which runs are a job's that wait."""
    return sa.and_(job_runs.c.job_id == job_id, job_runs.c.status == "waiting")


def failed_without_result(job_id: str) -> sa.ColumnElement[bool]:
    """Return which runs of a job failed for a reason that may have passed: no result of theirs is stored."""
    stored = sa.exists().where(results.c.key == job_runs.c.result_key, results.c.status == FAILED)
    failed = sa.and_(job_runs.c.job_id == job_id, job_runs.c.status == FAILED, job_runs.c.result_key.is_not(None))
    return sa.and_(failed, ~stored)


def mark_removed(connection: sa.Connection, ids: Sequence[str]) -> None:
    """Make these jobs ones that nobody finds, to be purged."""
    nobodys = {"kind": REMOVED, "parent_id": None, "idempotency_key": None, "label": None}
    connection.execute(sa.update(jobs).where(jobs.c.id.in_(ids)).values(**nobodys))


def change_state(connection: sa.Connection, job_id: str, before: Sequence[str], state: State, **values: Any) -> bool:
    """Change a job's state and add an event; False where it was in none of the states `before`."""
    if lock(connection, job_id) not in before:
        return False
    changed = {"state": state, **_times(state), **values}
    connection.execute(sa.update(jobs).where(jobs.c.id == job_id).values(**changed))
    add_event(connection, job_id, "state")
    return True


def _times(state: State) -> dict[str, Any]:
    """The columns that change with a job's state, by the database's clock."""
    if state == "running":
        return {"started_at": sa.func.coalesce(jobs.c.started_at, _now_or(jobs.c.created_at))}
    return {"finished_at": _now_or(sa.func.coalesce(jobs.c.started_at, jobs.c.created_at)) if state in FINAL else None}


def _now_or(earlier: sa.ColumnElement[datetime]) -> sa.ColumnElement[datetime]:
    """The database's time; the earlier one where its clock was set back behind that."""
    return sa.case((earlier > Now(), earlier), else_=Now())


def _job(row: sa.Row[Any]) -> StoredJob:
    return StoredJob(**row._mapping)


def _stands(connection: sa.Connection, job: StoredJob) -> bool:
    """Lock a job and check that it has not ended and is at the same attempt and generation.

    Where two services drive it by mistake each step is then committed once.
    """
    if lock(connection, job.id) not in UNFINISHED:
        return False
    progress = connection.execute(sa.select(jobs.c.progress).where(jobs.c.id == job.id)).scalar_one()
    return all(progress.get(name) == job.progress.get(name) for name in ("attempt", "generation"))
