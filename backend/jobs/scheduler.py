"""Leads every job to its end: run by run, in chunks that an executor computes, or step by step.

The database is the truth. This keeps no state that a crash could lose: what is unfinished is a query, and a chunk that
was on its way when a process died is waiting still. Of several services on one database one leads (`leadership`).
"""

import asyncio
import contextlib
import itertools
import logging
import time
from collections import Counter
from collections.abc import Awaitable, Callable, Collection, Iterable, Sequence
from dataclasses import asdict
from functools import partial
from typing import get_args

import numpy as np
from sqlalchemy.exc import SQLAlchemyError

from backend.compute.executor import Executor, ExecutorLostError
from backend.compute.workers import Workers
from backend.db.commits import Follower
from backend.errors import DamagedError, ServiceError, TemporaryError, WorkerLostError
from backend.job_run import JobRun
from backend.jobs.dispatch import MOST_CRASHES, Dispatch, RunningJob
from backend.jobs.kind import JobFailedError, JobKind
from backend.jobs.leadership import Leadership, LeadershipLostError
from backend.jobs.problem import problem_of
from backend.jobs.retention import Retention
from backend.settings import Settings
from backend.store import Store, StoredJob
from backend.store.job import State
from sim_core import __version__ as CORE_VERSION
from sim_core.errors import RidelabError

logger = logging.getLogger(__name__)

CHUNKS_PER_PROCESS = 2  # one is computed, one waits (test_every_job_begins_at_once_and_first_chunks_go_first)
JOB_POLL_INTERVAL = 1.0  # between two looks at what other services accepted or cancelled [s]
PAUSE_AFTER_FAILURE = 2.0  # after the database or the executor failed, or the service was full [s]
REPORT = 5.0  # between two updates of the metrics [s]
STATES: tuple[State, ...] = get_args(State)
STALLED = 20.0  # a job says why, where nothing has been computed for so long [s]
NO_WORKERS = "The Dask scheduler has no worker; one with too little memory (WORKER_MEMORY) is killed whenever it starts"
NO_SCHEDULER = "What computes the runs does not answer; the service's log says more"
MAX_TASKS = 4  # jobs planned at once, and jobs whose steps are taken at once
TRANSIENT = (SQLAlchemyError, OSError, TemporaryError, LeadershipLostError)
UNFORESEEN = "It failed with an unforeseen error, which is in the service's log"

Step = Callable[[StoredJob], Awaitable[None]]


class PlanningEndedError(Exception):
    """The job was cancelled, or deleted, while it was planned."""


class JobTasks:
    """A task for each of some jobs, in the order they were accepted, `MAX_TASKS` at once; what cannot go on fails.

    Args:
        store: The database; its followers are told when a task has ended.
        fail: Stores that a job has failed.
    """

    def __init__(self, store: Store, fail: Callable[[StoredJob, JobFailedError], Awaitable[None]]) -> None:
        self._store = store
        self._fail = fail
        self._tasks: dict[str, asyncio.Task[None]] = {}

    def begin(self, job: StoredJob, work: Step) -> None:
        """Start a task with that work for the job, unless it has one, if there is room."""
        if job.id not in self._tasks and len(self._tasks) < MAX_TASKS:
            self._tasks[job.id] = asyncio.create_task(self._run(job, work))

    def cancel(self, *, but: Collection[str] = ()) -> None:
        """End every task but those of these jobs."""
        for job_id, task in self._tasks.items():
            if job_id not in but:
                task.cancel()

    async def _run(self, job: StoredJob, work: Step) -> None:
        """Run the work until it ends or meets a transient error, after which a later look starts it again."""
        try:
            await self._run_or_fail(job, work)
        except TRANSIENT as error:
            logger.warning("Job %s rests: %s", job.id, type(error).__name__)
            await asyncio.sleep(PAUSE_AFTER_FAILURE)
        except Exception:  # not even its failure could be noted: it is tried again
            logger.exception("Job %s rests", job.id)
            await asyncio.sleep(PAUSE_AFTER_FAILURE)
        finally:
            del self._tasks[job.id]
            self._store.changed(job.id)

    async def _run_or_fail(self, job: StoredJob, work: Step) -> None:
        try:
            await work(job)
        except TRANSIENT:
            raise
        except JobFailedError as error:
            await self._fail(job, error)
        except DamagedError as error:
            logger.error("Job %s: %s", job.id, error.message)
            await self._fail(job, JobFailedError(error.message))
        except Exception:  # a bug of ours
            logger.exception("Job %s failed", job.id)
            await self._fail(job, JobFailedError(UNFORESEEN))


class Scheduler:
    """The one scheduler of a service.

    Args:
        store: The database.
        settings: Of the service.
        kinds: Of jobs.
        connect: Gives what computes runs, when it is first needed and where it was lost.
        workers: Processes for what would hold up the event loop.
    """

    def __init__(
        self,
        *,
        store: Store,
        settings: Settings,
        kinds: Iterable[JobKind],
        connect: Callable[[], Awaitable[Executor]],
        workers: Workers,
    ) -> None:
        self._store = store
        self._kinds = {kind.name: kind for kind in kinds}
        self._connect = connect
        self._leadership = Leadership(store)
        self._retention = Retention(store, settings, self._leadership.write)
        self._task: asyncio.Task[None] | None = None
        self._closed = False
        self._executor: Executor | None = None
        self._running_jobs: dict[str, RunningJob] = {}
        self._chunks = Dispatch(store, workers, settings.run_timeout)
        self._planning = JobTasks(store, self._fail)
        self._stepping = JobTasks(store, self._fail)
        self._crash_count: Counter[str] = Counter()  # how often planning a job lost its processes
        self._send_counter = itertools.count(1)
        self._reported = -REPORT

    def start(self) -> None:
        """Start leading in the background."""
        self._task = asyncio.create_task(self._run())

    async def close(self) -> None:
        """Stop leading; unfinished jobs wait for another service or the next start."""
        self._closed = True
        if self._task is not None:
            self._task.cancel()
            with contextlib.suppress(asyncio.CancelledError):
                await self._task
        await self._chunks.close()

    async def _run(self) -> None:
        """Lead the jobs whenever this service is the leader."""
        while not self._closed:  # an error while leaving takes the place of a cancellation
            try:
                try:
                    await (
                        self._retention.now()
                    )  # before it leads: another leader may seem to hang by a clock that jumps
                    async with self._leadership.held():
                        with self._store.commits.following() as changes:
                            await self._lead(changes)
                except LeadershipLostError:
                    logger.warning("Another service leads the jobs now")
                finally:
                    await self._leave()
            except (SQLAlchemyError, OSError) as error:
                logger.warning("The jobs rest: %s", type(error).__name__)
            except Exception:  # whatever it was, jobs must not rest for ever
                logger.exception("Leading the jobs failed")
            await asyncio.sleep(PAUSE_AFTER_FAILURE)

    async def _lead(self, changes: Follower) -> None:
        while True:
            await self._leadership.confirm()
            changes.clear()
            try:
                await self._look()
                await self._send_chunks()
                await self._report()
                self._retention.begin_if_due()
            except SQLAlchemyError as error:  # what is computed meanwhile is not thrown away
                logger.warning("The jobs rest: %s", type(error).__name__)
                await asyncio.sleep(PAUSE_AFTER_FAILURE)
            except (ExecutorLostError, OSError, TimeoutError) as error:
                logger.warning("What computes jobs does not answer: %s", error)
                self._chunks.obstacle = NO_SCHEDULER
                await self._end_executor()
                await asyncio.sleep(PAUSE_AFTER_FAILURE)
            await changes.wait(JOB_POLL_INTERVAL)

    async def _look(self) -> None:
        """Start jobs that were accepted and end jobs that were cancelled, by this service or another."""
        unfinished = {job.id: job for job in await self._store.read(self._store.jobs.unfinished)}
        obstacle = self._chunks.obstacle if time.monotonic() > self._chunks.progressed + STALLED else None
        for job in unfinished.values():
            if job.state in ("queued", "running") and job.reason != obstacle:
                await self._leadership.write(self._store.jobs.explain, job.id, obstacle)
        for job_id in self._running_jobs.keys() - unfinished.keys():
            await self._stop(job_id)
        self._planning.cancel(but={job.id for job in unfinished.values() if job.state == "planning"})
        for job in unfinished.values():
            kind = self._kinds.get(job.kind)
            if kind is None:  # a newer version's
                continue
            if job.state == "planning":
                self._planning.begin(job, partial(self._plan, kind))
            elif kind.step is not None:
                self._stepping.begin(job, kind.step)
            elif job.id not in self._running_jobs:
                await self._begin(job, kind)
            elif job.state == "queued":  # it was cancelled and resumed between two looks
                await self._stop(job.id)
                await self._begin(job, kind)

    async def _stop(self, job_id: str) -> None:
        stopped = self._running_jobs.pop(job_id)
        if stopped.open_chunks and self._executor is not None:
            await self._executor.stop(stopped.group)

    async def _begin(self, job: StoredJob, kind: JobKind) -> None:
        """Begin to compute a job's runs."""
        if kind.keys is None and job.core_version != CORE_VERSION:
            await self._leadership.write(self._store.jobs.cancel, job.id)
            await self._leadership.write(self._store.jobs.delete, job.id)
            return
        if self._executor is None:
            self._executor = await self._connect()
        await self._leadership.write(self._store.jobs.start, job.id)
        order = kind.order(job) if kind.order else np.arange(job.total)
        waiting = await self._store.read(self._store.job_runs.waiting_positions, job.id)
        self._running_jobs[job.id] = RunningJob(job=job, kind=kind, order=order[np.isin(order, waiting)])

    async def _send_chunks(self) -> None:
        """Keep every process busy; the next chunk is of the job with the fewest open chunks.

        A job that has none need not wait until one of another comes back.
        """
        executor = self._executor
        if executor is None or not self._running_jobs:
            self._chunks.progressed = time.monotonic()
            return
        capacity = await executor.capacity()
        if not capacity:
            self._chunks.obstacle = NO_WORKERS
        elif self._chunks.obstacle == NO_WORKERS:
            self._chunks.obstacle = None
        max_chunks = CHUNKS_PER_PROCESS * max(1, capacity)
        looked_at: set[str] = set()
        while self._chunks.count < 2 * max_chunks:
            waiting = [each for each in self._running_jobs.values() if each.job.id not in looked_at]
            if not waiting:
                return
            running = min(waiting, key=lambda each: (each.open_chunks, each.last_send))
            if running.open_chunks and self._chunks.count >= max_chunks:
                return
            runs = await running.next_chunk(self._store, max_chunks)
            if runs:
                running.last_send = next(self._send_counter)
                self._chunks.send(executor, running, runs)
            else:
                looked_at.add(running.job.id)
                if not running.open_chunks and not running.to_resend:  # one may have come back meanwhile
                    await self._finish(running)

    async def _finish(self, running: RunningJob) -> None:
        """Set a job to done; where something waits after all, the next look begins it again."""
        job_id = running.job.id
        del self._running_jobs[job_id]
        if await self._leadership.write(self._store.jobs.finish, job_id) and running.kind.delete_when_done:
            job = await self._store.read(self._store.jobs.load, job_id)
            if job is not None and not job.failed:  # one with failures stays and says why
                await self._leadership.write(self._store.jobs.delete, job_id)

    async def _plan(self, kind: JobKind, job: StoredJob) -> None:
        """Plan a job; one that is cancelled meanwhile stays so."""
        if kind.plan is None:
            raise TypeError(f"Jobs of the kind {kind.name} are not planned")
        try:
            size = await kind.plan(job, partial(self._add_runs, job.id))
            await self._leadership.write(self._store.jobs.end_planning, job.id, **asdict(size))
        except PlanningEndedError:
            return
        except WorkerLostError as error:
            self._crash_count[job.id] += 1
            if self._crash_count[job.id] < MOST_CRASHES:
                raise
            del self._crash_count[job.id]  # resumed, it may be tried as often again
            raise JobFailedError(error.message) from error
        except (*TRANSIENT, DamagedError):
            raise
        except (ServiceError, RidelabError) as error:
            raise JobFailedError(error.message, problem_of(error)) from error

    async def _add_runs(self, job_id: str, runs: Sequence[JobRun]) -> None:
        if not await self._leadership.write(self._store.jobs.add_planned, job_id, runs):
            raise PlanningEndedError

    async def _fail(self, job: StoredJob, error: JobFailedError) -> None:
        values = {} if error.problem is None else {"progress": job.progress | {"problem": error.problem}}
        await self._leadership.write(self._store.jobs.fail, job, str(error), **values)

    async def _report(self) -> None:
        """Update the metrics of jobs and runs, every few seconds."""
        now = time.monotonic()
        if now - self._reported < REPORT:
            return
        self._reported = now
        counts = await self._store.read(self._store.jobs.counts)
        for kind, state in itertools.product(self._kinds.values(), STATES):
            if kind.gauges is not None:
                for gauge, count in zip(kind.gauges, counts.get((kind.name, state), (0, 0)), strict=True):
                    gauge.labels(state=state).set(count)

    async def _leave(self) -> None:
        """End everything except chunks that wait to be stored; the next leader reports the metrics."""
        self._retention.cancel()
        for kind in self._kinds.values():
            for gauge in kind.gauges or ():
                gauge.clear()
        self._reported = -REPORT
        self._planning.cancel()
        self._stepping.cancel()
        await self._end_executor()

    async def _end_executor(self) -> None:
        self._running_jobs.clear()
        await self._chunks.close(committing=False)
        if self._executor is not None:
            executor, self._executor = self._executor, None
            await executor.close()
