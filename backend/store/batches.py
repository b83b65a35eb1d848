"""Batches: what was accepted, which of its runs are there, and the events that told about it.

A run of a batch points at its result by key, and the result is stored once whoever computed it. What still has to be
computed is a query (`waiting`), so nothing else has to be remembered over a crash.
"""

from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from datetime import UTC, datetime
from typing import Any, Literal

import orjson
from sqlalchemy import Connection, Row, Select, Update, func, insert, select, update
from sqlalchemy.exc import IntegrityError

from backend.chunk import ComputedRun, WaitingRun
from backend.store.database import Database, insert_new, utc
from backend.store.tables import batch_events, batch_runs, batches, results

State = Literal["queued", "running", "done", "cancelled", "failed"]
UNFINISHED = ("queued", "running")
FINAL = ("done", "cancelled", "failed")


@dataclass(frozen=True, slots=True, kw_only=True)
class StoredBatch:
    """A batch as it stands; `fields` are the dotted names its sweep changes."""

    id: str
    state: State
    reason: str | None
    core_version: str
    schema_version: int
    scenario: dict[str, Any]
    strategies: list[str]
    sweep: dict[str, Any]
    fields: list[str]
    estimated_cost: float
    total: int
    done: int
    failed: int
    request_hash: str
    created_at: datetime
    started_at: datetime | None
    finished_at: datetime | None


@dataclass(frozen=True, slots=True, kw_only=True)
class BatchRow:
    """A run of a batch with what is known of its result (`summary` is JSON text)."""

    position: int
    changes: str
    strategy: str
    status: str
    reason: str | None
    core_version: str | None
    summary: str | None
    compute_ms: float | None


@dataclass(frozen=True, slots=True, kw_only=True)
class BatchEvent:
    """Something that happened to a batch; `data` is JSON text."""

    number: int
    kind: str
    data: str


class BatchStore:
    """Reads and writes batches; every method is one short transaction."""

    def __init__(self, database: Database) -> None:
        self._database = database

    def create(
        self, batch: StoredBatch, runs: Sequence[Mapping[str, Any]], idempotency_key: str | None
    ) -> tuple[StoredBatch, bool]:
        """Commit a batch with all its runs; an idempotency key already there gives its batch, and False."""
        row = {
            "id": batch.id,
            "state": batch.state,
            "reason": batch.reason,
            "core_version": batch.core_version,
            "schema_version": batch.schema_version,
            "scenario": orjson.dumps(batch.scenario).decode(),
            "strategies": orjson.dumps(batch.strategies).decode(),
            "sweep": orjson.dumps(batch.sweep).decode(),
            "fields": orjson.dumps(batch.fields).decode(),
            "estimated_cost": batch.estimated_cost,
            "total": batch.total,
            "done": batch.done,
            "failed": batch.failed,
            "idempotency_key": idempotency_key,
            "request_hash": batch.request_hash,
            "created_at": batch.created_at,
        }
        try:
            with self._database.writing() as connection:
                connection.execute(insert(batches), row)
                connection.execute(insert(batch_runs), [{"batch_id": batch.id, **run} for run in runs])
                _tell(connection, batch.id, "state")
        except IntegrityError:
            known = self.by_idempotency_key(idempotency_key) if idempotency_key is not None else None
            if known is None:
                raise
            return known, False
        return batch, True

    def load(self, batch_id: str) -> StoredBatch | None:
        """The batch of that id, if it is stored."""
        return self._one(select(batches).where(batches.c.id == batch_id))

    def by_idempotency_key(self, key: str) -> StoredBatch | None:
        """The batch that was accepted with that key."""
        return self._one(select(batches).where(batches.c.idempotency_key == key))

    def newest(self, limit: int) -> list[StoredBatch]:
        """The batches accepted last, without those the service handed in itself: their keys have a space."""
        asked = batches.c.idempotency_key.is_(None) | batches.c.idempotency_key.not_like("% %")
        chosen = select(batches).where(asked).order_by(batches.c.created_at.desc()).limit(limit)
        with self._database.reading() as connection:
            rows = connection.execute(chosen).all()
        return [_batch(row) for row in rows]

    def unfinished(self) -> list[StoredBatch]:
        """Batches with runs still to compute, in the order they were accepted."""
        chosen = select(batches).where(batches.c.state.in_(UNFINISHED)).order_by(batches.c.created_at, batches.c.id)
        with self._database.reading() as connection:
            rows = connection.execute(chosen).all()
        return [_batch(row) for row in rows]

    def waiting(self, batch_id: str, after: int, limit: int) -> tuple[int | None, list[WaitingRun]]:
        """The next runs without a result behind position `after`, and the last position looked at (None: no more).

        Those whose result is stored already are settled instead.
        """
        chosen = _waiting_runs(batch_id).where(batch_runs.c.position > after).limit(limit)
        with self._database.reading() as connection:
            runs = [
                WaitingRun(position=row.position, changes=row.changes, strategy=row.strategy, key=row.result_key)
                for row in connection.execute(chosen).all()
            ]
            keys = [run.key for run in runs]
            there = set(connection.execute(select(results.c.key).where(results.c.key.in_(keys))).scalars())
        if there:
            self.settle(batch_id, sorted(there))
        return (runs[-1].position if runs else None), [run for run in runs if run.key not in there]

    def settle(self, batch_id: str, keys: Sequence[str]) -> None:
        """Mark the runs whose result is stored already."""
        with self._database.writing() as connection:
            _lock(connection, batch_id)
            _settle(connection, batch_id, keys)

    def save(
        self,
        batch_id: str,
        computed: Sequence[ComputedRun],
        core_version: str,
        failures: Mapping[int, str] | None = None,
    ) -> None:
        """Commit results of a batch, and runs (by position) that got none with the reason why."""
        now = datetime.now(UTC)
        rows = [
            {
                "key": item.key,
                "strategy": item.strategy,
                "core_version": core_version,
                "status": item.status,
                "summary": item.summary,
                "compute_ms": item.compute_ms,
                "created_at": now,
            }
            for item in sorted(computed, key=lambda item: item.key)  # one order: two writers never wait crosswise
        ]
        with self._database.writing() as connection:
            _lock(connection, batch_id)
            if rows:
                insert_new(connection, results, rows)
            failed = 0
            for position, reason in (failures or {}).items():
                failed += connection.execute(
                    _update_waiting(batch_id)
                    .where(batch_runs.c.position == position)
                    .values(status="failed", reason=reason)
                ).rowcount
            _count(connection, batch_id, done=0, failed=failed)
            _settle(connection, batch_id, [item.key for item in computed])

    def rekey(self, batch_id: str, keys: Mapping[int, tuple[str | None, str | None]]) -> None:
        """Give waiting runs (by position) the keys of another core version, or the reason why they have none."""
        with self._database.writing() as connection:
            _lock(connection, batch_id)
            failed = 0
            for position, (key, reason) in keys.items():
                change = {"result_key": key} if key is not None else {"status": "failed", "reason": reason}
                changed = connection.execute(
                    _update_waiting(batch_id).where(batch_runs.c.position == position).values(**change)
                ).rowcount
                failed += changed if key is None else 0
            _count(connection, batch_id, done=0, failed=failed)

    def start(self, batch_id: str) -> None:
        """Queued becomes running."""
        self._move(batch_id, ("queued",), "running", started_at=datetime.now(UTC))

    def finish(self, batch_id: str) -> bool:
        """Running becomes done where no run waits any more; says whether it did."""
        with self._database.reading() as connection:
            if connection.execute(_waiting_runs(batch_id).limit(1)).first() is not None:
                return False
        self._move(batch_id, UNFINISHED, "done", finished_at=datetime.now(UTC))
        return True

    def fail(self, batch_id: str, reason: str) -> None:
        """The batch as a whole cannot go on."""
        self._end(batch_id, "failed", reason)

    def cancel(self, batch_id: str) -> None:
        """Runs that wait become cancelled, and so does the batch; a finished batch stays as it is."""
        self._end(batch_id, "cancelled", None)

    def rows(self, batch_id: str, after: int, limit: int) -> list[BatchRow]:
        """The next runs behind position `after`, each with its result once it is settled."""
        theirs = (batch_runs.c.result_key == results.c.key) & batch_runs.c.status.in_(("ok", "failed"))
        chosen = (
            select(
                batch_runs.c.position,
                batch_runs.c.changes,
                batch_runs.c.strategy,
                batch_runs.c.status,
                batch_runs.c.reason,
                results.c.core_version,
                results.c.summary,
                results.c.compute_ms,
            )
            .join_from(batch_runs, results, theirs, isouter=True)
            .where(batch_runs.c.batch_id == batch_id, batch_runs.c.position > after)
            .order_by(batch_runs.c.position)
            .limit(limit)
        )
        with self._database.reading() as connection:
            return [BatchRow(**row._asdict()) for row in connection.execute(chosen).all()]

    def events(self, batch_id: str, after: int, limit: int = 500) -> list[BatchEvent]:
        """What happened behind event `after`."""
        chosen = (
            select(batch_events.c.number, batch_events.c.kind, batch_events.c.data)
            .where(batch_events.c.batch_id == batch_id, batch_events.c.number > after)
            .order_by(batch_events.c.number)
            .limit(limit)
        )
        with self._database.reading() as connection:
            return [BatchEvent(**row._asdict()) for row in connection.execute(chosen).all()]

    def counts(self) -> dict[str, tuple[int, int]]:
        """Batches and their unfinished runs, by state."""
        chosen = select(
            batches.c.state, func.count(), func.sum(batches.c.total - batches.c.done - batches.c.failed)
        ).group_by(batches.c.state)
        with self._database.reading() as connection:
            return {state: (count, int(left or 0)) for state, count, left in connection.execute(chosen).all()}

    def _one(self, chosen: Select[Any]) -> StoredBatch | None:
        with self._database.reading() as connection:
            row = connection.execute(chosen).one_or_none()
        return None if row is None else _batch(row)

    def _move(self, batch_id: str, before: Sequence[str], state: State, **values: Any) -> None:
        with self._database.writing() as connection:
            if _change_state(connection, batch_id, before, state, **values):
                _tell(connection, batch_id, "state")

    def _end(self, batch_id: str, state: State, reason: str | None) -> None:
        with self._database.writing() as connection:
            now = datetime.now(UTC)
            if _change_state(connection, batch_id, UNFINISHED, state, reason=reason, finished_at=now):
                connection.execute(_update_waiting(batch_id).values(status="cancelled", reason=reason))
                _tell(connection, batch_id, "state")


def _waiting_runs(batch_id: str) -> Select[Any]:
    return (
        select(batch_runs)
        .where(batch_runs.c.batch_id == batch_id, batch_runs.c.status == "waiting")
        .order_by(batch_runs.c.position)
    )


def _update_waiting(batch_id: str) -> Update:
    return update(batch_runs).where(batch_runs.c.batch_id == batch_id, batch_runs.c.status == "waiting")


def _lock(connection: Connection, batch_id: str) -> None:
    """Writers of one batch wait for each other, so that counts and event numbers are in order (SQLite: all wait)."""
    connection.execute(select(batches.c.id).where(batches.c.id == batch_id).with_for_update())


def _settle(connection: Connection, batch_id: str, keys: Sequence[str]) -> None:
    """Waiting runs take the status of their result, which is stored."""
    counts = {}
    for status in ("ok", "failed"):
        of_status = select(results.c.key).where(results.c.key.in_(keys), results.c.status == status)
        changed = connection.execute(
            _update_waiting(batch_id).where(batch_runs.c.result_key.in_(of_status)).values(status=status)
        )
        counts[status] = changed.rowcount
    _count(connection, batch_id, done=counts["ok"], failed=counts["failed"])


def _count(connection: Connection, batch_id: str, *, done: int, failed: int) -> None:
    """So many more runs have come to an end; an event tells."""
    if not done and not failed:
        return
    connection.execute(
        update(batches)
        .where(batches.c.id == batch_id)
        .values(done=batches.c.done + done, failed=batches.c.failed + failed)
    )
    _tell(connection, batch_id, "progress")


def _change_state(connection: Connection, batch_id: str, before: Sequence[str], state: State, **values: Any) -> bool:
    changed = connection.execute(
        update(batches).where(batches.c.id == batch_id, batches.c.state.in_(before)).values(state=state, **values)
    )
    return changed.rowcount > 0


def _tell(connection: Connection, batch_id: str, kind: str) -> None:
    """Add an event with the batch as this transaction leaves it."""
    batch = connection.execute(
        select(batches.c.state, batches.c.done, batches.c.failed, batches.c.total).where(batches.c.id == batch_id)
    ).one()
    last = connection.execute(
        select(func.coalesce(func.max(batch_events.c.number), 0)).where(batch_events.c.batch_id == batch_id)
    ).scalar_one()
    told = {"state": batch.state, "done": batch.done, "failed": batch.failed, "total": batch.total}
    data = orjson.dumps(told).decode()
    connection.execute(insert(batch_events), {"batch_id": batch_id, "number": last + 1, "kind": kind, "data": data})


def _batch(row: Row[Any]) -> StoredBatch:
    return StoredBatch(
        id=row.id,
        state=row.state,
        reason=row.reason,
        core_version=row.core_version,
        schema_version=row.schema_version,
        scenario=orjson.loads(row.scenario),
        strategies=orjson.loads(row.strategies),
        sweep=orjson.loads(row.sweep),
        fields=orjson.loads(row.fields),
        estimated_cost=row.estimated_cost,
        total=row.total,
        done=row.done,
        failed=row.failed,
        request_hash=row.request_hash,
        created_at=utc(row.created_at),
        started_at=utc(row.started_at) if row.started_at else None,
        finished_at=utc(row.finished_at) if row.finished_at else None,
    )
