"""Jobs of every kind: what was accepted, how far each is, and the events that tell about it.

A job that has not ended is driven until it has, whatever crashes: what is still to be done is a query.
"""

from collections.abc import Sequence
from dataclasses import dataclass, field, fields
from datetime import UTC, datetime
from typing import Any, Literal

import orjson
from sqlalchemy import Connection, Row, Select, and_, delete, func, insert, or_, select, update
from sqlalchemy.exc import IntegrityError

from backend import digest
from backend.db.database import Database
from backend.db.tables import job_events, job_runs, jobs, links, trials
from backend.jobs.chunk import PlannedRun
from backend.json_types import JsonObject
from backend.store.trials import StoredTrial
from sim_core import __version__ as CORE_VERSION
from sim_core.scenario import SCHEMA_VERSION

State = Literal["queued", "running", "done", "cancelled", "failed"]
Kind = Literal["sweep", "tuning", "reproduction"]
UNFINISHED = ("queued", "running")
FINAL = ("done", "cancelled", "failed")
PAGE = 500  # events read at once


class ParentEndedError(Exception):
    """A job cannot be submitted for one that has ended."""


@dataclass(frozen=True, slots=True, kw_only=True)
class StoredJob:
    """A job as it stands.

    Attributes:
        id: Names it for ever.
        kind: Which kind of job.
        parent_id: The job that submitted it; None where a user did.
        label: A user's name for it.
        owner: The name of the token that submitted it; None without tokens.
        state: Where it is.
        reason: Why it failed.
        core_version: That computes it; of a sweep each run names its own.
        schema_version: Of the scenario in the request.
        request: What was asked, defaults written out.
        sweep: The points of a sweep, as they were sent; None where they were not loaded.
        progress: What the kind keeps of how far it is.
        answer: The kind's result, once it is done.
        estimated_cost: Estimate [s of one core].
        total: Runs, or trials of a tuning.
        done: How many of them succeeded.
        failed: How many did not.
        request_hash: Of the request as it was accepted.
        created_at: When it was accepted.
        started_at: When it began.
        finished_at: When it ended.
    """

    id: str = field(default_factory=digest.random_id)
    kind: Kind
    parent_id: str | None = None
    label: str | None = None
    owner: str | None = None
    state: State = "queued"
    reason: str | None = None
    core_version: str = CORE_VERSION
    schema_version: int = SCHEMA_VERSION
    request: JsonObject
    sweep: JsonObject | None = None
    progress: JsonObject = field(default_factory=dict)
    answer: JsonObject | None = None
    estimated_cost: float
    total: int
    done: int = 0
    failed: int = 0
    request_hash: str
    created_at: datetime = field(default_factory=lambda: datetime.now(UTC))
    started_at: datetime | None = None
    finished_at: datetime | None = None

    @property
    def open_runs(self) -> int:
        """How many have not come to an end."""
        return self.total - self.done - self.failed


@dataclass(frozen=True, slots=True, kw_only=True)
class JobEvent:
    """Something that happened to a job; `data` is JSON text."""

    number: int
    kind: str
    data: str


NAMES = [each.name for each in fields(StoredJob)]
WHOLE = [jobs.c[name] for name in NAMES]
WITHOUT_SWEEP = [jobs.c[name] for name in NAMES if name != "sweep"]


class JobStore:
    """Reads and writes jobs; every method is one short transaction."""

    def __init__(self, database: Database) -> None:
        self._database = database

    def create(
        self, job: StoredJob, runs: Sequence[PlannedRun] = (), idempotency_key: str | None = None
    ) -> tuple[StoredJob, bool]:
        """Commit a job with all its runs; an idempotency key already there gives its job, and False.

        A cancelled job gives its key away.

        Raises:
            ParentEndedError: The job that submits it has ended meanwhile.
        """
        row = {name: getattr(job, name) for name in NAMES} | {"idempotency_key": idempotency_key}
        try:
            with self._database.writing() as connection:
                if job.parent_id is not None:
                    lock(connection, job.parent_id)
                    parent = select(jobs.c.state).where(jobs.c.id == job.parent_id)
                    if connection.execute(parent).scalar_one() not in UNFINISHED:
                        raise ParentEndedError
                connection.execute(
                    update(jobs)
                    .where(jobs.c.kind == job.kind, jobs.c.idempotency_key == idempotency_key)
                    .where(jobs.c.state == "cancelled")
                    .values(idempotency_key=None)
                )
                connection.execute(insert(jobs), row)
                if runs:
                    connection.execute(insert(job_runs), [run.row(job.id) for run in runs])
                tell(connection, job.id, "state")
        except IntegrityError:
            existing = None if idempotency_key is None else self.by_idempotency_key(job.kind, idempotency_key)
            if existing is None:
                raise
            return existing, False
        self._database.changed()
        return job, True

    def load(self, job_id: str) -> StoredJob | None:
        """The job of that id, if it is stored."""
        return self._one(select(*WHOLE).where(jobs.c.id == job_id))

    def by_idempotency_key(self, kind: Kind, key: str) -> StoredJob | None:
        """The job that was accepted with that key and was not cancelled."""
        of_key = and_(jobs.c.kind == kind, jobs.c.idempotency_key == key, jobs.c.state != "cancelled")
        return self._one(select(*WHOLE).where(of_key))

    def page(
        self,
        kind: Kind,
        limit: int,
        *,
        before: tuple[datetime, str] | None = None,
        state: State | None = None,
        label: str | None = None,
    ) -> list[StoredJob]:
        """What users submitted, the newest first, without sweeps.

        Args:
            kind: Of these jobs.
            limit: At most so many.
            before: When the last one of the page before was created, and its id.
            state: Only those in that state.
            label: Only those with that label.
        """
        query = select(*WITHOUT_SWEEP).where(jobs.c.kind == kind, jobs.c.parent_id.is_(None))
        if state is not None:
            query = query.where(jobs.c.state == state)
        if label is not None:
            query = query.where(jobs.c.label == label)
        if before is not None:
            time, job_id = before
            query = query.where(or_(jobs.c.created_at < time, and_(jobs.c.created_at == time, jobs.c.id < job_id)))
        with self._database.reading() as connection:
            rows = connection.execute(query.order_by(jobs.c.created_at.desc(), jobs.c.id.desc()).limit(limit)).all()
        return [_job(row) for row in rows]

    def unfinished(self) -> list[StoredJob]:
        """Jobs of every kind that are queued or run, without sweeps, in the order they were accepted."""
        query = select(*WITHOUT_SWEEP).where(jobs.c.state.in_(UNFINISHED)).order_by(jobs.c.created_at, jobs.c.id)
        with self._database.reading() as connection:
            rows = connection.execute(query).all()
        return [_job(row) for row in rows]

    def counts(self) -> dict[tuple[Kind, State], tuple[int, int]]:
        """Jobs and their open runs, by kind and state."""
        open_runs = func.sum(jobs.c.total - jobs.c.done - jobs.c.failed)
        query = select(jobs.c.kind, jobs.c.state, func.count(), open_runs).group_by(jobs.c.kind, jobs.c.state)
        with self._database.reading() as connection:
            return {
                (kind, state): (count, int(runs or 0)) for kind, state, count, runs in connection.execute(query).all()
            }

    def start(self, job_id: str) -> None:
        """Queued becomes running."""
        self._change_state(job_id, ("queued",), "running", started_at=datetime.now(UTC))

    def finish(self, job_id: str) -> bool:
        """Done, unless one of its runs still waits (False)."""
        waiting = select(job_runs.c.position).where(job_runs.c.job_id == job_id, job_runs.c.status == "waiting")
        with self._database.writing() as connection:
            lock(connection, job_id)
            if connection.execute(waiting.limit(1)).first() is not None:
                return False
            change_state(connection, job_id, UNFINISHED, "done", finished_at=datetime.now(UTC))
        self._database.changed()
        return True

    def fail(self, job: StoredJob, reason: str) -> None:
        """It cannot go on; nothing happens where it has ended or is further than `job` says."""
        self.advance(job, event="state", state="failed", reason=reason, finished_at=datetime.now(UTC))

    def give_up(self, job_id: str, reason: str) -> None:
        """It fails as a whole: what waits of it will never be stored."""
        with self._database.writing() as connection:
            now = datetime.now(UTC)
            if change_state(connection, job_id, UNFINISHED, "failed", reason=reason, finished_at=now):
                waiting = update(job_runs).where(job_runs.c.job_id == job_id, job_runs.c.status == "waiting")
                connection.execute(waiting.values(status="cancelled", reason=reason))
        self._database.changed()

    def cancel(self, job_id: str) -> None:
        """It and the jobs it submitted become cancelled; what has ended stays as it is."""
        with self._database.writing() as connection:
            children = select(jobs.c.id).where(jobs.c.parent_id == job_id, jobs.c.state.in_(UNFINISHED))
            for each in (job_id, *connection.execute(children).scalars()):
                if change_state(connection, each, UNFINISHED, "cancelled", finished_at=datetime.now(UTC)):
                    waiting = update(job_runs).where(job_runs.c.job_id == each, job_runs.c.status == "waiting")
                    connection.execute(waiting.values(status="cancelled"))
        self._database.changed()

    def resume(self, job_id: str, **values: Any) -> None:
        """One that has ended goes on, with these values changed: cancelled runs wait again."""
        with self._database.writing() as connection:
            lock(connection, job_id)
            if change_state(connection, job_id, FINAL, "queued", reason=None, finished_at=None, **values):
                cancelled = update(job_runs).where(job_runs.c.job_id == job_id, job_runs.c.status == "cancelled")
                connection.execute(cancelled.values(status="waiting"))
        self._database.changed()

    def advance(
        self,
        job: StoredJob,
        *,
        event: str | None,
        told: JsonObject | None = None,
        new_trials: Sequence[StoredTrial] = (),
        drop_trials: bool = False,
        **values: Any,
    ) -> bool:
        """Commit a step of a job that is not a sweep; False where it has ended or is further than `job` says.

        Args:
            job: As it was when the step began.
            event: What to tell; None tells nothing.
            told: With the event, beside the counts and the progress.
            new_trials: To add.
            drop_trials: Whether those that are there go.
            values: Columns to change.
        """
        with self._database.writing() as connection:
            lock(connection, job.id)
            now = _job(connection.execute(select(*WITHOUT_SWEEP).where(jobs.c.id == job.id)).one())
            if now.state not in UNFINISHED or _step(now) != _step(job):
                return False
            if drop_trials:
                connection.execute(delete(trials).where(trials.c.job_id == job.id))
            if new_trials:
                connection.execute(insert(trials), [trial.row(job.id) for trial in new_trials])
            connection.execute(update(jobs).where(jobs.c.id == job.id).values(**values))
            if event is not None:
                tell(connection, job.id, event, told)
        self._database.changed()
        return True

    def note_progress(self, job_id: str, **progress: Any) -> None:
        """Change what it keeps of how far it is, where it has not ended; nothing is told."""
        with self._database.writing() as connection:
            running = (jobs.c.id == job_id) & jobs.c.state.in_(UNFINISHED)
            connection.execute(update(jobs).where(running).values(progress=progress))

    def set_label(self, job_id: str, label: str | None) -> None:
        """Name it, or take its name away."""
        with self._database.writing() as connection:
            connection.execute(update(jobs).where(jobs.c.id == job_id).values(label=label))

    def delete(self, job_id: str) -> bool:
        """Remove it with its runs, trials, events and the jobs it submitted.

        False where one of them runs or a link shows it, or where it belongs to a job.
        """
        family = or_(jobs.c.id == job_id, jobs.c.parent_id == job_id)
        with self._database.writing() as connection:
            lock(connection, job_id)
            members = connection.execute(select(jobs.c.id, jobs.c.state, jobs.c.parent_id).where(family)).all()
            ids = [member.id for member in members]
            if any(member.id == job_id and member.parent_id is not None for member in members):
                return False
            linked = connection.execute(select(links.c.slug).where(links.c.job_id.in_(ids)).limit(1)).first()
            if linked is not None or any(member.state in UNFINISHED for member in members):
                return False
            for table in (job_runs, job_events, trials):
                connection.execute(delete(table).where(table.c.job_id.in_(ids)))
            connection.execute(delete(jobs).where(jobs.c.parent_id == job_id))
            connection.execute(delete(jobs).where(jobs.c.id == job_id))
        self._database.changed()
        return True

    def events(self, job_id: str, after: int, limit: int = PAGE) -> list[JobEvent]:
        """What happened behind event `after`."""
        with self._database.reading() as connection:
            return _events(connection, job_id, after, limit)

    def news(self, job_id: str, after: int) -> tuple[list[JobEvent], bool]:
        """What happened behind event `after`, and whether nothing more will."""
        with self._database.reading() as connection:
            state = connection.execute(select(jobs.c.state).where(jobs.c.id == job_id)).scalar_one_or_none()
            events = _events(connection, job_id, after, PAGE)  # behind the state: an end that is seen has its event
        return events, state not in UNFINISHED and len(events) < PAGE

    def history(self, job_id: str) -> list[JsonObject]:
        """What its progress events told since it last began anew."""
        events = self.events(job_id, 0, limit=1_000_000)
        begun = max((event.number for event in events if event.kind == "restart"), default=0)
        return [orjson.loads(event.data) for event in events if event.kind == "progress" and event.number > begun]

    def _one(self, query: Select[Any]) -> StoredJob | None:
        with self._database.reading() as connection:
            row = connection.execute(query).one_or_none()
        return None if row is None else _job(row)

    def _change_state(self, job_id: str, before: Sequence[str], state: State, **values: Any) -> None:
        with self._database.writing() as connection:
            change_state(connection, job_id, before, state, **values)
        self._database.changed()


def lock(connection: Connection, job_id: str) -> None:
    """Writers of one job wait for each other, so that counts and event numbers are in order (SQLite: all wait)."""
    connection.execute(select(jobs.c.id).where(jobs.c.id == job_id).with_for_update())


def change_state(connection: Connection, job_id: str, before: Sequence[str], state: State, **values: Any) -> bool:
    """Move it, and tell; False where it was in none of the states `before`."""
    matching = update(jobs).where(jobs.c.id == job_id, jobs.c.state.in_(before))
    if not connection.execute(matching.values(state=state, **values)).rowcount:
        return False
    tell(connection, job_id, "state")
    return True


def tell(connection: Connection, job_id: str, kind: str, told: JsonObject | None = None) -> None:
    """Add an event with the job as this transaction leaves it."""
    columns = (jobs.c.state, jobs.c.done, jobs.c.failed, jobs.c.total, jobs.c.progress)
    job = connection.execute(select(*columns).where(jobs.c.id == job_id)).one()
    last = connection.execute(
        select(func.coalesce(func.max(job_events.c.number), 0)).where(job_events.c.job_id == job_id)
    ).scalar_one()
    counts = {"state": job.state, "done": job.done, "failed": job.failed, "total": job.total}
    data = orjson.dumps({**counts, **job.progress, **(told or {})}).decode()
    connection.execute(insert(job_events), {"job_id": job_id, "number": last + 1, "kind": kind, "data": data})


def _events(connection: Connection, job_id: str, after: int, limit: int) -> list[JobEvent]:
    query = (
        select(job_events.c.number, job_events.c.kind, job_events.c.data)
        .where(job_events.c.job_id == job_id, job_events.c.number > after)
        .order_by(job_events.c.number)
        .limit(limit)
    )
    return [JobEvent(**row._asdict()) for row in connection.execute(query).all()]


def _job(row: Row[Any]) -> StoredJob:
    return StoredJob(**row._asdict())


def _step(job: StoredJob) -> tuple[Any, Any]:
    """Where its driver is: two that drive it by mistake commit each step once."""
    return job.progress.get("attempt"), job.progress.get("generation")
