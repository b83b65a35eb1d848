"""Runs, and each strategy's result stored once under its content's key."""

from collections.abc import Iterable, Mapping, Sequence
from dataclasses import dataclass, replace
from datetime import datetime
from typing import Any, Self

from sqlalchemy import Connection, Select, bindparam, delete, insert, select, update

from backend.db.columns import UNSTORED, checksum_of, is_intact
from backend.db.database import RowStore, dialect_insert, insert_new
from backend.db.tables import EXPIRED, results, run_recordings, run_results, run_roads, runs
from backend.errors import DamagedError
from backend.json_types import JsonObject
from backend.outcome import UNSTORED_FAILURE, Outcome
from backend.store.damage import drop_results
from sim_core.scenario.recorded import recording_id


@dataclass(frozen=True, slots=True, kw_only=True)
class StoredRun:
    """A run and its results; immutable once stored.

    Attributes:
        schema_version: Under which the scenario was stored.
        by_strategy: Each strategy's results in the order of the roads; strategies are in the order they are shown.
        roads: How many there are.
        baseline: The strategy that changes refer to; None for a run of one road.
    """

    id: str
    core_version: str
    schema_version: int
    scenario: JsonObject
    by_strategy: Mapping[str, Sequence[Outcome]]
    created_at: datetime = UNSTORED
    roads: int = 1
    baseline: str | None = None

    @property
    def results(self) -> list[Outcome]:
        """Return the results of the first road, then those of every further one in the same order."""
        return [item for road in zip(*self.by_strategy.values(), strict=True) for item in road]

    @property
    def expired(self) -> bool:
        """Check whether a result has to be computed: it was removed, or is a failure that is not stored."""
        return any(item.status == EXPIRED for items in self.by_strategy.values() for item in items)

    @property
    def shown(self) -> list[Outcome]:
        """Return the first road's results of the strategies that succeeded on every road: their curves are shown."""
        return [items[0] for items in self.by_strategy.values() if all(item.status == "ok" for item in items)]

    @property
    def failed_now(self) -> set[str]:
        """Return the keys of results that could not be computed, for reasons that may pass: they are not stored."""
        return {item.key for items in self.by_strategy.values() for item in items if not item.cacheable}

    def with_outcomes(self, outcomes: Mapping[str, Sequence[Outcome]], core_version: str | None = None) -> Self:
        """Return the run with strategies' outcomes on every road in place of what is missing.

        Args:
            outcomes: By strategy, road by road.
            core_version: That computed them, where it may be another one than the run's: of a strategy of which none is
                a failure that is not stored they then take the place of those that are there, too.
        """
        by_strategy = dict(self.by_strategy)
        for name in outcomes.keys() & by_strategy.keys():
            new, before = outcomes[name], by_strategy[name]
            if core_version is not None and all(item.cacheable for item in new):
                by_strategy[name] = [replace(item, core_version=core_version) for item in new]
            else:
                pairs = zip(before, new, strict=True)
                by_strategy[name] = [replace(now, key=old.key) if old.status == EXPIRED else old for old, now in pairs]
        return replace(self, by_strategy=by_strategy)


_STORED_NAMES = [column.name for column in runs.c if column.name not in ("created_at", "checksum")]
# Made once: to make them takes as long as to run them.
_HEAD = select(runs).where(runs.c.id == bindparam("run"))
_MEMBERS: Select[Any] = (
    select(*results.c, run_results.c.position)
    .join(run_results, run_results.c.result_key == results.c.key)
    .where(run_results.c.run_id == bindparam("run"))
    .order_by(run_results.c.position)
)


class RunStore(RowStore):
    """Reads and writes runs; safe for several threads and several processes."""

    def load(self, run_id: str) -> StoredRun | None:
        """Return the run of that id, if it is stored; a result that is damaged has expired.

        Raises:
            DamagedError: The run itself is damaged.
        """
        with self._database.reading() as connection:
            head = connection.execute(_HEAD, {"run": run_id}).one_or_none()
            members = [] if head is None else connection.execute(_MEMBERS, {"run": run_id}).all()
        if head is None:
            return None
        if not is_intact(runs, head) or [row.position for row in members] != list(range(len(members))):
            raise DamagedError("run")
        damaged = {row.key for row in members if not is_intact(results, row)}
        if damaged:
            drop_results(self._database, damaged)
        outcomes = [_outcome(row, lost=row.key in damaged) for row in members]
        first_road = outcomes[: len(outcomes) // head.roads]
        values = {name: getattr(head, name) for name in (*_STORED_NAMES, "created_at")}
        by_strategy = {item.strategy: outcomes[place :: len(first_road)] for place, item in enumerate(first_road)}
        return StoredRun(**values, by_strategy=by_strategy)

    def load_results(self, keys: Iterable[str]) -> dict[str, Outcome]:
        """Return the stored ones of these results, by key."""
        query = select(results).where(results.c.key.in_(list(keys)), results.c.status != EXPIRED)
        with self._database.reading() as connection:
            rows = connection.execute(query).all()
        damaged = {row.key for row in rows if not is_intact(results, row)}
        if damaged:
            drop_results(self._database, damaged)
        return {row.key: _outcome(row) for row in rows if row.key not in damaged}

    def save(self, run: StoredRun) -> None:
        """Commit a run and those of its results that are not stored.

        Of a failure that is not `cacheable` it has an expired result. Where another process stored the same run first,
        that one stays: content-addressed results never change.
        """
        with self._database.writing() as connection:
            insert_results(connection, run.results, run.core_version)
            insert_new(connection, runs, [{name: getattr(run, name) for name in _STORED_NAMES}])
            insert_new(connection, run_results, _members(run))
            if (road := run.scenario["road"]["profile"]) is not None:
                insert_new(connection, run_roads, [{"run_id": run.id, "road_id": road}])
            for recording in map(recording_id, run.by_strategy):
                if recording is not None:
                    insert_new(connection, run_recordings, [{"run_id": run.id, "recording_id": recording}])

    def recompute(self, run: StoredRun, core_version: str) -> None:
        """Replace the results of a stored run by these.

        Args:
            run: As it is now. Where all of it is of that core version, its scenario is stored with the fields of today.
            core_version: That computed those of its results that are not stored.
        """
        with self._database.writing() as connection:
            insert_results(connection, run.results, core_version)
            connection.execute(delete(run_results).where(run_results.c.run_id == run.id))
            connection.execute(insert(run_results), _members(run))
            if run.core_version == core_version:
                values = {name: getattr(run, name) for name in _STORED_NAMES}
                values["checksum"] = checksum_of(runs, values)
                connection.execute(update(runs).where(runs.c.id == run.id).values(**values))


def insert_results(connection: Connection, outcomes: Iterable[Outcome], core_version: str) -> set[str]:
    """Insert the results that are missing or have expired, in the key's order, as `insert_new`; returns their keys.

    Of a failure that is not stored a result that has expired is inserted.
    """
    rows: list[dict[str, object]] = []
    for item in sorted(outcomes, key=lambda item: item.key):
        status, summary, compute_ms = EXPIRED, UNSTORED_FAILURE.decode(), 0.0
        if item.cacheable:
            status, summary, compute_ms = item.status, item.json.decode(), item.compute_ms
        row = {"key": item.key, "strategy": item.strategy, "core_version": core_version}
        rows.append({**row, "status": status, "summary": summary, "compute_ms": compute_ms})
    if not rows:
        return set()
    new = dialect_insert(connection, results)
    columns = ("core_version", "status", "summary", "compute_ms", "created_at", "checksum")
    replacing = new.on_conflict_do_update(
        index_elements=[results.c.key],
        set_={name: new.excluded[name] for name in columns},
        where=results.c.status == EXPIRED,
    )
    return set(connection.execute(replacing.returning(results.c.key), rows).scalars())


def _outcome(row: Any, *, lost: bool = False) -> Outcome:
    """Return the outcome that a row of `results` has; a lost one has expired."""
    return Outcome(
        key=row.key,
        strategy=row.strategy,
        status=EXPIRED if lost else row.status,
        json=b"{}" if lost else row.summary.encode(),
        compute_ms=row.compute_ms,
        core_version=row.core_version,
        cached=True,
    )


def _members(run: StoredRun) -> list[dict[str, object]]:
    return [{"run_id": run.id, "position": n, "result_key": item.key} for n, item in enumerate(run.results)]
