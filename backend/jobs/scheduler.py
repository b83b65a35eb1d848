"""Drives every job: runs of sweeps go to the cluster in chunks, jobs of other kinds go step by step.

The database is the truth. This keeps no state that a crash could lose: what is unfinished is a query, and a chunk that
was on its way when a process died is waiting still. Of several services on one database one drives (`leadership`).
"""

import asyncio
import contextlib
import itertools
import logging
import time
from collections.abc import Mapping
from functools import partial
from typing import TYPE_CHECKING, get_args

from sqlalchemy.exc import SQLAlchemyError

from backend import metrics
from backend.compute.workers import Workers
from backend.db.commits import Follower
from backend.jobs.chunk_cutter import RunningJob
from backend.jobs.chunk_messages import ClusterLostError
from backend.jobs.dispatch import Dispatch
from backend.jobs.job_drivers import JobDrivers, Stepper
from backend.jobs.leadership import Leadership, LeadershipLostError
from backend.jobs.retention import Retention
from backend.jobs.sweep.plan import rekeyed
from backend.settings import Settings
from backend.store import Store, StoredJob
from backend.store.job import UNFINISHED, Kind, State
from sim_core import __version__ as CORE_VERSION

if TYPE_CHECKING:
    from backend.jobs.cluster import Cluster

logger = logging.getLogger(__name__)

CHUNKS_PER_PROCESS = 2  # one is computed, one waits
JOB_POLL_INTERVAL = 1.0  # between two looks at what other services accepted or cancelled [s]
PAUSE_AFTER_FAILURE = 2.0  # after the database or the cluster failed [s]
PARTING = 10.0  # chunks being computed when the lead is lost may take so long to come back [s]
REKEYED_AT_ONCE = 500  # runs given new keys in one transaction
REPORT = 5.0  # between two updates of the metrics [s]
STATES: tuple[State, ...] = get_args(State)


class Scheduler:
    """The one scheduler of a service.

    Args:
        store: The database.
        settings: Of the service.
        background: Processes for what would hold up the event loop.
        steppers: By kind, of the kinds that are not computed run by run.
    """

    def __init__(
        self, *, store: Store, settings: Settings, background: Workers, steppers: Mapping[Kind, Stepper]
    ) -> None:
        self._store = store
        self._settings = settings
        self._background = background
        self._leadership = Leadership(store)
        self._retention = Retention(store, settings, self._leadership.write)
        self._task: asyncio.Task[None] | None = None
        self._closed = False
        self._cluster: Cluster | None = None
        self._running_jobs: dict[str, RunningJob] = {}
        self._rekeyed: set[str] = set()  # jobs of another core version whose waiting runs have this one's keys
        self._chunks = Dispatch(store, settings.run_timeout)
        self._job_tasks = JobDrivers(store, steppers, self._chunks.returned)
        self._send_counter = itertools.count(1)
        self._reported = -REPORT

    def start(self) -> None:
        """Start driving in the background."""
        self._task = asyncio.create_task(self._run())

    async def close(self) -> None:
        """Stop driving; unfinished jobs wait for another service or the next start."""
        self._closed = True
        if self._task is not None:
            self._task.cancel()
            with contextlib.suppress(asyncio.CancelledError):
                await self._task
        await self._chunks.close()

    async def _run(self) -> None:
        """Drive the jobs whenever this service is the leader."""
        while not self._closed:  # an error while leaving takes the place of a cancellation
            try:
                try:
                    async with self._leadership.held():
                        await self._chunks.wait_until_stored(PARTING)  # what was computed before the lead was lost
                        with self._store.commits.following() as changes:
                            await self._lead(changes)
                except LeadershipLostError:
                    logger.warning("Another service drives the jobs now")
                    await self._chunks.wait_until_computed(PARTING)
                finally:
                    await self._leave()
            except (SQLAlchemyError, OSError) as error:
                logger.warning("The jobs rest: %s", type(error).__name__)
            except Exception:  # whatever it was, jobs must not rest for ever
                logger.exception("Driving the jobs failed")
            await asyncio.sleep(PAUSE_AFTER_FAILURE)

    async def _lead(self, changes: Follower) -> None:
        while True:
            await self._leadership.confirm()
            changes.clear()
            self._chunks.returned.clear()
            try:
                await self._look()
                await self._send_chunks()
                await self._report()
                self._retention.begin_if_due()
            except SQLAlchemyError as error:  # what the cluster computes meanwhile is not thrown away
                logger.warning("The jobs rest: %s", type(error).__name__)
                await asyncio.sleep(PAUSE_AFTER_FAILURE)
            except (ClusterLostError, OSError, TimeoutError) as error:
                logger.warning("The Dask scheduler does not answer: %s", error)
                await self._end_cluster()
                await asyncio.sleep(PAUSE_AFTER_FAILURE)
            await self._rest(changes)

    async def _rest(self, changes: Follower) -> None:
        """Wait until a chunk comes back, a job changes, or the next look is due."""
        waits = [asyncio.create_task(wait) for wait in (changes.wait(JOB_POLL_INTERVAL), self._chunks.returned.wait())]
        try:
            await asyncio.wait(waits, return_when=asyncio.FIRST_COMPLETED)
        finally:
            for wait in waits:
                wait.cancel()

    async def _look(self) -> None:
        """Start jobs that were accepted and end jobs that were cancelled, by this service or another."""
        unfinished = {job.id: job for job in await self._store.read(self._store.jobs.unfinished)}
        if self._cluster is not None and not self._cluster.connected:
            logger.warning("The Dask scheduler is gone; its chunks are sent again")
            await self._end_cluster()
        self._rekeyed &= unfinished.keys()
        for job_id in self._running_jobs.keys() - unfinished.keys():
            await self._end_sweep(job_id)
        for job in unfinished.values():
            if self._job_tasks.drives(job.kind):
                self._job_tasks.drive(job)
            elif job.kind == "reproduction" and job.core_version != CORE_VERSION:  # its page asks for other rows now
                await self._leadership.write(self._store.jobs.cancel, job.id)
                await self._leadership.write(self._store.jobs.delete, job.id)
            elif job.id not in self._running_jobs:
                await self._begin(job)
            elif job.state == "queued":  # it was cancelled and resumed between two looks
                await self._end_sweep(job.id)
                await self._begin(job)

    async def _end_sweep(self, job_id: str) -> None:
        self._rekeyed.discard(job_id)  # what was cancelled meanwhile has its old keys
        stopped = self._running_jobs.pop(job_id)
        if stopped.open_chunks and self._cluster is not None:
            await self._cluster.stop(stopped.group)

    async def _begin(self, job: StoredJob) -> None:
        if job.core_version != CORE_VERSION and job.id not in self._rekeyed:
            self._job_tasks.begin(job.id, partial(self._rekey, job))
            return
        if self._cluster is None:
            from backend.jobs.cluster import Cluster  # Dask takes half a second to import: not before there is a job

            self._cluster = Cluster(self._settings)
            await self._cluster.start()
        await self._leadership.write(self._store.jobs.start, job.id)
        self._running_jobs[job.id] = RunningJob(job=job)

    async def _send_chunks(self) -> None:
        """Keep every process busy; the next chunk is of the job with the fewest open chunks.

        A job that has none need not wait until one of another comes back.
        """
        cluster = self._cluster
        if cluster is None or not self._running_jobs:
            return
        max_chunks = CHUNKS_PER_PROCESS * max(1, await cluster.slots())
        looked_at: set[str] = set()
        while self._chunks.count < 2 * max_chunks and cluster.connected:
            waiting = [each for each in self._running_jobs.values() if each.job.id not in looked_at]
            if not waiting:
                return
            running = min(waiting, key=lambda each: (each.open_chunks, each.last_send))
            if running.open_chunks and self._chunks.count >= max_chunks:
                return
            runs = await running.next_chunk(self._store, max_chunks)
            if runs:
                running.last_send = next(self._send_counter)
                self._chunks.send(cluster, running, runs)
            else:
                looked_at.add(running.job.id)
                if not running.open_chunks and not running.returned:  # one may have come back meanwhile
                    await self._finish(running)

    async def _finish(self, running: RunningJob) -> None:
        job_id = running.job.id
        if await self._leadership.write(self._store.jobs.finish, job_id):
            self._running_jobs.pop(job_id, None)
            if running.job.kind == "reproduction":
                await self._forget(job_id)
        else:  # something waits after all: from the start
            running.position, running.exhausted = -1, False

    async def _forget(self, job_id: str) -> None:
        """Delete a reproduction that is done: its rows are stored results. One with failures stays and says why."""
        job = await self._store.read(self._store.jobs.load, job_id)
        if job is not None and not job.failed:
            await self._leadership.write(self._store.jobs.delete, job_id)

    async def _rekey(self, job: StoredJob) -> None:
        """Give the runs that another core version left uncomputed the keys of this one, which computes them."""
        logger.warning("Job %s goes on with core %s", job.id, CORE_VERSION)
        last: int | None = -1
        while last is not None:
            last, runs = await self._leadership.write(self._store.job_runs.waiting, job.id, last, REKEYED_AT_ONCE)
            if runs:
                keys = await self._background.call(rekeyed, job.request["scenario"], job.schema_version, runs)
                await self._leadership.write(self._store.job_runs.rekey, job.id, keys)
        self._rekeyed.add(job.id)

    async def _report(self) -> None:
        """Update the metrics of jobs and runs, every few seconds."""
        now = time.monotonic()
        if now - self._reported < REPORT:
            return
        self._reported = now
        counts = await self._store.read(self._store.jobs.counts)
        for state in STATES:
            sweeps, runs = counts.get(("sweep", state), (0, 0))
            metrics.BATCHES.labels(state=state).set(sweeps)
            if state in UNFINISHED:
                metrics.BATCH_QUEUE.labels(state=state).set(runs)

    async def _leave(self) -> None:
        """End everything except chunks that wait to be stored; the next leader reports the metrics."""
        self._retention.cancel()
        self._rekeyed.clear()
        metrics.BATCHES.clear()
        metrics.BATCH_QUEUE.clear()
        self._reported = -REPORT
        self._job_tasks.cancel()
        await self._end_cluster()

    async def _end_cluster(self) -> None:
        self._running_jobs.clear()
        await self._chunks.stop_computing()
        if self._cluster is not None:
            cluster, self._cluster = self._cluster, None
            await cluster.close()
