"""Chunks on their way: to the cluster, back, and into the database."""

import asyncio
import contextlib
import logging
from collections.abc import Callable, Coroutine, Mapping, Sequence
from typing import TYPE_CHECKING, Any

import orjson
from sqlalchemy.exc import SQLAlchemyError

from backend import metrics
from backend.errors import CHEAPER_RUN
from backend.jobs.chunk import Chunk, ChunkOutcome, ClusterLostError, ComputedRun, Trouble, WaitingRun
from backend.jobs.handout import HandOut
from backend.store import Store
from sim_core import __version__ as CORE_VERSION

if TYPE_CHECKING:
    from backend.jobs.cluster import Cluster

logger = logging.getLogger(__name__)

CHUNK_BUDGET = 2.0  # a chunk is cut short after this, where its runs take longer than those before [s]
PAUSE = 2.0  # after the database or the cluster failed [s]
REASONS: dict[Trouble, str] = {
    "lost": "The computation ended unexpectedly, twice",
    "timeout": f"The computation took longer than the limit and was ended; {CHEAPER_RUN}",
    "bug": "The computation failed with an unforeseen error; it is in the service's log",
}


class Chunks:
    """Those of one scheduler; its methods belong to the event loop.

    Args:
        store: The database.
        timeout: A chunk may take so long [s].
        came_back: Called when one was stored, or is handed out again.
    """

    def __init__(self, store: Store, timeout: float, came_back: Callable[[], None]) -> None:
        self._store = store
        self._timeout = timeout
        self._came_back = came_back
        self._computing: set[asyncio.Task[None]] = set()
        self._commits: set[asyncio.Task[None]] = set()

    @property
    def computing(self) -> int:
        """How many are on the cluster."""
        return len(self._computing)

    def begin(self, cluster: "Cluster", handed_out: HandOut, runs: list[WaitingRun]) -> None:
        """Have these runs computed and stored, or handed out again."""
        handed_out.on_their_way += 1
        self._hold(self._computing, self._compute(cluster, handed_out, runs))

    async def wait_for_commits(self) -> None:
        """Until everything that was computed is stored, however long the database is away."""
        if self._commits:
            await asyncio.wait(self._commits)

    async def wait(self, timeout: float) -> None:
        """Until all are back from the cluster, at most so long [s]."""
        if self._computing:
            await asyncio.wait(self._computing, timeout=timeout)

    async def drop(self) -> None:
        """Wait no longer for the cluster; what waits to be stored goes on waiting."""
        for task in self._computing:
            task.cancel()
        await asyncio.gather(*self._computing, return_exceptions=True)

    async def close(self) -> None:
        """End what waits to be stored, too."""
        for task in tuple(self._commits):
            task.cancel()
            with contextlib.suppress(asyncio.CancelledError):
                await task

    async def _compute(self, cluster: "Cluster", handed_out: HandOut, runs: list[WaitingRun]) -> None:
        """A chunk's way to the cluster and back."""
        chunk = Chunk(
            group=handed_out.group,
            core_version=CORE_VERSION,
            schema_version=handed_out.job.schema_version,
            base=handed_out.job.request["scenario"],
            runs=runs,
            budget=CHUNK_BUDGET,
            timeout=self._timeout,
        )
        try:
            outcome = await cluster.compute(chunk)
        except ClusterLostError as error:
            logger.warning("A chunk is handed out again: %s", error)
            handed_out.take_back(runs)
        else:
            stored = await self._settle(handed_out, runs, outcome)
            if stored is not None:
                self._hold(self._commits, self._commit(handed_out, *stored))
                return
        handed_out.on_their_way -= 1
        self._came_back()

    async def _settle(
        self, handed_out: HandOut, runs: list[WaitingRun], outcome: ChunkOutcome
    ) -> tuple[list[ComputedRun], dict[int, str]] | None:
        """What of a chunk to store: results, and the reasons of runs without one; the rest is handed out again.

        A chunk that could not be computed is halved until the run to blame is alone, and that one fails.
        """
        if outcome.computed is not None:
            uncacheable = {
                run.key: str(orjson.loads(run.summary)["reason"]) for run in outcome.computed if not run.cacheable
            }
            failures = {run.position: uncacheable[run.key] for run in runs if run.key in uncacheable}
            done = {run.key for run in outcome.computed}
            left = [run for run in runs if run.key not in done]
            handed_out.learn(len(runs) - len(left), sum(run.compute_ms for run in outcome.computed) / 1000)
            handed_out.take_back(left)
            return [run for run in outcome.computed if run.cacheable], failures
        logger.warning("A chunk of %d runs could not be computed: %s %s", len(runs), outcome.trouble, outcome.detail)
        if outcome.trouble not in REASONS:  # not the chunk's fault
            handed_out.take_back(runs)
            await asyncio.sleep(PAUSE)
            return None
        if handed_out.halve(runs) or (outcome.trouble == "lost" and handed_out.try_again(runs)):
            return None
        return [], dict.fromkeys((run.position for run in runs), REASONS[outcome.trouble])

    async def _commit(self, handed_out: HandOut, computed: Sequence[ComputedRun], failures: Mapping[int, str]) -> None:
        """Store what a chunk gave, however long the database is away: it was computed and is not thrown away."""
        save = self._store.job_runs.save
        while True:
            try:
                await self._store.write(save, handed_out.job.id, computed, CORE_VERSION, failures)
            except SQLAlchemyError as error:
                logger.warning("A chunk waits for the database: %s", type(error).__name__)
                await asyncio.sleep(PAUSE)
            else:
                break
        for run in computed:
            metrics.count_run("batch", run.status, orjson.loads(run.summary))
        for _ in failures:
            metrics.count_run("batch", "failed", {})
        handed_out.on_their_way -= 1
        self._came_back()

    def _hold(self, tasks: set[asyncio.Task[None]], work: Coroutine[Any, Any, None]) -> None:
        """Run it beside; the set keeps it alive."""
        task = asyncio.create_task(work)
        tasks.add(task)
        task.add_done_callback(tasks.discard)
