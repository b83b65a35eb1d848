"""Summaries of batches: rows by point and strategy, which a worker summarises; equal requests share one computation.

Its result is cached.
"""

import asyncio
import time
from collections import Counter
from collections.abc import AsyncIterator, Awaitable, Callable, Mapping, Sequence
from dataclasses import dataclass, field
from functools import partial
from typing import Any

import numpy as np
import orjson
from cachetools import LRUCache

from backend.batches import robustness, summary
from backend.batches.models import BatchSummary
from backend.compute.shared_computations import SharedComputations
from backend.custom_controllers import registry as custom_controllers
from backend.errors import InvalidError
from backend.gate import Gate
from backend.job_run import JobRow
from backend.json_types import JsonObject
from backend.roads.service import MeasuredRoads
from backend.scenario_at import scenario_at
from backend.store import StoredJob
from backend.store.job import FINAL
from sim_core import __version__ as CORE_VERSION
from sim_core.catalogue import METRICS
from sim_core.scenario.measured import MeasuredRoad

POINTS_A_CALL = 100  # whose stability one task of a worker computes; with unequal dampers one of LV takes some 13 ms


async def summarised(
    batch: StoredJob,
    pages: AsyncIterator[list[JobRow]],
    call: Callable[..., Awaitable[Any]],
    figures: Sequence[str],
    baseline: str,
    roads: Mapping[str, MeasuredRoad],
) -> tuple[BatchSummary, bool]:
    """Return what has finished, read as a whole, and whether something of it failed for a reason that may pass.

    `roads` are the measured ones that the batch names.
    """
    names, fields = batch.request["strategies"], batch.request["fields"]
    gathered = _Gathered(names, batch.total // len(names), figures)
    async for rows in pages:
        await asyncio.to_thread(gathered.add, rows)
    origin, study = (batch.request["scenario"], batch.schema_version), gathered.study
    ok = study.status == "ok"
    ran, judged = np.flatnonzero(ok.any(axis=1)).tolist(), gathered.unchanged()
    columns = [names.index(name) for name in judged]
    for first in range(0, len(ran), POINTS_A_CALL):
        some = ran[first : first + POINTS_A_CALL]
        texts = [gathered.changes[point] for point in some]
        study.damping[np.ix_(some, columns)] = await call(summary.dampings, *origin, texts, judged)
    study.damping[~ok] = np.nan
    summaries, study.nominal_damping, may_pass = await call(summary.nominal, *origin, judged, roads)
    study.nominal = {name: {key: METRICS[key].of(each) for key in figures} for name, each in summaries.items()}
    changes, scenario = [orjson.loads(text) for text in gathered.changes], scenario_at(origin[0], {}, origin[1])
    study.fields = {name: [change.get(name) for change in changes] for name in fields}
    study.read = {name: robustness.fields_read(name, fields, scenario) for name in names}
    answer = BatchSummary(
        batch=batch.id,
        state=batch.state,
        core_version=CORE_VERSION,
        points=len(study.status),
        baseline=baseline,
        quantiles=summary.QUANTILES,
        units={key: METRICS[key].unit for key in figures},
        strategies=await call(summary.summarise, study, baseline),
    )
    return answer, may_pass


class _Gathered:
    """A batch's rows, taken in page by page; a point's strategies lie side by side."""

    def __init__(self, names: Sequence[str], points: int, figures: Sequence[str]) -> None:
        shape = points, len(names)
        self.study = summary.Study(
            strategies=names,
            status=np.full(shape, "waiting", dtype="U9"),
            reasons={name: Counter() for name in names},
            figures={key: np.full(shape, np.nan) for key in figures},
            damping=np.full(shape, np.nan),
        )
        self.changes: list[str] = []
        self._sources: dict[str, JsonObject | None] = {}

    def add(self, rows: Sequence[JobRow]) -> None:
        """Take a page in."""
        for row in rows:
            point, index = divmod(row.position, len(self.study.strategies))
            self.study.status[point, index] = row.status
            if not index:
                self.changes.append(row.changes)
            result = orjson.loads(row.summary) if row.summary is not None else {}
            if row.status == "failed":
                self.study.reasons[row.strategy][row.reason or result.get("reason") or "unknown"] += 1
            if row.status == "ok":
                self._sources[row.strategy] = result.get("source")
                for key, values in self.study.figures.items():
                    value = METRICS[key].of(result)
                    values[point, index] = np.nan if value is None else value

    def unchanged(self) -> list[str]:
        """Return the strategies whose controller is the one that was driven, not that of a file saved since."""
        return [name for name in self.study.strategies if self._sources.get(name) == custom_controllers.source(name)]


CACHED = 16  # a page that is opened again asks for the same
# A summary of a batch that goes on is answered again for so many times as long as it took, or a page that is open would
# keep a process from the batch.
REUSE = 10
COST = 0.005  # of one run, its loop's stability included [s of one core]


@dataclass(frozen=True, slots=True, kw_only=True)
class CachedSummary:
    """A summary, and what it was computed from.

    Attributes:
        answer: What was answered.
        ended: How many runs had succeeded, and how many had failed.
        reusable_until: On the clock of the event loop, where runs have ended since [s].
    """

    answer: BatchSummary
    ended: tuple[int, int]
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
    _in_progress: SharedComputations[tuple[str | int, ...], tuple[BatchSummary, bool]] = field(
        init=False, default_factory=SharedComputations
    )

    async def get(self, job: StoredJob, figures: Sequence[str], baseline: str | None, client: str) -> BatchSummary:
        """Return the summary of the batch's finished rows.

        Raises:
            InvalidError: It does not have that baseline.
            TemporaryError: Too much is being read.
        """
        names = job.request["strategies"]
        usual = robustness.BASELINE if robustness.BASELINE in names else names[0]
        against = usual if baseline is None else baseline
        if against not in names:
            raise InvalidError(f"The batch has no such strategy; it has {', '.join(names)}", parameter="baseline")
        key, ended = (job.id, against, *figures), (job.done, job.failed)
        clock = asyncio.get_running_loop().time
        cached = self._cached.get(key)
        goes_on = job.state not in FINAL
        if cached is not None and (cached.ended == ended or (goes_on and clock() < cached.reusable_until)):
            return cached.answer.model_copy(update={"state": job.state})
        begin = time.perf_counter()
        cost = COST * sum(ended)
        rows, call = self.rows(job.id) if job.is_planned else _no_rows(), partial(self.call, client, cost)
        measured = await self.roads.named(job.road_ids)
        with self.gate.computing(client, cost):
            answer, may_pass = await self._in_progress.join(
                (*key, *ended), partial(summarised, job, rows, call, figures, against, measured)
            )
        until = clock() + REUSE * (time.perf_counter() - begin)
        if job.is_planned and not may_pass:
            self._cached[key] = CachedSummary(answer=answer, ended=ended, reusable_until=until)
        return answer


async def _no_rows() -> AsyncIterator[list[JobRow]]:
    """Give the rows of a batch that was not planned when it was loaded; some may be there now."""
    none: tuple[list[JobRow], ...] = ()
    for rows in none:
        yield rows
