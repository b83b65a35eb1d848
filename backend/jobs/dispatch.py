"""Chunks are sent to what computes them, come back, and are stored in the database."""

import asyncio
import itertools
import logging
import time
from collections.abc import Mapping, Sequence

import orjson
from sqlalchemy.exc import DataError, IntegrityError, ProgrammingError, SQLAlchemyError

from backend import custom_controllers, metrics
from backend.compute.chunk_messages import Chunk, ChunkError, ChunkOutcome
from backend.compute.executor import Executor, ExecutorLostError
from backend.compute.workers import Workers
from backend.errors import CHEAPER_RUN, ServiceError, WorkerLostError, WorkerTimeoutError
from backend.job_run import JobRun
from backend.jobs.chunk_cutter import RunningJob
from backend.outcome import Outcome
from backend.store import Store, StoredJob
from backend.store.roads import PROFILE
from sim_core import __version__ as CORE_VERSION
from sim_core.scenario.measured import MeasuredRoad

logger = logging.getLogger(__name__)

CHUNK_BUDGET = 2.0  # a chunk is cut short after this, where its runs take longer than those before [s]
KEY_COST = 0.0003  # of one run [s of one core]
PAUSE_AFTER_FAILURE = 2.0  # after the database or the executor failed [s]
PERMANENT = (IntegrityError, DataError, ProgrammingError)  # what the database will never take
REASONS: dict[ChunkError, str] = {
    "lost": "The computation ended unexpectedly, twice",
    "timeout": f"The computation took longer than the limit and was ended; {CHEAPER_RUN}",
    "bug": "The computation failed with an unforeseen error; it is in the service's log",
}


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
        """Store a chunk's results, and wait for the database as long as it is away."""
        new, failed = await self._save(running.job, computed, failures)
        stored = [run for run in computed if run.key in new]  # not what was sent again while it waited for the database
        refused = sum(run.status == "failed" for run in stored)
        metrics.count_runs("batch", "ok", len(stored) - refused, sum(run.fallbacks for run in stored))
        metrics.count_runs("batch", "failed", refused + failed)

    async def _save(
        self, job: StoredJob, computed: Sequence[Outcome], failures: Mapping[int, str]
    ) -> tuple[set[str], int]:
        """Store them as `JobRunStore.save` does, as often as the database is away."""
        while True:
            try:
                return await self._store.write(self._store.job_runs.save, job.id, computed, CORE_VERSION, failures)
            except PERMANENT as error:
                logger.exception("The database takes no results of job %s", job.id)
                reason = f"The result could not be stored: {type(error).__name__}; it is in the service's log"
                await self._store.write(self._store.jobs.fail, job, reason)
                return set(), 0
            except SQLAlchemyError as error:
                logger.warning("A chunk waits for the database: %s", type(error).__name__)
                await asyncio.sleep(PAUSE_AFTER_FAILURE)


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
