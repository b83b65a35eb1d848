"""A database of every kind of thing, and what becomes of it when a bit of its file flips."""

from collections import Counter
from contextlib import closing
from dataclasses import asdict
from pathlib import Path
from typing import Any

import numpy as np
import orjson
from sqlalchemy import LargeBinary, select
from sqlalchemy.exc import DBAPIError, SQLAlchemyError

from backend import digest
from backend.db.checksum import covered
from backend.db.database import Database
from backend.db.sqlite import UnusableDatabaseError
from backend.db.tables import metadata
from backend.job_run import JobRun
from backend.outcome import Outcome
from backend.store import Store, StoredJob, StoredLink, StoredRun
from backend.store.trials import StoredTrial
from backend.store.verify import SEALED, verify
from sim_core.scenario import SCHEMA_VERSION, Scenario
from sim_core.scenario.measured import MeasuredRoad
from sim_core.scenario.recorded import RecordedDrive

RUNS, STRATEGIES, POINTS = 25, ("lv", "lqr", "passive"), 12
# When something was stored decides what retention removes, and what a list begins with; no number comes from it.
TIMES = {"created_at", "started_at", "finished_at", "ended_at", "damaged_at"}


def fill(url: str) -> None:
    """Make a database with runs, links, a measured road, a recording, a batch of which a run failed and a tuning."""
    rng = np.random.default_rng(1)
    with closing(Store(url)) as store:
        store.migrate()
        store.roads.save(MeasuredRoad.of(rng.normal(0, 0.01, 2000)))
        store.recordings.save(RecordedDrive.of({"time": np.arange(900.0), "body_acceleration": rng.normal(0, 1, 900)}))
        for number in range(RUNS):
            scenario = Scenario.model_validate({"road": {"seed": number + 1}})
            run = stored_run(scenario, rng)
            store.runs.save(run)
            if number < 3:
                link = StoredLink(slug=digest.random_id(), kind="run", target=run.id, view={"strategies": ["lv"]})
                store.links.save(link, {each.key: rng.bytes(3000) for each in run.results})
        _batch(store, rng)
        _tuning(store)


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


def _batch(store: Store, rng: np.random.Generator) -> None:
    heights = rng.uniform(0.05, 0.12, POINTS + 1).tolist()
    request = {"scenario": Scenario().model_dump(mode="json"), "strategies": ["lv"], "fields": ["road.bump.height"]}
    job = StoredJob(
        kind="sweep",
        request=request,
        sweep={"grid": {"road.bump.height": heights}},
        estimated_cost=0.1,
        total=POINTS + 1,  # of which one fails
        request_hash="hash",
    )
    runs = [
        JobRun(position, orjson.dumps({"road.bump.height": height}).decode(), "lv", f"{position:043}")
        for position, height in enumerate(heights)
    ]
    store.jobs.create(job, runs, "key")
    computed = [outcome(run.key, "lv", rng) for run in runs[1:]]
    store.job_runs.save(job.id, computed, "0.4.0", {0: "Its process was killed thrice"})
    store.jobs.finish(job.id)


def _tuning(store: Store) -> None:
    progress = {"attempt": 1, "generation": 0}
    job = StoredJob(
        kind="tuning", request={"scenario": {}}, estimated_cost=1.0, total=4, request_hash="tuning", progress=progress
    )
    store.jobs.create(job)
    new = [
        StoredTrial(number=number, generation=0, weights={"lqr.weights.0": 1.5 * number}, status="ok", values=[2.5])
        for number in range(4)
    ]
    store.jobs.advance(job, event="progress", new_trials=new, progress=progress | {"generation": 1}, done=4)


def read(store: Store) -> dict[str, Any]:
    """All that the stores' methods answer, by what it is asked for."""
    ids = {table.name: _keys(store, table.name) for table in metadata.sorted_tables}
    answers: dict[str, Any] = {}
    for run_id in ids["runs"]:
        answers[f"run {run_id}"] = store.runs.load(run_id)
    for slug in ids["links"]:
        answers[f"link {slug}"] = store.links.load(slug)
    answers["pins"] = store.links.load_pins(ids["pinned_series"])
    answers["roads"] = [asdict(road) for road in store.roads.load(ids["roads"]).values()]
    answers["recordings"] = [asdict(drive) for drive in store.recordings.load(ids["recordings"]).values()]
    for job_id in ids["jobs"]:
        answers[f"job {job_id}"] = store.jobs.load(job_id)
        answers[f"rows {job_id}"] = store.job_runs.rows(job_id, -1, 1000)
        answers[f"trials {job_id}"] = store.trials.of(job_id)
    return answers


def _keys(database: Database, table: str) -> list[str]:
    with database.reading() as connection:
        keys = connection.execute(select(next(iter(metadata.tables[table].primary_key))).distinct()).scalars()
        return sorted(str(key) for key in keys)


def flip(path: Path, *, seed: int, count: int) -> tuple[Counter[str], list[str]]:
    """Flip so many bits of the file, one at a time: what came of them, and which told nobody and changed an answer.

    Each time a service's start is followed, with new connections: the whole file is read and checked, then everything
    is answered.
    """
    content = path.read_bytes()
    rng, fates, silent = np.random.default_rng(seed), Counter[str](), list[str]()
    with closing(Store(f"sqlite:///{path}")) as store:  # one for all: it remembers how its queries are written
        whole = _plain(read(store))
        for bit in rng.integers(8 * len(content), size=count).tolist():
            store.engine.dispose()
            damaged = bytearray(content)
            damaged[bit // 8] ^= 1 << bit % 8
            path.write_bytes(damaged)
            fate = _fate(store, whole)
            fates[fate] += 1
            if fate == "silent":
                silent.append(f"byte {bit // 8} of page {bit // 8 // 4096 + 1}, bit {bit % 8}")
    path.write_bytes(content)
    return fates, silent


def _fate(store: Store, whole: dict[str, Any]) -> str:
    try:
        store.migrate()
        if not verify(store).sound:
            return "told"
        answers = _plain(read(store))
    except (SQLAlchemyError, UnusableDatabaseError):
        return "told"
    return "without effect" if answers == whole else "silent"


def flip_on_server(store: Store, *, seed: int, count: int) -> tuple[Counter[str], list[str]]:
    """Flip so many bits of stored values on PostgreSQL, one at a time: what came of them, and which told nobody.

    It refuses those that leave no value of their type. Keys and the pages' own bytes are left alone.
    """
    rng, fates, silent = np.random.default_rng(seed), Counter[str](), list[str]()
    columns = [
        (table, table.c[name])
        for table in SEALED
        for name in covered(table)
        if not table.c[name].primary_key and not table.c[name].foreign_keys
    ]
    while fates.total() < count:
        table, column = columns[rng.integers(len(columns))]
        binary = isinstance(column.type, LargeBinary)
        read = f"encode({column.name}, 'hex')" if binary else f"{column.name}::text"
        with store.reading() as connection:
            query = f"SELECT pg_typeof({column.name})::text, {read} FROM {table.name}"  # noqa: S608  # our own
            rows = [row for row in connection.exec_driver_sql(query).all() if row[1]]
        if not rows:
            continue
        kind, value = rows[rng.integers(len(rows))]
        at = int(rng.integers(len(value)))
        changed = format(int(value[at], 16) ^ 1 << int(rng.integers(4)), "x") if binary else chr(ord(value[at]) ^ 1)
        new = "decode(%s, 'hex')" if binary else f"%s::{kind}"
        write = f"UPDATE {table.name} SET {column.name} = {new} WHERE {read} = %s"  # noqa: S608
        flipped = value[:at] + changed + value[at + 1 :]
        try:
            with store.writing() as connection:
                connection.exec_driver_sql(write, (flipped, value))
        except DBAPIError:
            fates["refused"] += 1
            continue
        told = bool(verify(store).damaged[table.name])
        fates["told" if told else "silent"] += 1
        if not told:
            silent.append(f"{table.name}.{column.name}: {value[:80]} -> {flipped[:80]}")
        with store.writing() as connection:
            connection.exec_driver_sql(write, (value, flipped))
    return fates, silent


def _plain(answers: dict[str, Any]) -> dict[str, Any]:
    """The answers without times."""
    return {name: _without_times(value) for name, value in answers.items()}


def _without_times(value: Any) -> Any:
    if isinstance(value, list | tuple):
        return [_without_times(each) for each in value]
    if hasattr(value, "__dataclass_fields__"):
        names = [name for name in value.__dataclass_fields__ if name not in TIMES]
        return {name: _without_times(getattr(value, name)) for name in names}
    return value
