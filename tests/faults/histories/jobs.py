"""Histories of jobs: two replicas' schedulers on one database, with users, pauses and failures by seed."""

import asyncio
import contextlib
import contextvars
import sqlite3
from collections import Counter
from pathlib import Path
from types import SimpleNamespace
from typing import Any
from unittest.mock import patch

from backend.compute.chunk_messages import Chunk, ChunkOutcome
from backend.compute.executor import ExecutorLostError
from backend.compute.local_executor import LocalExecutor
from backend.job_run import JobRun
from backend.jobs import retention, scheduler
from backend.jobs.kind import JobKind
from backend.jobs.scheduler import Scheduler
from backend.outcome import Outcome
from backend.settings import Settings
from backend.store import Store, StoredJob
from backend.store.job import FINAL
from tests.faults.histories.lead import Server
from tests.faults.histories.loop import SimulatedLoop, replica
from tests.faults.histories.workers import Machine

LASTS = 120.0  # for which users act and faults happen [s]
HEALED = 400.0  # afterwards every job has to end within so long [s]
STOPPED = 6.0  # after a cancellation no chunk of the job begins, where nothing fails or rests [s]
BEGUN = 30.0  # a new job has its first chunk by then, likewise [s]
PAUSE = 60.0  # the longest of a replica [s]
ENDED = 60.0  # a service has ended by then [s]
TAKEN_OVER = 25.0  # another one leads by then, where one rests for longer [s]


class Jobs:
    """One history of two replicas.

    Attributes:
        loop: Its clock and chances.

    Args:
        seed: Names it.
        folder: For its database.
        lasts: Users act and faults happen for so long [s].
    """

    def __init__(self, seed: int, folder: Path, lasts: float = LASTS) -> None:
        self.loop = SimulatedLoop(seed)
        self._rng, self._file = self.loop.rng, folder / "ridelab.sqlite"
        self._server, self._machine = Server(self.loop), Machine(self.loop, self._duration)
        self._end = self.loop.time() + lasts
        self._server.writing = self._pause_in_a_write
        self._machine.begun, self._machine.answer = self._begun, self._answer
        self._troubled = bool(self._rng.random() < 0.6)
        self._settled: dict[tuple[str, int], tuple[str, str | None]] = {}
        self._results: dict[str, str] = {}
        self._computed: Counter[str] = Counter()
        self._cancelled: dict[str, float] = {}  # jobs by when
        self._waiting_since: dict[str, float] = {}  # for a first chunk
        self._resumed: set[str] = set()
        self._version: tuple[int] | None = None

    def run(self) -> int:
        """Drive it; the number of its steps. Raises BrokenPromiseError where an invariant does not hold."""
        return self.loop.drive(self._run)

    async def _run(self) -> None:
        kind = JobKind(name="sweep", word="batch", plural="batches", compute=_never)
        schedulers: list[Scheduler] = []
        with contextlib.ExitStack() as open_now:
            self._store = open_now.enter_context(contextlib.closing(Store(f"sqlite:///{self._file}")))
            self._store.migrate()
            self._looking = open_now.enter_context(contextlib.closing(sqlite3.connect(self._file)))
            for module in (scheduler, retention):
                open_now.enter_context(patch.object(module, "time", SimpleNamespace(monotonic=self.loop.time)))
            with patch.object(scheduler, "Leadership", self._leadership):
                for name in ("first", "second"):
                    workers = open_now.enter_context(self._machine.workers(2, timeout=60.0))
                    store = open_now.enter_context(contextlib.closing(Store(f"sqlite:///{self._file}")))
                    schedulers.append(contextvars.copy_context().run(self._replica, name, store, workers, kind))
            self.loop.check = self._check
            users = [asyncio.create_task(self._user()) for _ in range(2)]
            nemesis = asyncio.create_task(self._nemesis())
            await asyncio.gather(*users, nemesis)
            end = self.loop.time() + HEALED
            while any(state not in FINAL for state in self._states().values()):
                if self.loop.time() > end:
                    self.loop.broken(f"a job waits for ever: {self._states()}")
                await asyncio.sleep(1.0)
            self.loop.check = lambda: None
            self._machine.dying = 1.0  # of the executors' end too
            end = self.loop.time() + ENDED
            for made in schedulers:
                try:
                    async with asyncio.timeout_at(end):
                        await made.close()
                except Exception as error:  # noqa: BLE001 - whatever it was
                    self.loop.broken(f"a service does not end in order: {error!r}")
                if self.loop.time() >= end:
                    self.loop.broken("a service does not end")

    def _replica(self, name: str, store: Store, workers: Any, kind: JobKind) -> Scheduler:
        replica.set(name)

        async def connect() -> LocalExecutor:
            return _Unreliable(workers, self.loop, self._machine)

        made = Scheduler(store=store, settings=Settings(), kinds=[kind], connect=connect, workers=workers)
        made.start()
        return made

    def _leadership(self, store: Store) -> Any:
        return self._server.leadership(store, replica.get())

    async def _user(self) -> None:
        mine: list[str] = []
        while self.loop.time() < self._end:
            await asyncio.sleep(float(self._rng.uniform(0.5, 10)))
            chance = self._rng.random()
            if chance < 0.5 or not mine:
                mine.append(self._submit())
            elif chance < 0.8:
                some = str(self._rng.choice(mine))
                self._cancel(some)
                if self._rng.random() < 0.5:
                    await asyncio.sleep(float(self._rng.uniform(0, 3)))
                    self._resume(some)
            else:
                self._resume(str(self._rng.choice(mine)))

    def _submit(self) -> str:
        count, job_id = int(self._rng.integers(1, 25)), f"job-{len(self._waiting_since)}"
        runs = [JobRun(at, "{}", "lv", f"{job_id}-{at}") for at in range(count)]
        job = StoredJob(
            id=job_id,
            kind="sweep",
            request={"scenario": {}},
            estimated_cost=count * float(self._rng.uniform(0.05, 2.0)),
            total=count,
            request_hash="",
        )
        self._store.jobs.create(job, runs)
        self._waiting_since[job.id] = self.loop.time()
        return job.id

    def _cancel(self, job_id: str) -> None:
        self._store.jobs.cancel(job_id)
        if self._states()[job_id] == "cancelled":
            self._cancelled.setdefault(job_id, self.loop.time())
            self._waiting_since[job_id] = float("inf")

    def _resume(self, job_id: str) -> None:
        if self._states()[job_id] in ("cancelled", "failed"):
            self._cancelled.pop(job_id, None)
            self._resumed.add(job_id)
            self._store.jobs.resume(job_id)

    async def _nemesis(self) -> None:
        """What goes wrong, until the history's faults are over."""
        while self._troubled and self.loop.time() < self._end:
            await asyncio.sleep(float(self._rng.uniform(1, 20)))
            self._machine.dying = float(self._rng.choice([0.0, 0.1, 0.5]))
            self.loop.failing = float(self._rng.choice([0.0, 0.0, 0.1, 0.6]))
            if self._rng.random() < 0.4:
                await self._pause(str(self._rng.choice(["first", "second"])), float(self._rng.uniform(1, PAUSE)))
        self._machine.dying = self.loop.failing = 0.0
        self.loop.paused.clear()

    async def _pause(self, who: str, seconds: float) -> None:
        """One replica's calls rest; if nothing else does and the database is there, the other one leads before long."""
        begun = self.loop.time()
        self.loop.pause(who, seconds)
        if seconds > TAKEN_OVER:
            self.loop.failing = 0.0
            await asyncio.sleep(TAKEN_OVER)
            leader, resting = self._server.leader, sum(until > begun for until in self.loop.paused.values())
            if resting == 1 and (leader is None or leader.name.endswith(who)):
                self.loop.broken(f"{who} rests for {seconds:.0f} s, and the other one does not lead")

    def _pause_in_a_write(self, who: str) -> None:
        if self._troubled and self.loop.time() < self._end and self._rng.random() < 0.02:
            self.loop.pause(who, float(self._rng.uniform(1, PAUSE)))

    def _duration(self, args: tuple[Any, ...]) -> float:
        return float(self._rng.uniform(0.05, 2.0))

    def _answer(self, _: Any, args: tuple[Any, ...]) -> list[Outcome]:
        """The results of a chunk, or of its first runs."""
        runs: list[JobRun] = args[0].runs
        some = runs if self._rng.random() < 0.8 else runs[: int(self._rng.integers(1, len(runs) + 1))]
        self._computed.update(run.key for run in some)
        return [
            Outcome(key=run.key, strategy="lv", status="ok", json=b'{"metrics":{}}', compute_ms=100.0) for run in some
        ]

    def _begun(self, args: tuple[Any, ...]) -> None:
        runs: list[JobRun] = args[0].runs
        query = "SELECT job_id FROM job_runs WHERE result_key = ?"
        (job_id,) = self._looking.execute(query, [runs[0].key]).fetchone()
        now = self.loop.time()
        if self._troubled:
            return
        if now - self._cancelled.get(job_id, now) > STOPPED:
            self.loop.broken("a chunk of a cancelled job begins")
        if now - self._waiting_since.get(job_id, now) > BEGUN:
            self.loop.broken("a job waited too long for its first chunk")
        self._waiting_since[job_id] = float("inf")

    def _states(self) -> dict[str, str]:
        return dict(self._looking.execute("SELECT id, state FROM jobs").fetchall())

    def _check(self) -> None:
        """What is stored, where something has changed."""
        version = self._looking.execute("PRAGMA data_version").fetchone()
        if version == self._version:
            return
        self._version = version
        rows = self._looking.execute("SELECT job_id, position, status, reason, result_key FROM job_runs").fetchall()
        stored = dict(self._looking.execute("SELECT key, checksum FROM results").fetchall())
        counts = self._looking.execute("SELECT id, state, done, failed FROM jobs").fetchall()
        for key, checksum in self._results.items():
            if stored.get(key) != checksum:
                self.loop.broken(f"the result {key} was lost or changed")
        self._results = stored
        found: Counter[tuple[str, str]] = Counter()
        for job_id, position, status, reason, key in rows:
            found[job_id, status] += 1
            at, now = (job_id, position), (status, reason)
            if self._settled.get(at, now) != now:
                self.loop.broken(f"run {at} was {self._settled[at]} and is {now}")
            if status not in ("ok", "failed"):
                continue
            self._settled[at] = now
            if status == "ok" and key not in stored:
                self.loop.broken(f"run {at} has lost its result")
            if not self._troubled and job_id not in self._resumed and self._computed[key] > 1:
                self.loop.broken(f"run {at} was computed twice")
        for job_id, state, done, failed in counts:
            if (found[job_id, "ok"], found[job_id, "failed"]) != (done, failed):
                self.loop.broken(f"{job_id} counts {done} and {failed} of {found}")
            if state in ("done", "cancelled") and found[job_id, "waiting"]:
                self.loop.broken(f"{job_id} is {state}, and runs wait")
            if state == "done" and found[job_id, "cancelled"]:
                self.loop.broken(f"{job_id} is done without all its runs")


def _never(*_: Any) -> Outcome:
    raise AssertionError("nothing is computed in a history")


class _Unreliable(LocalExecutor):
    """The production executor on simulated processes; where these die it is sometimes lost as a whole."""

    def __init__(self, workers: Any, loop: SimulatedLoop, machine: Machine) -> None:
        super().__init__(workers)
        self._loop, self._machine = loop, machine

    async def compute(self, chunk: Chunk) -> ChunkOutcome:
        if self._machine.dying and self._loop.rng.random() < 0.05:
            raise ExecutorLostError("gone")
        return await super().compute(chunk)

    async def close(self) -> None:
        await super().close()
        if self._machine.dying and self._loop.rng.random() < 0.5:
            raise RuntimeError("it does not end in order")
