"""Chunks of about a second are cut of a job's runs, sent to what computes them, come back, and are stored."""

import asyncio
import itertools
import logging
import math
import time
from collections import Counter
from collections.abc import Mapping, Sequence
from dataclasses import dataclass, field

import numpy as np
import orjson
from numpy.typing import NDArray
from sqlalchemy.exc import DataError, IntegrityError, ProgrammingError, SQLAlchemyError

from backend import digest, metrics
from backend.compute.chunk_messages import Chunk, ChunkError, ChunkOutcome, ComputeRun
from backend.compute.executor import Executor, ExecutorLostError
from backend.compute.workers import Workers
from backend.custom_controllers import registry as custom_controllers
from backend.errors import CHEAPER_RUN, ServiceError, WorkerLostError, WorkerTimeoutError
from backend.job_run import JobRun
from backend.jobs.kind import JobKind
from backend.outcome import Outcome
from backend.store import Store, StoredJob
from backend.store.roads import PROFILE
from sim_core import __version__ as CORE_VERSION
from sim_core.scenario.measured import MeasuredRoad

logger = logging.getLogger(__name__)

CHUNK_SECONDS = 1.0  # a chunk is cut to take about so long
LONGEST_CHUNK = 1000  # runs
MOST_CRASHES = 3  # a run alone may lose its processes so often (two each time) before it fails
CHUNK_BUDGET = 2.0  # a chunk is cut short after this, where its runs take longer than those before [s]
KEY_COST = 0.0003  # of one run [s of one core]
PAUSE_AFTER_FAILURE = 2.0  # after the database or the executor failed [s]
PERMANENT = (IntegrityError, DataError, ProgrammingError)  # what the database will never take
REASONS: dict[ChunkError, str] = {
    "lost": "The computation ended unexpectedly, twice",
    "timeout": f"The computation took longer than the limit and was ended; {CHEAPER_RUN}",
    "bug": "The computation failed with an unforeseen error; it is in the service's log",
}


@dataclass(slots=True, kw_only=True)
class RunningJob:
    """A job whose runs are being computed.

    Attributes:
        job: The stored job as it was at the start.
        kind: What is computed of its runs.
        group: Cancels all its chunks together.
        order: Positions of the runs that waited at the start, in the order in which they are computed.
        sent: How many of them are sent.
        to_resend: Chunks to send again before new ones are cut.
        open_chunks: Chunks sent and not yet stored.
        last_send: Number of its last chunk among all chunks sent.
        run_seconds: Mean time of a run in the chunks so far [s].
        crash_count: How often a run alone lost its processes, by position.
    """

    job: StoredJob
    kind: JobKind
    group: str = field(default_factory=digest.random_id)
    order: NDArray[np.intp]
    sent: int = 0
    to_resend: list[list[JobRun]] = field(default_factory=list)
    open_chunks: int = 0
    last_send: int = 0
    run_seconds: float | None = None
    crash_count: Counter[int] = field(default_factory=Counter)

    @property
    def compute(self) -> ComputeRun:
        """Return what a worker computes of each run."""
        if self.kind.compute is None:
            raise TypeError(f"Jobs of the kind {self.kind.name} have no runs")
        return self.kind.compute

    async def next_chunk(self, store: Store, max_chunks: int) -> list[JobRun]:
        """Return the next chunk, where all jobs have at most `max_chunks` open; empty where no run is left."""
        if self.to_resend:
            return self.to_resend.pop(0)
        size = self.size(max_chunks)
        while next_ones := self.order[self.sent : self.sent + size].tolist():
            self.sent += len(next_ones)
            waiting = {run.position: run for run in await store.read(store.job_runs.waiting, self.job.id, next_ones)}
            if waiting:
                return [waiting[each] for each in next_ones if each in waiting]
        return []

    def take_back(self, *chunks: list[JobRun]) -> None:
        """Send these chunks again."""
        self.to_resend += [chunk for chunk in chunks if chunk]

    def halve(self, runs: list[JobRun]) -> bool:
        """Send a chunk that failed again as two halves; False where it is a single run."""
        half = len(runs) // 2
        self.take_back(*([runs[:half], runs[half:]] if half else []))
        return half > 0

    def try_again(self, runs: list[JobRun]) -> bool:
        """Send a single run that lost its process again; False after `MOST_CRASHES` tries."""
        self.crash_count[runs[0].position] += 1
        if self.crash_count[runs[0].position] == MOST_CRASHES:
            return False
        self.take_back(runs)
        return True

    def record_time(self, runs: int, seconds: float) -> None:
        """Update the mean time of a run: a chunk of `runs` took `seconds`."""
        if runs:
            each = seconds / runs
            self.run_seconds = each if self.run_seconds is None else 0.7 * self.run_seconds + 0.3 * each

    def size(self, max_chunks: int) -> int:
        """Return the size of the next chunk, where `max_chunks` can be open: the processes share the rest."""
        each = self.run_seconds or self.job.estimated_cost / self.job.total
        left = len(self.order) - self.sent
        return max(1, min(LONGEST_CHUNK, int(CHUNK_SECONDS / max(each, 1e-4)), math.ceil(left / max_chunks)))


class Dispatch:
    """Chunks being computed or stored.

    Args:
        store: Of the service.
        workers: Processes that give runs their keys.
        timeout: A whole chunk may take so long [s].
    """

    def __init__(self, store: Store, workers: Workers, timeout: float) -> None:
        self._store = store
        self._workers = workers
        self._timeout = timeout
        self._numbers = itertools.count()
        self._computing: dict[int, asyncio.Task[None]] = {}
        self._committing: dict[int, asyncio.Task[None]] = {}
        self.obstacle: str | None = None  # why nothing is computed, since the last that came back with results
        self.progressed = time.monotonic()  # when one came back with results, or none was there to send

    @property
    def count(self) -> int:
        """Chunks being computed or waiting to be stored."""
        return len(self._computing) + len(self._committing)

    def send(self, executor: Executor, running: RunningJob, runs: list[JobRun]) -> None:
        """Have these runs computed, and store their results; a job's first goes before others' later ones."""
        priority = -running.open_chunks
        running.open_chunks += 1
        number = next(self._numbers)
        work = self._compute_and_store(number, executor, running, runs, priority)
        self._computing[number] = asyncio.create_task(work)

    async def close(self, *, committing: bool = True) -> None:
        """Cancel the chunks being computed, and those that came back unless these are still to be stored."""
        cancelled = [*self._computing.values(), *(self._committing.values() if committing else ())]
        for task in cancelled:
            task.cancel()
        await asyncio.gather(*cancelled, return_exceptions=True)

    async def _compute_and_store(
        self, number: int, executor: Executor, running: RunningJob, runs: list[JobRun], priority: int
    ) -> None:
        try:
            runs, outcome = await self._computed(executor, running, runs, priority)
            if outcome.computed is not None:
                self.obstacle, self.progressed = None, time.monotonic()
                computed, failures = _split(running, runs, outcome.computed)
            elif await self._retry(running, runs, outcome):
                return
            else:
                computed, failures = [], {run.position: REASONS[outcome.error or "bug"] for run in runs}
            if runs:
                self._committing[number] = self._computing.pop(number)
                await self._commit(running, computed, failures)
        finally:
            self._computing.pop(number, None)
            self._committing.pop(number, None)
            running.open_chunks -= 1
            self._store.changed(running.job.id)

    async def _computed(
        self, executor: Executor, running: RunningJob, runs: list[JobRun], priority: int
    ) -> tuple[list[JobRun], ChunkOutcome]:
        """Hand these runs out; return those that had to be computed, all where that failed, and what became of them."""
        try:
            left, roads = await self._hand_out(running, runs)
            if not left:
                return [], ChunkOutcome(computed=[])
            runs = left
            return runs, await executor.compute(self._chunk(running, runs, roads, priority))
        except WorkerLostError:
            return runs, ChunkOutcome(error="lost")
        except WorkerTimeoutError:
            return runs, ChunkOutcome(error="timeout")
        except (SQLAlchemyError, OSError, ServiceError, ExecutorLostError) as error:
            return runs, ChunkOutcome(error="busy", detail=type(error).__name__)
        except Exception:  # a bug of ours: this chunk's run fails and says so, the others go on
            logger.exception("A chunk could not be sent")
            return runs, ChunkOutcome(error="bug")

    async def _hand_out(self, running: RunningJob, runs: list[JobRun]) -> tuple[list[JobRun], dict[str, MeasuredRoad]]:
        """Give the runs their keys; return those to compute, with their roads."""
        job, keys = running.job, running.kind.keys
        if keys is not None:
            base = job.request["scenario"], job.schema_version
            cost = KEY_COST * len(runs)
            runs = await self._workers.call(keys, *base, runs, client=running.group, cost=cost)
        left = await self._store.write(self._store.job_runs.hand_out, job.id, runs)
        if not left:
            running.record_time(len(runs), KEY_COST * len(runs))
        return left, await self._roads(job, left)

    def _chunk(
        self, running: RunningJob, runs: list[JobRun], roads: Mapping[str, MeasuredRoad], priority: int
    ) -> Chunk:
        return Chunk(
            compute=running.compute,
            group=running.group,
            core_version=CORE_VERSION,
            schema_version=running.job.schema_version,
            base=running.job.request["scenario"],
            runs=runs,
            roads=roads,
            budget=CHUNK_BUDGET,
            timeout=self._timeout,
            priority=priority,
            controllers=custom_controllers.controller_sources(),
        )

    async def _roads(self, job: StoredJob, runs: Sequence[JobRun]) -> dict[str, MeasuredRoad]:
        """Return the measured roads that these runs name."""
        if not job.road_ids and not any(PROFILE in run.changes for run in runs):
            return {}
        named = {orjson.loads(run.changes).get(f"road.{PROFILE}") for run in runs} | job.road_ids
        return await self._store.read(self._store.roads.load, [each for each in named if each is not None])

    async def _retry(self, running: RunningJob, runs: list[JobRun], outcome: ChunkOutcome) -> bool:
        """Halve a chunk that failed until the run that makes it fail is alone; False for that run."""
        logger.warning("A chunk of %d runs could not be computed: %s %s", len(runs), outcome.error, outcome.detail)
        if outcome.error not in REASONS:  # not the chunk's fault
            if outcome.error == "version_mismatch":
                self.obstacle = outcome.detail
            running.take_back(runs)
            await asyncio.sleep(PAUSE_AFTER_FAILURE)
            return True
        return running.halve(runs) or (outcome.error == "lost" and running.try_again(runs))

    async def _commit(self, running: RunningJob, computed: Sequence[Outcome], failures: Mapping[int, str]) -> None:
        """Store a chunk's results as `JobRunStore.save` does, as often as the database is away."""
        job = running.job
        while True:
            try:
                new, failed = await self._store.write(
                    self._store.job_runs.save, job.id, computed, CORE_VERSION, failures
                )
                break
            except PERMANENT as error:
                logger.exception("The database takes no results of job %s", job.id)
                reason = f"The result could not be stored: {type(error).__name__}; it is in the service's log"
                await self._store.write(self._store.jobs.fail, job, reason)
                return
            except SQLAlchemyError as error:
                logger.warning("A chunk waits for the database: %s", type(error).__name__)
                await asyncio.sleep(PAUSE_AFTER_FAILURE)
        stored = [run for run in computed if run.key in new]  # not what was sent again while it waited for the database
        refused = sum(run.status == "failed" for run in stored)
        metrics.count_runs("batch", "ok", len(stored) - refused, sum(run.fallbacks for run in stored))
        metrics.count_runs("batch", "failed", refused + failed)


def _split(
    running: RunningJob, runs: Sequence[JobRun], computed: Sequence[Outcome]
) -> tuple[list[Outcome], dict[int, str]]:
    """Return the results to store, and the reasons of runs without one; runs not begun are sent again."""
    reasons = {run.key: str(run.summary["reason"]) for run in computed if not run.cacheable}
    done = {run.key for run in computed}
    left = [run for run in runs if run.key not in done]
    running.record_time(len(runs) - len(left), sum(run.compute_ms for run in computed) / 1000)
    running.take_back(left)
    failures = {run.position: reasons[run.key] for run in runs if run.key in reasons}
    return [run for run in computed if run.cacheable], failures
