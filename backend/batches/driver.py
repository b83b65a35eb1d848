"""Drives the batches: hands what waits to the cluster in chunks of about a second, and commits what comes back.

The database is the truth. This keeps no state that a crash could lose: what is unfinished is a query, and a chunk that
was on its way when a process died is waiting still. Of several services on one database one drives (`leadership`).
"""

import asyncio
import contextlib
import logging
import math
import time
from collections import Counter, deque
from collections.abc import Mapping, Sequence
from dataclasses import dataclass, field
from typing import TYPE_CHECKING, get_args

import orjson
from sqlalchemy.exc import SQLAlchemyError

from backend import metrics
from backend.batches.leadership import Leadership, LeadershipLostError
from backend.batches.plan import rekeyed
from backend.chunk import Answer, Chunk, ClusterLostError, ComputedRun, Trouble, WaitingRun
from backend.errors import CHEAPER_RUN
from backend.settings import Settings
from backend.store import Store, StoredBatch
from backend.store.batches import UNFINISHED, State
from sim_core import __version__ as CORE_VERSION

if TYPE_CHECKING:
    from backend.batches.cluster import Cluster

logger = logging.getLogger(__name__)

CHUNK_SECONDS = 1.0  # a chunk is cut to take about so long
SHORTEST_CHUNK = 0.1  # and no shorter where the rest of a batch is shared out [s]
CHUNK_BUDGET = 2.0  # and is cut short after this, where its runs take longer than those before [s]
FIRST_CHUNK = 8  # runs at most, while it is not known how long one takes
FIRST_COST = 2.0  # their estimated cost [s]
LONGEST_CHUNK = 1000  # runs
AHEAD = 2  # chunks handed out for each process: one runs, one lies ready
LOOK = 0.4  # between two looks at what other services accepted or cancelled [s]
PAUSE = 2.0  # after the database or the cluster failed [s]
PAGE = 500  # runs given new keys in one transaction
STRIKES = 3  # a run alone may lose its processes so often (two each time) before it fails
REPORT = 5.0  # between two updates of the metrics [s]
STATES: tuple[State, ...] = get_args(State)

REASONS: dict[Trouble, str] = {
    "lost": "The computation ended unexpectedly, twice",
    "timeout": f"The computation took longer than the limit and was ended; {CHEAPER_RUN}",
    "bug": "The computation failed with an unforeseen error; it is in the service's log",
}


@dataclass(slots=True, kw_only=True)
class Progress:
    """A batch being driven.

    Attributes:
        batch: As it was when driving it began.
        position: Runs up to this one are computed or on their way.
        returned: Chunks to hand out (again) before new ones are cut.
        on_their_way: How many chunks are with the cluster.
        pace: Seconds a run takes, by the chunks so far.
        strikes: How often a run alone lost its processes, by key.
    """

    batch: StoredBatch
    position: int = -1
    returned: list[list[WaitingRun]] = field(default_factory=list)
    on_their_way: int = 0
    pace: float | None = None
    strikes: Counter[str] = field(default_factory=Counter)

    def size(self, places: int) -> int:
        """Runs of the next chunk, where so many chunks can be under way: the rest is shared, so that none waits."""
        if self.pace is None:
            each = self.batch.estimated_cost / self.batch.total
            return min(FIRST_CHUNK, max(1, int(FIRST_COST / max(each, 1e-3))))
        share = max(math.ceil((self.batch.total - 1 - self.position) / places), round(SHORTEST_CHUNK / self.pace))
        return min(LONGEST_CHUNK, max(1, min(round(CHUNK_SECONDS / self.pace), share)))

    def note(self, runs: int, seconds: float) -> None:
        """Learn from a computed chunk."""
        if runs:
            pace = max(seconds, 1e-4) / runs
            self.pace = pace if self.pace is None else 0.7 * self.pace + 0.3 * pace


class Driver:
    """One for each service; its methods belong to the event loop."""

    def __init__(self, *, store: Store, settings: Settings) -> None:
        self._store = store
        self._settings = settings
        self._wake = asyncio.Event()
        self._task: asyncio.Task[None] | None = None
        self._driven: dict[str, Progress] = {}
        self._chunks: set[asyncio.Task[None]] = set()
        self._reported = -REPORT
        self.leads = False
        self.ended = asyncio.Event()  # set when the next batch is done, and another one takes its place

    def start(self) -> None:
        """Begin, in the background."""
        self._task = asyncio.create_task(self._run())

    def wake(self) -> None:
        """A batch was accepted or cancelled: look now."""
        self._wake.set()

    async def close(self) -> None:
        """Stop driving; what is unfinished waits for the next service or start."""
        if self._task is not None:
            self._task.cancel()
            with contextlib.suppress(asyncio.CancelledError):
                await self._task

    async def _run(self) -> None:
        """Be the one who drives, for as long as possible, again and again."""
        while True:
            try:
                async with Leadership(self._store).held() as leadership:
                    self.leads = True
                    await self._lead(leadership)
            except LeadershipLostError:
                logger.warning("Another service drives the batches now")
            except (SQLAlchemyError, OSError) as error:
                logger.warning("The batches rest: %s", type(error).__name__)
            except Exception:  # whatever it was, batches must not rest for ever
                logger.exception("Driving the batches failed")
            finally:
                self.leads = False
            await asyncio.sleep(PAUSE)

    async def _lead(self, leadership: Leadership) -> None:
        while True:
            await leadership.confirm()
            if await self._store.read(self._store.batches.unfinished):
                await self._with_cluster(leadership)
            await self._report()
            await self._rest()

    async def _with_cluster(self, leadership: Leadership) -> None:
        """Drive until the cluster or the lock is lost; the cluster stays warm while there is nothing to do."""
        from backend.batches.cluster import Cluster  # Dask takes half a second to import: not before there is a batch

        cluster = Cluster(self._settings)
        try:
            await cluster.start()
            while cluster.connected:
                await leadership.confirm()
                try:
                    await self._look(cluster)
                    await self._hand_out(cluster)
                    await self._report()
                except SQLAlchemyError as error:  # what the cluster computes meanwhile is not thrown away
                    logger.warning("The batches rest: %s", type(error).__name__)
                    await asyncio.sleep(PAUSE)
                await self._rest()
            logger.warning("The Dask scheduler is gone; its chunks are handed out again")
        except (ClusterLostError, OSError, TimeoutError) as error:
            logger.warning("The Dask scheduler does not answer: %s", error)
            await asyncio.sleep(PAUSE)
        finally:
            for chunk in self._chunks:
                chunk.cancel()
            await asyncio.gather(*self._chunks, return_exceptions=True)
            self._driven.clear()
            await cluster.close()

    async def _rest(self) -> None:
        """Until something happens: a chunk comes back, a batch is accepted or cancelled, or time for a look."""
        with contextlib.suppress(TimeoutError):
            async with asyncio.timeout(LOOK):  # asyncio.wait_for of Python 3.11 may swallow a cancellation
                await self._wake.wait()
        self._wake.clear()

    async def _look(self, cluster: "Cluster") -> None:
        """Begin what was accepted, end what was cancelled, here or by another service."""
        unfinished = {batch.id: batch for batch in await self._store.read(self._store.batches.unfinished)}
        for batch_id in self._driven.keys() - unfinished.keys():
            if self._driven.pop(batch_id).on_their_way:
                await cluster.stop(batch_id)
        for batch_id, batch in unfinished.items():
            if batch_id not in self._driven:
                if batch.core_version != CORE_VERSION:
                    await self._rekey(batch)
                await self._store.write(self._store.batches.start, batch_id)
                self._driven[batch_id] = Progress(batch=batch)

    async def _hand_out(self, cluster: "Cluster") -> None:
        """Keep every process busy, the batches taking turns; a batch without anything left is finished."""
        places = AHEAD * max(1, await cluster.slots())
        turns = deque(self._driven.values())
        while turns and len(self._chunks) < places and cluster.connected:
            progress = turns.popleft()
            runs = await self._next_chunk(progress, places)
            if runs is not None:
                self._send(cluster, progress, runs)
                turns.append(progress)
            elif not progress.on_their_way and not progress.returned:  # one may have come back meanwhile
                await self._finish(progress)

    async def _next_chunk(self, progress: Progress, places: int) -> list[WaitingRun] | None:
        """What to hand out next; None where everything is on its way or done."""
        if progress.returned:
            return progress.returned.pop(0)
        while True:
            batch_id, size = progress.batch.id, progress.size(places)
            last, runs = await self._store.write(self._store.batches.waiting, batch_id, progress.position, size)
            if last is None:
                return None
            progress.position = last
            if runs:
                return runs

    async def _finish(self, progress: Progress) -> None:
        if await self._store.write(self._store.batches.finish, progress.batch.id):
            self._driven.pop(progress.batch.id, None)
            told, self.ended = self.ended, asyncio.Event()
            told.set()
        else:
            progress.position = -1  # something waits after all: from the start

    def _send(self, cluster: "Cluster", progress: Progress, runs: list[WaitingRun]) -> None:
        progress.on_their_way += 1
        chunk = asyncio.create_task(self._chunk(cluster, progress, runs))
        self._chunks.add(chunk)
        chunk.add_done_callback(self._chunks.discard)

    async def _chunk(self, cluster: "Cluster", progress: Progress, runs: list[WaitingRun]) -> None:
        """A chunk's way to the cluster and into the database."""
        chunk = Chunk(
            batch_id=progress.batch.id,
            core_version=CORE_VERSION,
            schema_version=progress.batch.schema_version,
            base=progress.batch.scenario,
            runs=runs,
            budget=CHUNK_BUDGET,
            timeout=self._settings.run_timeout,
        )
        try:
            answer = await cluster.compute(chunk)
            if answer.computed is not None:
                passing = {run.key: _reason(run) for run in answer.computed if not run.lasting}
                failures = {run.position: passing[run.key] for run in runs if run.key in passing}
                await self._commit(progress, [run for run in answer.computed if run.lasting], failures)
                done = {run.key for run in answer.computed}
                left = [run for run in runs if run.key not in done]
                progress.note(len(runs) - len(left), sum(run.compute_ms for run in answer.computed) / 1000)
                if left:
                    progress.returned.append(left)
            else:
                await self._cope(progress, runs, answer)
        except ClusterLostError as error:
            logger.warning("A chunk is handed out again: %s", error)
            progress.returned.append(runs)
            await asyncio.sleep(LOOK)
        finally:
            progress.on_their_way -= 1
            self._wake.set()

    async def _cope(self, progress: Progress, runs: list[WaitingRun], answer: Answer) -> None:
        """A chunk that could not be computed is halved until the run to blame is alone, and that one fails."""
        logger.warning("A chunk of %d runs could not be computed: %s %s", len(runs), answer.trouble, answer.detail)
        if answer.trouble not in REASONS:  # not the chunk's fault
            progress.returned.append(runs)
            await asyncio.sleep(PAUSE)
            return
        keys = list(dict.fromkeys(run.key for run in runs))
        if len(keys) > 1:
            first = set(keys[: len(keys) // 2])
            progress.returned.append([run for run in runs if run.key in first])
            progress.returned.append([run for run in runs if run.key not in first])
            return
        progress.strikes[keys[0]] += 1
        if answer.trouble == "lost" and progress.strikes[keys[0]] < STRIKES:
            progress.returned.append(runs)
            return
        await self._commit(progress, [], dict.fromkeys((run.position for run in runs), REASONS[answer.trouble]))

    async def _commit(self, progress: Progress, computed: Sequence[ComputedRun], failures: Mapping[int, str]) -> None:
        """Store what a chunk gave, however long the database is away: it was computed and is not thrown away."""
        while True:
            try:
                await self._store.write(self._store.batches.save, progress.batch.id, computed, CORE_VERSION, failures)
            except SQLAlchemyError as error:
                logger.warning("A chunk waits for the database: %s", type(error).__name__)
                await asyncio.sleep(PAUSE)
            else:
                break
        for run in computed:
            metrics.count_run("batch", run.status, orjson.loads(run.summary))
        for _ in failures:
            metrics.count_run("batch", "failed", {})

    async def _rekey(self, batch: StoredBatch) -> None:
        """Another core version accepted the batch: what it left uncomputed is computed by this one, under new keys."""
        logger.warning("Batch %s goes on with core %s", batch.id, CORE_VERSION)
        position = -1
        while True:
            last, runs = await self._store.write(self._store.batches.waiting, batch.id, position, PAGE)
            if last is None:
                return
            position = last
            keys = await asyncio.to_thread(rekeyed, batch.scenario, batch.schema_version, runs)
            await self._store.write(self._store.batches.rekey, batch.id, keys)

    async def _report(self) -> None:
        """Tell the metrics how many batches and runs there are, every few seconds."""
        now = time.monotonic()
        if now - self._reported < REPORT:
            return
        self._reported = now
        counts = await self._store.read(self._store.batches.counts)
        for state in STATES:
            batches, runs = counts.get(state, (0, 0))
            metrics.BATCHES.labels(state=state).set(batches)
            if state in UNFINISHED:
                metrics.BATCH_QUEUE.labels(state=state).set(runs)


def _reason(run: ComputedRun) -> str:
    return str(orjson.loads(run.summary)["reason"])
