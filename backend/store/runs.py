"""Runs, and each strategy's result stored once under its content's key."""

from collections.abc import Iterable, Mapping, Sequence
from dataclasses import dataclass, replace
from datetime import datetime
from typing import Any, Self

from sqlalchemy import Connection, Select, bindparam, delete, insert, select, update

from backend.db.checksum import check, checksum_of
from backend.db.database import RowStore, dialect_insert, insert_new
from backend.db.tables import EXPIRED, results, run_recordings, run_results, run_roads, runs
from backend.db.types import UNSTORED
from backend.errors import DamagedError
from backend.json_types import JsonObject
from backend.outcome import UNSTORED_FAILURE, Outcome
from backend.store.damage import drop_damaged_results
from backend.store.roads import measured_roads
from sim_core.scenario.recorded import recording_id


@dataclass(frozen=True, slots=True, kw_only=True)
class StoredRun:
    """A run and its results in the order they are shown; immutable once stored.

    Attributes:
        results: Of the first road, then those of every further one in the same order.
        roads: How many there are.
        baseline: The strategy that changes refer to; None for a run of one road.
    """

    id: str
    core_version: str
    schema_version: int
    scenario: JsonObject
    results: tuple[Outcome, ...]
    created_at: datetime = UNSTORED
    roads: int = 1
    baseline: str | None = None

    @property
    def expired(self) -> bool:
        """Whether a result is not there, so that it has to be computed: removed, or a failure that is not stored."""
        return any(item.status == EXPIRED for item in self.results)

    def with_outcomes(self, outcomes: Mapping[str, Sequence[Outcome]], core_version: str | None = None) -> Self:
        """Return the run with strategies' outcomes on every road in place of what is missing.

        Args:
            outcomes: By strategy, road by road.
            core_version: That computed them, where it may be another one than the run's: of a strategy of which none is
                a failure that is not stored they then take the place of those that are there, too.
        """
        results, count = list(self.results), len(self.first_road)
        for place, item in enumerate(self.first_road):
            new = outcomes.get(item.strategy, ())
            together = core_version is not None and all(each.cacheable for each in new)
            for road, each in enumerate(new):
                old = results[place + road * count]
                if together:
                    results[place + road * count] = replace(each, core_version=core_version)
                elif old.status == EXPIRED:
                    results[place + road * count] = replace(each, key=old.key)
        return replace(self, results=tuple(results))

    @property
    def failed_now(self) -> set[str]:
        """Return the keys of results that could not be computed, for reasons that may pass: they are not stored."""
        return {item.key for item in self.results if not item.cacheable}

    @property
    def first_road(self) -> tuple[Outcome, ...]:
        """Each strategy's result on the first road."""
        return self.results[: len(self.results) // self.roads]

    @property
    def shown(self) -> tuple[Outcome, ...]:
        """The results whose time histories are shown: on the first road, of strategies that succeeded on every road."""
        road_by_road = self.by_strategy
        return tuple(
            item for item in self.first_road if all(each.status == "ok" for each in road_by_road[item.strategy])
        )

    @property
    def by_strategy(self) -> dict[str, tuple[Outcome, ...]]:
        """Each strategy's results in the order of the roads."""
        count = len(self.first_road)
        return {item.strategy: self.results[index::count] for index, item in enumerate(self.first_road)}


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
        """Return the run of that id, if it is stored."""
        with self._database.reading() as connection:
            head = connection.execute(_HEAD, {"run": run_id}).one_or_none()
            members = [] if head is None else connection.execute(_MEMBERS, {"run": run_id}).all()
        if head is None:
            return None
        check(runs, head, "run")
        if [row.position for row in members] != list(range(len(members))):
            raise DamagedError("run")
        damaged = drop_damaged_results(self._database, members)  # the run has them as expired
        outcomes = tuple(_result(row, lost=row.key in damaged) for row in members)
        return StoredRun(**{name: getattr(head, name) for name in (*_STORED_NAMES, "created_at")}, results=outcomes)

    def load_results(self, keys: Iterable[str]) -> dict[str, Outcome]:
        """Return the stored ones of these results, by key."""
        query = select(results).where(results.c.key.in_(list(keys)), results.c.status != EXPIRED)
        with self._database.reading() as connection:
            rows = connection.execute(query).all()
        damaged = drop_damaged_results(self._database, rows) if rows else ()
        return {row.key: _result(row) for row in rows if row.key not in damaged}

    def save(self, run: StoredRun) -> None:
        """Commit a run and those of its results that are not stored.

        Of a failure that is not `cacheable` it has an expired result. Where another process stored the same run first,
        that one stays: content-addressed results never change.
        """
        with self._database.writing() as connection:
            insert_results(connection, run.results, run.core_version)
            insert_new(connection, runs, [{name: getattr(run, name) for name in _STORED_NAMES}])
            insert_new(connection, run_results, _members(run.id, run.results))
            for road in measured_roads(run.scenario):
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
            connection.execute(insert(run_results), _members(run.id, run.results))
            if run.core_version == core_version:
                values = {name: getattr(run, name) for name in _STORED_NAMES}
                values["checksum"] = checksum_of(runs, values)
                connection.execute(update(runs).where(runs.c.id == run.id).values(**values))


def insert_results(connection: Connection, outcomes: Iterable[Outcome], core_version: str) -> set[str]:
    """Insert the results that are missing or have expired, in the key's order, as `insert_new`; returns their keys."""
    rows = [_row(item, core_version) for item in sorted(outcomes, key=lambda item: item.key)]
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


def _row(item: Outcome, core_version: str) -> dict[str, object]:
    """Return the row of a result; of a failure that is not stored, of one that has expired."""
    row = {"key": item.key, "strategy": item.strategy, "core_version": core_version}
    if item.cacheable:
        return {**row, "status": item.status, "summary": item.json.decode(), "compute_ms": item.compute_ms}
    return {**row, "status": EXPIRED, "summary": UNSTORED_FAILURE.decode(), "compute_ms": 0.0}


def _result(row: Any, *, lost: bool = False) -> Outcome:
    return Outcome(
        key=row.key,
        strategy=row.strategy,
        status=EXPIRED if lost else row.status,
        json=b"{}" if lost else row.summary.encode(),
        compute_ms=row.compute_ms,
        core_version=row.core_version,
        cached=True,
    )


def _members(run_id: str, outcomes: Sequence[Outcome]) -> list[dict[str, object]]:
    return [{"run_id": run_id, "position": position, "result_key": item.key} for position, item in enumerate(outcomes)]
