"""Mixed work of the store by seed, each piece one transaction: `python -m tests.faults.power.work URL SEED PIECES`.

After each piece its process notes what the database then has: that is acknowledged.
"""

import hashlib
import os
import sys
from collections.abc import Callable, Iterator
from pathlib import Path

import numpy as np
import orjson

from backend import digest
from backend.db import sqlite
from backend.db.database import Database
from backend.db.tables import metadata
from backend.job_run import JobRun
from backend.outcome import Outcome
from backend.store import Store, StoredJob, StoredLink, StoredRun
from sim_core.scenario import SCHEMA_VERSION, Scenario
from sim_core.scenario.measured import MeasuredRoad
from tests.faults.power.disk import note

STRATEGIES = ("lv", "lqr", "passive")


def rows(database: Database) -> dict[str, list[str]]:
    """Every row of every table, by the table's name."""
    found = {}
    with database.reading() as connection:
        for table in metadata.sorted_tables:
            columns = ", ".join(column.name for column in table.columns)
            order = ", ".join(column.name for column in table.primary_key)
            read = connection.exec_driver_sql(f"SELECT {columns} FROM {table.name} ORDER BY {order}")  # noqa: S608  # names of our own tables
            found[table.name] = [repr(tuple(row)) for row in read]
    return found


def content(database: Database) -> str:
    """A digest of every row."""
    return hashlib.sha256(repr(rows(database)).encode()).hexdigest()


def stored_run(scenario: Scenario, rng: np.random.Generator) -> StoredRun:
    """A run with random results."""
    return StoredRun(
        id=digest.run_id(scenario, STRATEGIES),
        core_version="0.4.0",
        schema_version=SCHEMA_VERSION,
        scenario=scenario.model_dump(mode="json"),
        results=tuple(outcome(digest.result_key(scenario, name), name, rng) for name in STRATEGIES),
    )


def outcome(key: str, strategy: str, rng: np.random.Generator) -> Outcome:
    """A result with sixty random numbers."""
    numbers = {f"metric_{index}": value for index, value in enumerate(rng.normal(0, 1, 60).tolist())}
    return Outcome(key=key, strategy=strategy, status="ok", json=orjson.dumps({"metrics": numbers}), compute_ms=5.0)


class Work:
    """Pieces of work, chosen by seed.

    Attributes:
        store: On which it is done.
    """

    def __init__(self, store: Store, seed: int) -> None:
        self.store = store
        self._rng = np.random.default_rng(seed)
        self._run_ids: list[str] = []
        self._job_ids: list[str] = []
        self._pieces: tuple[Callable[[], object], ...] = (
            self._run,
            self._run,
            self._link,
            self._road,
            self._batch,
            self._results,
            self._results,
            self._results,
            self._change,
            self._purge,
        )

    def do(self) -> None:
        """The next piece."""
        self._pieces[self._rng.integers(len(self._pieces))]()

    def _run(self) -> None:
        scenario = Scenario.model_validate({"road": {"seed": int(self._rng.integers(1, 10**6))}})
        run = stored_run(scenario, self._rng)
        self.store.runs.save(run)
        self._run_ids.append(run.id)

    def _link(self) -> None:
        if self._run_ids:
            run = self.store.runs.load(str(self._rng.choice(self._run_ids)))
            assert run is not None
            pins = {run.results[0].key: self._rng.bytes(int(self._rng.integers(100, 20_000)))}
            slug = self._rng.bytes(8).hex()
            self.store.links.save(StoredLink(slug=slug, kind="run", target=run.id, view={}), pins)

    def _road(self) -> None:
        self.store.roads.save(MeasuredRoad.of(self._rng.normal(0, 0.01, int(self._rng.integers(100, 4000)))))

    def _batch(self) -> None:
        count = int(self._rng.integers(1, 60))
        job = StoredJob(
            kind="sweep", request={"scenario": {}}, sweep={}, estimated_cost=1.0, total=count, request_hash="h"
        )
        keys = [self._rng.bytes(16).hex() for _ in range(count)]
        runs = [JobRun(at, orjson.dumps({"road.seed": at}).decode(), "lv", key) for at, key in enumerate(keys)]
        self.store.jobs.create(job, runs, self._rng.bytes(4).hex())
        self._job_ids.append(job.id)

    def _results(self) -> None:
        if self._job_ids:
            job_id = str(self._rng.choice(self._job_ids))
            runs = self.store.job_runs.waiting(job_id, range(1000))[: int(self._rng.integers(1, 30))]
            computed = [outcome(run.key, "lv", self._rng) for run in runs[:-1]]
            self.store.job_runs.save(job_id, computed, "0.4.0", {run.position: "lost" for run in runs[-1:]})

    def _change(self) -> None:
        if self._job_ids:
            job_id, jobs = str(self._rng.choice(self._job_ids)), self.store.jobs
            changes: tuple[Callable[[], object], ...] = (
                lambda: jobs.start(job_id),
                lambda: jobs.finish(job_id),
                lambda: jobs.cancel(job_id),
                lambda: jobs.resume(job_id),
                lambda: jobs.set_label(job_id, self._rng.bytes(10).hex()),
                lambda: self._delete(job_id),
            )
            changes[self._rng.integers(len(changes))]()

    def _delete(self, job_id: str) -> None:
        if self.store.jobs.delete(job_id):
            self._job_ids.remove(job_id)

    def _purge(self) -> None:
        self.store.jobs.purge()


def states(url: str, seed: int, pieces: int) -> Iterator[str]:
    """Do so many pieces of work, as several services one after the other: what the database has after each."""
    store = Store(url)
    try:
        store.migrate()
        work, lives = Work(store, seed), np.random.default_rng((seed, pieces))
        yield content(store)
        for _ in range(pieces):
            work.do()
            yield content(store)
            if lives.random() < 0.02:
                store.close()
                store = Store(url)
                store.migrate()
                work.store = store
    finally:
        store.close()


def main() -> None:
    """What the module's documentation says; with WAL where RECORD_WAL says so, whatever SQLite this is."""
    sqlite.wal_is_safe = lambda _: "RECORD_WAL" in os.environ  # type: ignore[assignment]  # the journal that the drill asks for
    url, seed, pieces = sys.argv[1:]
    with Path(os.environ["RECORD_LOG"]).open("ab", buffering=0) as log:
        for state in states(url, int(seed), int(pieces)):
            note(log, state)


if __name__ == "__main__":
    main()
