"""Tunings: what was accepted, the trials of their complete generations, and the events that told about them.

Trials are committed a generation at a time, together with the count of generations: whoever drives a tuning goes on
from there, and what two of them commit at once is committed once.
"""

from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from datetime import UTC, datetime
from typing import Any, Literal

import orjson
from sqlalchemy import Connection, Row, Select, delete, func, insert, select, update
from sqlalchemy.exc import IntegrityError

from backend.store.database import Database, utc
from backend.store.tables import tuning_events, tuning_trials, tunings

State = Literal["queued", "running", "done", "cancelled", "failed"]
Step = Literal["search", "comparison"]
UNFINISHED = ("queued", "running")
FINAL = ("done", "cancelled", "failed")
TOLD = ("state", "step", "generation", "total", "done", "failed", "feasible")  # with every event


@dataclass(frozen=True, slots=True, kw_only=True)
class StoredTuning:
    """A tuning as it stands.

    Attributes:
        id: Names it for ever.
        state: Where it is.
        reason: Why it failed.
        step: The search, or the comparison on fresh roads behind it.
        attempt: How often it was begun, resumed and restarted; its batches are named by it.
        core_version: That computed every trial.
        schema_version: Of the scenario in the request.
        request: What was asked, defaults written out; without the number of trials, which resuming may change.
        estimated_cost: Estimate [s of one core].
        total: Trials wanted.
        done: Trials that have values.
        failed: Trials that could not be computed.
        feasible: Trials within every limit.
        generation: Complete generations.
        batch_id: The batch it waits for, or waited for last.
        comparison: The last step's result.
        request_hash: Of the request as it was accepted.
        created_at: When it was accepted.
        started_at: When its first batch was handed in.
        finished_at: When it ended.
    """

    id: str
    state: State
    reason: str | None
    step: Step
    attempt: int
    core_version: str
    schema_version: int
    request: dict[str, Any]
    estimated_cost: float
    total: int
    done: int
    failed: int
    feasible: int
    generation: int
    batch_id: str | None
    comparison: dict[str, Any] | None
    request_hash: str
    created_at: datetime
    started_at: datetime | None
    finished_at: datetime | None


@dataclass(frozen=True, slots=True, kw_only=True)
class StoredTrial:
    """A set of weights; `values` and `limits` are None where it failed."""

    number: int
    generation: int
    weights: dict[str, Any]
    status: Literal["ok", "failed"]
    reason: str | None
    feasible: bool
    values: list[float] | None
    limits: list[float] | None


@dataclass(frozen=True, slots=True, kw_only=True)
class TuningEvent:
    """Something that happened to a tuning; `data` is JSON text."""

    number: int
    kind: str
    data: str


class TuningStore:
    """Reads and writes tunings; every method is one short transaction."""

    def __init__(self, database: Database) -> None:
        self._database = database

    def create(self, tuning: StoredTuning, idempotency_key: str | None) -> tuple[StoredTuning, bool]:
        """Commit a tuning; an idempotency key already there gives its tuning, and False."""
        row = {name: getattr(tuning, name) for name in tuning.__slots__}
        row |= {"request": orjson.dumps(tuning.request).decode(), "idempotency_key": idempotency_key}
        try:
            with self._database.writing() as connection:
                connection.execute(insert(tunings), row)
                _tell(connection, tuning.id, "state")
        except IntegrityError:
            known = self.by_idempotency_key(idempotency_key) if idempotency_key is not None else None
            if known is None:
                raise
            return known, False
        return tuning, True

    def load(self, tuning_id: str) -> StoredTuning | None:
        """The tuning of that id, if it is stored."""
        return self._one(select(tunings).where(tunings.c.id == tuning_id))

    def by_idempotency_key(self, key: str) -> StoredTuning | None:
        """The tuning that was accepted with that key."""
        return self._one(select(tunings).where(tunings.c.idempotency_key == key))

    def newest(self, limit: int) -> list[StoredTuning]:
        """The tunings accepted last."""
        with self._database.reading() as connection:
            rows = connection.execute(select(tunings).order_by(tunings.c.created_at.desc()).limit(limit)).all()
        return [_tuning(row) for row in rows]

    def unfinished(self) -> list[str]:
        """Ids of those that are queued or run, in the order they were accepted."""
        chosen = (
            select(tunings.c.id).where(tunings.c.state.in_(UNFINISHED)).order_by(tunings.c.created_at, tunings.c.id)
        )
        with self._database.reading() as connection:
            return list(connection.execute(chosen).scalars())

    def waits_for(self, tuning: StoredTuning, batch_id: str, step: Step) -> bool:
        """It runs, and waits for that batch; False where it has ended or was begun anew meanwhile."""
        with self._database.writing() as connection:
            if not _lock(connection, tuning):
                return False
            started = tuning.started_at or datetime.now(UTC)
            changed = {"batch_id": batch_id, "step": step, "state": "running", "started_at": started}
            connection.execute(update(tunings).where(tunings.c.id == tuning.id).values(**changed))
            if tuning.state != "running" or tuning.step != step:
                _tell(connection, tuning.id, "state")
        return True

    def add_generation(self, tuning: StoredTuning, trials: Sequence[StoredTrial], told: Mapping[str, Any]) -> bool:
        """Commit a generation's trials, with what its event tells beside the counts; False as `waits_for`."""
        rows = [
            {
                "tuning_id": tuning.id,
                "number": trial.number,
                "generation": trial.generation,
                "weights": orjson.dumps(trial.weights).decode(),
                "status": trial.status,
                "reason": trial.reason,
                "feasible": trial.feasible,
                "objectives": None if trial.values is None else orjson.dumps(trial.values).decode(),
                "limits": None if trial.limits is None else orjson.dumps(trial.limits).decode(),
            }
            for trial in trials
        ]
        done = sum(trial.status == "ok" for trial in trials)
        changed = {
            "generation": tuning.generation + 1,
            "done": tuning.done + done,
            "failed": tuning.failed + len(trials) - done,
            "feasible": tuning.feasible + sum(trial.feasible for trial in trials),
        }
        with self._database.writing() as connection:
            if not _lock(connection, tuning):
                return False
            connection.execute(insert(tuning_trials), rows)
            connection.execute(update(tunings).where(tunings.c.id == tuning.id).values(**changed))
            _tell(connection, tuning.id, "progress", told)
        return True

    def finish(self, tuning: StoredTuning, comparison: Mapping[str, Any]) -> bool:
        """It is done, with that result; False as `waits_for`."""
        with self._database.writing() as connection:
            if not _lock(connection, tuning):
                return False
            text = orjson.dumps(comparison).decode()
            _change_state(connection, tuning.id, UNFINISHED, "done", comparison=text, finished_at=datetime.now(UTC))
        return True

    def fail(self, tuning: StoredTuning, reason: str) -> None:
        """It cannot go on; nothing happens where it has ended or was begun anew meanwhile."""
        with self._database.writing() as connection:
            if _lock(connection, tuning):
                now = datetime.now(UTC)
                _change_state(connection, tuning.id, UNFINISHED, "failed", reason=reason, finished_at=now)

    def cancel(self, tuning_id: str) -> None:
        """It becomes cancelled; one that has ended stays as it is."""
        with self._database.writing() as connection:
            _change_state(connection, tuning_id, UNFINISHED, "cancelled", finished_at=datetime.now(UTC))

    def resume(self, tuning_id: str, total: int, cost: float) -> None:
        """One that has ended goes on, up to so many trials; one that has not stays as it is."""
        with self._database.writing() as connection:
            _change_state(
                connection,
                tuning_id,
                FINAL,
                "queued",
                total=total,
                estimated_cost=cost,
                reason=None,
                comparison=None,
                step="search",
                attempt=tunings.c.attempt + 1,
                finished_at=None,
            )

    def restart(
        self, tuning: StoredTuning, scenario: Mapping[str, Any], core_version: str, schema_version: int
    ) -> None:
        """Another core version takes over: its numbers are not mixed with those that are there, which go."""
        request = orjson.dumps({**tuning.request, "scenario": scenario}).decode()
        fresh = {"done": 0, "failed": 0, "feasible": 0, "generation": 0, "step": "search", "comparison": None}
        versions = {"core_version": core_version, "schema_version": schema_version, "attempt": tuning.attempt + 1}
        with self._database.writing() as connection:
            if _lock(connection, tuning):
                connection.execute(delete(tuning_trials).where(tuning_trials.c.tuning_id == tuning.id))
                changed = {"request": request, **fresh, **versions}
                connection.execute(update(tunings).where(tunings.c.id == tuning.id).values(**changed))
                _tell(connection, tuning.id, "restart")

    def trials(self, tuning_id: str) -> list[StoredTrial]:
        """Every trial, in order."""
        chosen = select(tuning_trials).where(tuning_trials.c.tuning_id == tuning_id).order_by(tuning_trials.c.number)
        with self._database.reading() as connection:
            rows = connection.execute(chosen).all()
        return [_trial(row) for row in rows]

    def events(self, tuning_id: str, after: int, limit: int = 500) -> list[TuningEvent]:
        """What happened behind event `after`."""
        chosen = (
            select(tuning_events.c.number, tuning_events.c.kind, tuning_events.c.data)
            .where(tuning_events.c.tuning_id == tuning_id, tuning_events.c.number > after)
            .order_by(tuning_events.c.number)
            .limit(limit)
        )
        with self._database.reading() as connection:
            return [TuningEvent(**row._asdict()) for row in connection.execute(chosen).all()]

    def history(self, tuning_id: str) -> list[dict[str, Any]]:
        """What was told of each generation of this core version."""
        of_tuning = tuning_events.c.tuning_id == tuning_id
        begun = select(func.max(tuning_events.c.number)).where(of_tuning, tuning_events.c.kind == "restart")
        later = tuning_events.c.number > func.coalesce(begun.scalar_subquery(), 0)
        chosen = select(tuning_events.c.data).where(of_tuning, tuning_events.c.kind == "progress", later)
        with self._database.reading() as connection:
            rows = connection.execute(chosen.order_by(tuning_events.c.number)).scalars().all()
        return [orjson.loads(row) for row in rows]

    def counts(self) -> dict[str, int]:
        """Tunings by state."""
        chosen = select(tunings.c.state, func.count()).group_by(tunings.c.state)
        with self._database.reading() as connection:
            return {state: int(count) for state, count in connection.execute(chosen).all()}

    def _one(self, chosen: Select[Any]) -> StoredTuning | None:
        with self._database.reading() as connection:
            row = connection.execute(chosen).one_or_none()
        return None if row is None else _tuning(row)


def _lock(connection: Connection, tuning: StoredTuning) -> bool:
    """Writers of one tuning wait for each other; says whether it still is where `tuning` says."""
    chosen = select(tunings.c.state, tunings.c.attempt, tunings.c.generation).where(tunings.c.id == tuning.id)
    row = connection.execute(chosen.with_for_update()).one()
    return row.state in UNFINISHED and (row.attempt, row.generation) == (tuning.attempt, tuning.generation)


def _change_state(connection: Connection, tuning_id: str, before: Sequence[str], state: State, **values: Any) -> None:
    changed = connection.execute(
        update(tunings).where(tunings.c.id == tuning_id, tunings.c.state.in_(before)).values(state=state, **values)
    )
    if changed.rowcount:
        _tell(connection, tuning_id, "state")


def _tell(connection: Connection, tuning_id: str, kind: str, more: Mapping[str, Any] | None = None) -> None:
    """Add an event with the tuning as this transaction leaves it."""
    tuning = connection.execute(select(*(tunings.c[name] for name in TOLD)).where(tunings.c.id == tuning_id)).one()
    last = connection.execute(
        select(func.coalesce(func.max(tuning_events.c.number), 0)).where(tuning_events.c.tuning_id == tuning_id)
    ).scalar_one()
    told = {name: getattr(tuning, name) for name in TOLD}
    data = orjson.dumps({**told, **(more or {})}).decode()
    connection.execute(insert(tuning_events), {"tuning_id": tuning_id, "number": last + 1, "kind": kind, "data": data})


def _tuning(row: Row[Any]) -> StoredTuning:
    values = {name: getattr(row, name) for name in StoredTuning.__slots__}
    for name in ("created_at", "started_at", "finished_at"):
        values[name] = utc(values[name]) if values[name] else None
    values["request"] = orjson.loads(row.request)
    values["comparison"] = orjson.loads(row.comparison) if row.comparison else None
    return StoredTuning(**values)


def _trial(row: Row[Any]) -> StoredTrial:
    return StoredTrial(
        number=row.number,
        generation=row.generation,
        weights=orjson.loads(row.weights),
        status=row.status,
        reason=row.reason,
        feasible=row.feasible,
        values=orjson.loads(row.objectives) if row.objectives else None,
        limits=orjson.loads(row.limits) if row.limits else None,
    )
