"""A chunk's way: to the cluster, back, and into the database."""

import asyncio
import logging
from collections.abc import Coroutine, Mapping, Sequence
from typing import TYPE_CHECKING, Any

import orjson
from sqlalchemy.exc import DataError, IntegrityError, ProgrammingError, SQLAlchemyError

from backend import metrics
from backend.errors import CHEAPER_RUN
from backend.jobs.chunk import Chunk, ChunkOutcome, ClusterLostError, ComputedRun, Trouble, WaitingRun
from backend.jobs.handout import HandOut
from backend.store import Store, StoredJob
from backend.store.roads import PROFILE
from sim_core import __version__ as CORE_VERSION
from sim_core.scenario.measured import MeasuredRoad

if TYPE_CHECKING:
    from backend.jobs.cluster import Cluster

logger = logging.getLogger(__name__)

CHUNK_BUDGET = 2.0  # a chunk is cut short after this, where its runs take longer than those before [s]
PAUSE = 2.0  # after the database or the cluster failed [s]
PERMANENT = (IntegrityError, DataError, ProgrammingError)  # what the database will never take
REASONS: dict[Trouble, str] = {
    "lost": "The computation ended unexpectedly, twice",
    "timeout": f"The computation took longer than the limit and was ended; {CHEAPER_RUN}",
    "bug": "The computation failed with an unforeseen error; it is in the service's log",
}


class Chunks:
    """Chunks under way; its methods belong to the event loop.

    Args:
        store: Of the service.
        timeout: A whole chunk may take so long [s].
    """

    def __init__(self, store: Store, timeout: float) -> None:
        self._store = store
        self._timeout = timeout
        self._computing: set[asyncio.Task[None]] = set()
        self._committing: set[asyncio.Task[None]] = set()
        self.returned = asyncio.Event()  # one came back

    @property
    def count(self) -> int:
        """How many are being computed or wait to be stored."""
        return len(self._computing) + len(self._committing)

    def send(self, cluster: "Cluster", handed_out: HandOut, runs: list[WaitingRun]) -> None:
        """Have these runs computed and stored."""
        handed_out.under_way += 1
        _keep(self._computing, self._compute(cluster, handed_out, runs))

    async def wait_until_computed(self, seconds: float) -> None:
        """Until those under way are back, at most so long [s]; they then wait to be stored."""
        if self._computing:
            await asyncio.wait(self._computing, timeout=seconds)

    async def wait_until_stored(self, seconds: float) -> None:
        """Until what came back is stored, at most so long [s]."""
        if self._committing:
            await asyncio.wait(self._committing, timeout=seconds)

    async def stop_computing(self) -> None:
        """Call off what is being computed; what came back is still stored."""
        await _cancel(self._computing)

    async def close(self) -> None:
        """Call off everything."""
        await _cancel(self._computing)
        await _cancel(self._committing)

    async def _compute(self, cluster: "Cluster", handed_out: HandOut, runs: list[WaitingRun]) -> None:
        committing = False
        try:
            chunk = await self._chunk(handed_out, runs)
            if chunk is None:
                return
            outcome = await _outcome(cluster, chunk)
            if outcome.computed is not None:
                computed, failures = _split(handed_out, runs, outcome.computed)
            elif await self._hand_out_again(handed_out, runs, outcome):
                return
            else:
                computed, failures = [], dict.fromkeys((run.position for run in runs), _reason(outcome))
            _keep(self._committing, self._commit(handed_out, computed, failures))
            committing = True
        finally:
            if not committing:
                self._end(handed_out)

    async def _chunk(self, handed_out: HandOut, runs: list[WaitingRun]) -> Chunk | None:
        """The chunk with its roads; None where the database has failed: its runs are handed out again."""
        try:
            roads = await self._roads(handed_out.job, runs)
        except (SQLAlchemyError, OSError) as error:
            logger.warning("A chunk's roads could not be read: %s", type(error).__name__)
            handed_out.take_back(runs)
            await asyncio.sleep(PAUSE)  # the database may be back by then
            return None
        return Chunk(
            group=handed_out.group,
            core_version=CORE_VERSION,
            schema_version=handed_out.job.schema_version,
            base=handed_out.job.request["scenario"],
            runs=runs,
            roads=roads,
            budget=CHUNK_BUDGET,
            timeout=self._timeout,
        )

    async def _roads(self, job: StoredJob, runs: Sequence[WaitingRun]) -> dict[str, MeasuredRoad]:
        """The measured roads that these runs name."""
        if not job.road_ids and not any(PROFILE in run.changes for run in runs):
            return {}
        named = {orjson.loads(run.changes).get(f"road.{PROFILE}") for run in runs} | job.road_ids
        return await self._store.read(self._store.roads.load, [each for each in named if each is not None])

    async def _hand_out_again(self, handed_out: HandOut, runs: list[WaitingRun], outcome: ChunkOutcome) -> bool:
        """What could not be computed is halved until the run to blame is alone; False for that one."""
        logger.warning("A chunk of %d runs could not be computed: %s %s", len(runs), outcome.trouble, outcome.detail)
        if outcome.trouble not in REASONS:  # not the chunk's fault
            handed_out.take_back(runs)
            await asyncio.sleep(PAUSE)
            return True
        return handed_out.halve(runs) or (outcome.trouble == "lost" and handed_out.try_again(runs))

    async def _commit(self, handed_out: HandOut, computed: Sequence[ComputedRun], failures: Mapping[int, str]) -> None:
        """Store what a chunk gave, however long the database is away: it was computed and is not thrown away."""
        try:
            await self._save(handed_out.job.id, computed, failures)
        finally:
            self._end(handed_out)
        for run in computed:
            metrics.count_run("batch", run.status, orjson.loads(run.summary))
        for _ in failures:
            metrics.count_run("batch", "failed", {})

    async def _save(self, job_id: str, computed: Sequence[ComputedRun], failures: Mapping[int, str]) -> None:
        while True:
            try:
                await self._store.write(self._store.job_runs.save, job_id, computed, CORE_VERSION, failures)
            except PERMANENT as error:
                logger.exception("The database takes no results of job %s", job_id)
                reason = f"The result could not be stored: {type(error).__name__}; it is in the service's log"
                await self._store.write(self._store.jobs.give_up, job_id, reason)
                return
            except SQLAlchemyError as error:
                logger.warning("A chunk waits for the database: %s", type(error).__name__)
                await asyncio.sleep(PAUSE)
            else:
                return

    def _end(self, handed_out: HandOut) -> None:
        handed_out.under_way -= 1
        self.returned.set()


async def _outcome(cluster: "Cluster", chunk: Chunk) -> ChunkOutcome:
    """What became of it; a cluster that is there and gave nothing back lost the process that computed it."""
    try:
        return await cluster.compute(chunk)
    except ClusterLostError as error:
        return ChunkOutcome(trouble="lost" if cluster.connected else "busy", detail=str(error))
    except Exception:  # a bug of ours: this chunk's run fails and says so, the others go on
        logger.exception("A chunk could not be handed out")
        return ChunkOutcome(trouble="bug")


def _split(
    handed_out: HandOut, runs: Sequence[WaitingRun], computed: Sequence[ComputedRun]
) -> tuple[list[ComputedRun], dict[int, str]]:
    """The results to store, and the reasons of runs that have none; what was not begun is handed out again."""
    reasons = {run.key: str(orjson.loads(run.summary)["reason"]) for run in computed if not run.cacheable}
    done = {run.key for run in computed}
    left = [run for run in runs if run.key not in done]
    handed_out.learn(len(runs) - len(left), sum(run.compute_ms for run in computed) / 1000)
    handed_out.take_back(left)
    failures = {run.position: reasons[run.key] for run in runs if run.key in reasons}
    return [run for run in computed if run.cacheable], failures


def _reason(outcome: ChunkOutcome) -> str:
    return REASONS[outcome.trouble or "bug"]


def _keep(tasks: set[asyncio.Task[None]], work: Coroutine[Any, Any, None]) -> None:
    """Run it beside; the set keeps it alive."""
    task = asyncio.create_task(work)
    tasks.add(task)
    task.add_done_callback(tasks.discard)


async def _cancel(tasks: set[asyncio.Task[None]]) -> None:
    cancelled = tuple(tasks)
    for task in cancelled:
        task.cancel()
    await asyncio.gather(*cancelled, return_exceptions=True)
