"""The scheduler with an executor that misbehaves: what cannot be computed fails alone, all else completes."""

import asyncio
import contextlib
import itertools
import sqlite3
import threading
from collections.abc import AsyncIterator, Callable, Iterable, Sequence
from dataclasses import replace
from pathlib import Path
from typing import Any

import numpy as np
import orjson
import pytest
from sqlalchemy.exc import IntegrityError, OperationalError

from backend.batches.kind import SWEEP, coarse_first
from backend.batches.plan import with_keys
from backend.compute.chunk_messages import Chunk, ChunkError, ChunkOutcome
from backend.compute.executor import ExecutorLostError
from backend.db import sqlite
from backend.db.sqlite import DatabaseLockedError
from backend.errors import WorkerLostError, WorkerTimeoutError
from backend.job_run import JobRow, JobRun
from backend.jobs import dispatch, scheduler
from backend.jobs.kind import JobKind, JobSize, RunKeys
from backend.jobs.leadership import Leadership, LeadershipLostError
from backend.jobs.scheduler import Scheduler
from backend.outcome import Outcome
from backend.settings import Settings
from backend.store import Store, StoredJob
from backend.store.roads import RoadStore
from sim_core import __version__ as CORE_VERSION
from sim_core.scenario import Scenario
from sim_core.scenario.measured import MeasuredRoad
from tests.servers import loops
from tests.servers.process import HANG_TIMEOUT

RUNS = 40
Behaviour = Callable[[Chunk], ChunkOutcome]


def answered(chunk: Chunk) -> ChunkOutcome:
    done = [
        Outcome(key=run.key, strategy=run.strategy, status="ok", json=b'{"metrics":{}}', compute_ms=1.0)
        for run in chunk.runs
    ]
    return ChunkOutcome(computed=done)


def seeds(chunk: Chunk) -> list[int]:
    return [int(run.changes.split(":")[1].rstrip("}")) for run in chunk.runs]


class Misbehaving:
    """An executor; every chunk goes to `behaviour`, and is counted."""

    behaviour: Behaviour = staticmethod(answered)
    chunks: Sequence[Chunk] = ()
    starts = 0
    delay = 0.0  # of every chunk [s]

    def __init__(self) -> None:
        self.connected = True
        type(self).starts += 1

    async def capacity(self) -> int:
        if not self.connected:
            raise ExecutorLostError("gone")
        return 2

    async def compute(self, chunk: Chunk) -> ChunkOutcome:
        if not self.connected:
            raise ExecutorLostError("gone")
        type(self).chunks = [*self.chunks, chunk]
        await asyncio.sleep(self.delay)
        try:
            return type(self).behaviour(chunk)
        except ConnectionError:
            self.connected = False
            raise ExecutorLostError("gone") from None

    async def stop(self, _: str) -> None:
        pass

    async def close(self) -> None:
        pass


@pytest.fixture(autouse=True)
def quick(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(Misbehaving, "chunks", ())
    monkeypatch.setattr(Misbehaving, "starts", 0)
    monkeypatch.setattr(scheduler, "PAUSE_AFTER_FAILURE", 0.01)
    monkeypatch.setattr(dispatch, "PAUSE_AFTER_FAILURE", 0.01)
    monkeypatch.setattr(scheduler, "JOB_POLL_INTERVAL", 0.02)


async def connected() -> Misbehaving:
    return Misbehaving()


class Here:
    """Stands for `backend.compute.workers.Workers`, without processes."""

    async def call(self, function: Callable[..., Any], *args: Any, **_: Any) -> Any:
        return function(*args)


async def planning(*_: object) -> JobSize:
    """As of a job that is never planned."""
    await asyncio.Event().wait()
    raise AssertionError


def submitted(
    store: Store, *, core_version: str = CORE_VERSION, first_seed: int = 0, road: MeasuredRoad | None = None
) -> StoredJob:
    """A batch, accepted by that core version, with that version's keys; on a measured road where there is one."""
    base = Scenario().model_dump(mode="json")
    if road is not None:
        store.roads.save(road)
        base["road"]["profile"] = road.id
    seeds = list(range(first_seed, first_seed + RUNS))
    runs = [JobRun(position, orjson.dumps({"road.seed": seed}).decode(), "lv") for position, seed in enumerate(seeds)]
    request = {"scenario": base, "strategies": ["lv"], "fields": ["road.seed"], "shape": [RUNS]}
    batch = StoredJob(
        kind="sweep", request=request, estimated_cost=1, total=RUNS, request_hash="", core_version=core_version
    )
    if core_version != CORE_VERSION:
        runs = [each._replace(key=f"old-{each.position}") for each in runs]
    return store.jobs.create(batch, runs)[0]


def drive(
    folder: Path,
    behaviour: Behaviour,
    *,
    core_version: str = CORE_VERSION,
    road: MeasuredRoad | None = None,
    others: int = 0,
    keys: RunKeys = with_keys,
    **patches: Any,
) -> list[JobRow]:
    """The rows of a batch after a driver with that cluster has finished it, beside so many others."""

    async def run() -> list[JobRow]:
        store = Store(f"sqlite:///{folder}/ridelab.sqlite")
        store.migrate()
        batch = submitted(store, core_version=core_version, road=road)
        for number in range(1, others + 1):
            submitted(store, first_seed=number * RUNS)
        for name, value in patches.items():
            setattr(store.job_runs, name, value(getattr(store.job_runs, name)))
        async with led(store, folder, replace(SWEEP, plan=planning, keys=keys), behaviour):
            await end_of(store, batch.id)
        rows = store.job_runs.rows(batch.id, -1, 1000)
        store.close()
        return rows

    return loops.run(run)


@contextlib.asynccontextmanager
async def led(store: Store, folder: Path, kind: JobKind, behaviour: Behaviour = answered) -> AsyncIterator[None]:
    """Have jobs of a kind driven meanwhile, for as long as they may take, with such an executor."""
    Misbehaving.behaviour = staticmethod(behaviour)
    leading = Scheduler(
        store=store,
        settings=Settings(data_dir=folder),
        kinds=[kind],
        connect=connected,
        workers=Here(),  # type: ignore[arg-type]  # what is used of them
    )
    leading.start()
    try:
        async with asyncio.timeout(HANG_TIMEOUT):
            yield
    finally:
        await leading.close()


async def end_of(store: Store, batch_id: str) -> None:
    while not await ended(store, batch_id):
        await asyncio.sleep(0.02)


async def ended(store: Store, batch_id: str) -> bool:
    with contextlib.suppress(DatabaseLockedError):
        batch = await store.read(store.jobs.load, batch_id)
        return batch is not None and batch.state in ("done", "failed")
    return False


def test_a_grid_is_computed_from_coarse_to_fine(tmp_path: Path) -> None:
    drive(tmp_path, answered)
    in_turn = [seed for chunk in Misbehaving.chunks for seed in seeds(chunk)]
    assert in_turn == [*range(0, 40, 8), *range(4, 40, 8), *range(2, 40, 4), *range(1, 40, 2)]
    shape = {"strategies": ["lv", "lqr"], "shape": [2, 5]}
    two = StoredJob(kind="sweep", request=shape, estimated_cost=1, total=20, request_hash="")
    assert coarse_first(two).tolist()[:6] == [0, 1, 8, 9, 4, 5], "both strategies of points (0, 0), (0, 4), (0, 2)"


def test_every_job_begins_at_once_and_first_chunks_go_first(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(Misbehaving, "delay", 0.3)
    drive(tmp_path / "alone", answered)  # two processes have room for four
    assert [chunk.priority for chunk in Misbehaving.chunks[:4]] == [0, -1, -2, -3]
    monkeypatch.setattr(Misbehaving, "chunks", ())
    drive(tmp_path / "beside", answered, others=5)
    first = Misbehaving.chunks[:6]
    assert len({chunk.group for chunk in first}) == 6
    assert all(chunk.priority == 0 for chunk in first)


@pytest.mark.parametrize(("trouble", "raises"), [("lost", False), ("timeout", False), ("bug", False), ("bug", True)])
def test_a_run_that_cannot_be_computed_fails_alone(tmp_path: Path, trouble: Any, raises: bool) -> None:
    def poisoned(chunk: Chunk) -> ChunkOutcome:
        if 17 not in seeds(chunk):
            return answered(chunk)
        if raises:
            raise AttributeError("a bug")
        return ChunkOutcome(error=trouble)

    rows = drive(tmp_path, poisoned)
    assert [row.position for row in rows if row.status == "failed"] == [17]
    assert rows[17].reason == dispatch.REASONS[trouble]
    assert [row.status for row in rows].count("ok") == RUNS - 1
    alone = [chunk for chunk in Misbehaving.chunks if seeds(chunk) == [17]]
    assert len(alone) == (dispatch.MOST_CRASHES if trouble == "lost" else 1)


@pytest.mark.parametrize(
    ("trouble", "reason"), [(WorkerLostError(), "lost"), (WorkerTimeoutError(), "timeout"), (KeyError("a bug"), "bug")]
)
def test_a_run_whose_key_cannot_be_computed_fails_alone(tmp_path: Path, trouble: Exception, reason: ChunkError) -> None:
    def poisoned(scenario: Any, schema_version: int, runs: Sequence[JobRun]) -> list[JobRun]:
        if any(run.position == 17 for run in runs):
            raise trouble
        return with_keys(scenario, schema_version, runs)

    rows = drive(tmp_path, answered, keys=poisoned)
    assert [(row.position, row.reason) for row in rows if row.status == "failed"] == [(17, dispatch.REASONS[reason])]
    assert [row.status for row in rows].count("ok") == RUNS - 1


def test_what_is_not_a_chunks_fault_is_tried_until_it_works(tmp_path: Path) -> None:
    tries = {"version_mismatch": 0, "busy": 0}

    def reluctant(chunk: Chunk) -> ChunkOutcome:
        for trouble in ("version_mismatch", "busy"):
            if tries[trouble] < 5:
                tries[trouble] += 1
                return ChunkOutcome(error=trouble)
        return answered(chunk)

    assert {row.status for row in drive(tmp_path, reluctant)} == {"ok"}


@pytest.mark.parametrize("reason", ["too little memory", scheduler.NO_WORKERS])
def test_a_batch_that_does_not_advance_says_why_until_it_does(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch, reason: str
) -> None:
    monkeypatch.setattr(scheduler, "STALLED", 0.05)

    def told() -> bool:
        with contextlib.closing(sqlite3.connect(tmp_path / "ridelab.sqlite")) as stored:
            return (reason,) in stored.execute("SELECT reason FROM jobs").fetchall()

    async def capacity(_: Misbehaving) -> int:
        return 0 if reason == scheduler.NO_WORKERS and not told() else 2

    monkeypatch.setattr(Misbehaving, "capacity", capacity)

    def reluctant(chunk: Chunk) -> ChunkOutcome:
        return answered(chunk) if told() else ChunkOutcome(error="version_mismatch", detail="too little memory")

    assert {row.status for row in drive(tmp_path, reluctant)} == {"ok"}
    with contextlib.closing(sqlite3.connect(tmp_path / "ridelab.sqlite")) as stored:
        assert stored.execute("SELECT state, reason FROM jobs").fetchall() == [("done", None)]


def test_what_the_database_will_never_take_fails_the_job_and_no_other(tmp_path: Path) -> None:
    def refused(save: Callable[..., None]) -> Callable[..., None]:
        def saving(*args: Any) -> None:
            raise IntegrityError("INSERT", {}, Exception("it contradicts what is there"))

        return saving

    rows = drive(tmp_path, answered, save=refused)
    assert {row.status for row in rows} == {"cancelled"}
    assert "could not be stored: IntegrityError" in str(rows[0].reason)


def test_a_chunk_cut_short_is_finished_later(tmp_path: Path) -> None:
    def short(chunk: Chunk) -> ChunkOutcome:
        whole = answered(chunk).computed
        assert whole is not None
        return ChunkOutcome(computed=whole[:3])

    rows = drive(tmp_path, short)
    assert {row.status for row in rows} == {"ok"}
    assert max(len(chunk.runs) for chunk in Misbehaving.chunks) > 3


@pytest.mark.parametrize("reads_fail", [False, True])
def test_results_wait_for_a_database_that_is_away(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch, reads_fail: bool
) -> None:
    """Where reads fail too the lead is lost; a road that a chunk needs cannot be read at first either."""
    fails, load, failures = threading.Semaphore(40), RoadStore.load, itertools.count()
    unsaved: set[str] = set()  # a key of each chunk

    def unreliable(save: Callable[..., tuple[set[str], int]]) -> Callable[..., tuple[set[str], int]]:
        def saving(job_id: str, computed: Sequence[Outcome], *rest: Any) -> tuple[set[str], int]:
            unsaved.add(computed[0].key)
            if fails.acquire(blocking=False):
                raise OperationalError("INSERT", {}, Exception("the server is gone"))
            saved = save(job_id, computed, *rest)
            unsaved.discard(computed[0].key)
            return saved

        return saving

    async def confirm(_: Leadership) -> None:
        if reads_fail and unsaved:
            raise LeadershipLostError

    def failing(roads: RoadStore, ids: Iterable[str]) -> dict[str, MeasuredRoad]:
        if next(failures) < 3:
            raise OperationalError("SELECT", {}, Exception("the disk is away"))
        return load(roads, ids)

    monkeypatch.setattr(Leadership, "confirm", confirm)
    monkeypatch.setattr(RoadStore, "load", failing)
    road = MeasuredRoad.of(np.zeros(20_001))
    rows = drive(tmp_path, answered, save=unreliable, road=road)
    assert {row.status for row in rows} == {"ok"}
    handed = sorted(seed for chunk in Misbehaving.chunks for seed in seeds(chunk))
    assert handed == list(range(RUNS)), "computed once, committed when that was possible"
    assert {each for chunk in Misbehaving.chunks for each in chunk.roads} == {road.id}
    assert (Misbehaving.starts > 1) is reads_fail


def test_another_program_that_locks_the_database_stops_no_cluster(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    """The lock lasts longer than a read or a write waits: no computed result is lost or computed twice."""
    monkeypatch.setattr(sqlite, "LOCK_TIMEOUT", 0.1)
    stranger: list[sqlite3.Connection] = []

    def locked(chunk: Chunk) -> ChunkOutcome:
        if not stranger:
            stranger.append(sqlite3.connect(tmp_path / "ridelab.sqlite", isolation_level=None, check_same_thread=False))
            stranger[0].execute("BEGIN EXCLUSIVE")
            threading.Timer(0.5, stranger[0].close).start()
        return answered(chunk)

    rows = drive(tmp_path, locked)
    assert {row.status for row in rows} == {"ok"}
    assert sorted(seed for chunk in Misbehaving.chunks for seed in seeds(chunk)) == list(range(RUNS))
    assert Misbehaving.starts == 1


def test_what_another_core_version_left_is_computed_under_this_ones_keys(tmp_path: Path) -> None:
    rows = drive(tmp_path, answered, core_version="0.0.9")
    assert {row.status for row in rows} == {"ok"}
    assert not any(run.key.startswith("old") for chunk in Misbehaving.chunks for run in chunk.runs)


def test_a_job_that_is_planned_for_ever_holds_up_no_other(tmp_path: Path) -> None:
    store = Store(f"sqlite:///{tmp_path}/ridelab.sqlite")
    store.migrate()
    long = store.jobs.create(StoredJob(kind="sweep", state="planning", request={"scenario": {}}, request_hash=""))[0]
    assert {row.status for row in drive(tmp_path, answered)} == {"ok"}
    assert store.jobs.counts()["sweep", "planning"] == (1, 0)
    assert [job.id for job in store.jobs.unfinished()] == [long.id]
    store.close()
