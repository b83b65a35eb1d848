"""Summaries of batches: equal requests share one computation, and its result is cached."""

import asyncio
import time
from collections.abc import AsyncIterator, Awaitable, Callable, Sequence
from dataclasses import dataclass, field
from functools import partial
from typing import Any

from cachetools import LRUCache

from backend.batches import batch_summary, robustness
from backend.batches.models import BatchSummary
from backend.compute.shared_computations import SharedComputations
from backend.errors import InvalidError
from backend.gate import Gate
from backend.job_run import JobRow
from backend.roads.service import MeasuredRoads
from backend.store import StoredJob
from backend.store.job import FINAL

CACHED = 16  # a page that is opened again asks for the same
# A summary of a batch that goes on is answered again for so many times as long as it took, or a page that is open would
# keep a process from the batch (test_a_summary_of_a_batch_that_goes_on_is_answered_again_for_a_while).
REUSE = 10
COST = 0.005  # of one run, its loop's stability included [s of one core]


@dataclass(frozen=True, slots=True, kw_only=True)
class CachedSummary:
    """A summary, and what it was computed from.

    Attributes:
        answer: What was answered.
        ended: How many runs had come to an end.
        reusable_until: On the clock of the event loop, where runs have ended since [s].
    """

    answer: BatchSummary
    ended: int
    reusable_until: float


@dataclass(eq=False, kw_only=True)
class Summaries:
    """Computes and caches summaries.

    Attributes:
        rows: A batch's rows, page by page, by its id.
        call: Runs a function of that client and that cost [s of one core] in a process.
        gate: What is accepted at once.
        roads: The measured roads.
    """

    rows: Callable[[str], AsyncIterator[list[JobRow]]]
    call: Callable[..., Awaitable[Any]]
    gate: Gate
    roads: MeasuredRoads
    _cached: LRUCache[tuple[str, ...], CachedSummary] = field(init=False, default_factory=lambda: LRUCache(CACHED))
    _in_progress: SharedComputations[tuple[str | int, ...], BatchSummary] = field(
        init=False, default_factory=SharedComputations
    )

    async def get(self, job: StoredJob, figures: Sequence[str], baseline: str | None, client: str) -> BatchSummary:
        """The summary of the batch's finished rows.

        Raises:
            InvalidError: It does not have that baseline.
            TemporaryError: Too much is being read.
        """
        names = job.request["strategies"]
        usual = robustness.BASELINE if robustness.BASELINE in names else names[0]
        against = usual if baseline is None else baseline
        if against not in names:
            raise InvalidError(f"The batch has no such strategy; it has {', '.join(names)}", parameter="baseline")
        key, ended = (job.id, against, *figures), job.done + job.failed
        clock = asyncio.get_running_loop().time
        cached = self._cached.get(key)
        goes_on = job.state not in FINAL
        if cached is not None and (cached.ended == ended or (goes_on and clock() < cached.reusable_until)):
            return cached.answer.model_copy(update={"state": job.state})
        begin = time.perf_counter()
        cost = COST * ended
        rows, call = self.rows(job.id), partial(self.call, client, cost)
        measured = await self.roads.named(job.road_ids)
        with self.gate.hold(client, requests=1, background_cost=cost):
            answer = await self._in_progress.join(
                (*key, ended), partial(batch_summary.summarised, job, rows, call, figures, against, measured)
            )
        until = clock() + REUSE * (time.perf_counter() - begin)
        self._cached[key] = CachedSummary(answer=answer, ended=ended, reusable_until=until)
        return answer
