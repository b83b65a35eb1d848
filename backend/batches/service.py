"""Batches: accepted whole or refused, then read while the scheduler has them computed."""

import asyncio
from collections.abc import AsyncIterator, Awaitable, Callable, Iterable, Sequence
from contextlib import ExitStack
from dataclasses import dataclass, replace
from functools import partial
from pathlib import Path
from typing import Any, TypeVar

from backend.batches import plan, rendering, table
from backend.batches.judged import JudgedRuns
from backend.batches.kind import SWEEP
from backend.batches.models import Batch, Batches, BatchItem, BatchRequirements, BatchSummary, Estimate
from backend.batches.plan import SweepBase
from backend.batches.points import Sweep, SweepError, check_at_once
from backend.batches.summaries import Summaries
from backend.batches.table import Page
from backend.compute.workers import Workers
from backend.errors import ConflictError, InvalidError
from backend.file_formats import FormatName
from backend.gate import Gate
from backend.http.spool import Spool, SpoolFile
from backend.job_run import JobRow
from backend.jobs.kind import AddRuns, JobSize
from backend.jobs.service import Jobs, request_hash
from backend.json_types import JsonObject
from backend.requirements import Requirement
from backend.roads.service import MeasuredRoads
from backend.runs.service import ordered
from backend.settings import Settings
from backend.store import Store, StoredJob
from backend.store.job import UNFINISHED, State
from backend.store.roads import measured_roads, swept_roads
from sim_core.scenario import Road, Scenario
from sim_core.scenario.measured import MeasuredRoad

ROWS_AT_ONCE = 250  # rows read in one transaction
PLANNED_AT_ONCE = 5000  # runs
PLAN_COST = 0.0002  # of one run [s of one core]
QUICK = 0.3  # what takes less delays no interactive run [s of one core]
T = TypeVar("T")


@dataclass(slots=True, kw_only=True)
class _Planned:
    """What is planned so far."""

    total: int = 0
    contradictory: int = 0
    cost: float = 0.0
    max_run_cost: float = 0.0


@dataclass(eq=False, kw_only=True)
class BatchService:
    """The service of batches.

    Attributes:
        store: The database.
        workers: Processes for interactive runs; they also do what is quick.
        batch_workers: Processes for longer planning and summaries, so that these delay no interactive run.
        gate: What is accepted at once.
        settings: Of the service.
        roads: The measured ones.
        spool: For long tables.
    """

    store: Store
    workers: Workers
    batch_workers: Workers
    gate: Gate
    settings: Settings
    roads: MeasuredRoads
    spool: Spool

    def __post_init__(self) -> None:
        self.jobs = Jobs(kind=SWEEP, store=self.store, gate=self.gate, settings=self.settings)
        self._summaries = Summaries(rows=self.rows, call=self._call, gate=self.gate, roads=self.roads)

    async def estimate(self, scenario: Scenario, strategies: Iterable[str], sweep: Sweep, client: str) -> Estimate:
        """Return the size and the estimated time of that batch, or the error that planning it would meet."""
        names = ordered(strategies)
        settled = await self._checked(scenario, names, sweep)
        with self.gate.computing(client, PLAN_COST * sweep.size * len(names)):
            base, roads = await self._base(settled, names, sweep, given_length=_has_length(scenario))
            planned = await self._planned(base, sweep, client)
        cost = plan.TRIAL_RUNS * len(names) * min(plan.TRIAL_LIMIT, planned.max_run_cost)
        with self.gate.computing(client, cost):
            seconds = await self._call(client, cost, plan.trial_time, base, sweep, roads)
        points = planned.total // len(names)
        if seconds is not None:
            seconds *= points / self.settings.batch_workers
            seconds *= 1 + await self._queued_cost(planned.cost) / planned.cost if planned.cost else 1
        return Estimate(
            points=points,
            total=planned.total,
            contradictory=planned.contradictory,
            estimated_cost=planned.cost,
            estimated_seconds=seconds,
        )

    async def create(
        self,
        scenario: Scenario,
        strategies: Iterable[str],
        sweep: Sweep,
        *,
        key: str | None = None,
        label: str | None = None,
        owner: str | None = None,
        parent_id: str | None = None,
        baseline: str | None = None,
        requirements: Sequence[Requirement] = (),
    ) -> StoredJob:
        """Accept a batch, which is planned later: when this returns, it is committed.

        Args:
            scenario: Whose fields the sweep changes.
            strategies: Ids.
            sweep: The points.
            key: The same key and request again give the same batch.
            label: A name for it.
            owner: The token's name.
            parent_id: The job that submits it.
            baseline: What the requirements' changes are against.
            requirements: What its runs are held to.

        Raises:
            ConflictError: The key had another request.
            InvalidError: Fields do not exist, or of few values one cannot be used.
            CostLimitError: It has too many runs.
            BusyError: Too much is waiting.
        """
        names = ordered(strategies)
        settled = await self._checked(scenario, names, sweep)
        sent, held = sweep.plain(), dict[str, Any]()
        if requirements:
            required = [each.model_dump(mode="json", exclude_none=True) for each in requirements]
            held = {"baseline": baseline, "requirements": required}
        hashed = ""
        if key is not None:
            hashed = request_hash({"scenario": settled.identity(), "strategies": names, "sweep": sent, **held})
        existing = await self.jobs.existing(key, hashed)
        if existing is not None:
            return existing
        await self.jobs.check_room()
        job = StoredJob(
            kind=SWEEP.name,
            state="planning",
            parent_id=parent_id,
            label=label,
            owner=owner,
            request={
                "scenario": settled.model_dump(mode="json"),
                "strategies": names,
                "fields": sweep.fields,
                "linked": sweep.linked or {},
                "shape": [len(values) for values in (sweep.grid or {}).values()],
                "given_length": _has_length(scenario),
                **held,
            },
            sweep=sent,
            request_hash=hashed,
        )
        return await self.jobs.accept(job, key)

    async def plan(self, job: StoredJob, add: AddRuns) -> JobSize:
        """Plan a batch that was accepted.

        Raises:
            InvalidError: Values cannot be used, or a road is not there.
            CostLimitError: It is over a limit.
            TemporaryError: Later.
        """
        whole = await self.jobs.get(job.id)
        request, sweep = whole.request, Sweep.model_validate(whole.sweep)
        scenario = Scenario.model_validate(whole.scenario)
        base, _ = await self._base(scenario, request["strategies"], sweep, given_length=request["given_length"])
        stored = replace(base, scenario=request["scenario"], schema_version=whole.schema_version)
        planned = await self._planned(stored, sweep, job.id, add)
        return JobSize(total=planned.total, failed=planned.contradictory, estimated_cost=planned.cost)

    async def answer(self, job: StoredJob) -> Batch:
        """Return the batch as it is answered."""
        position = (await self.jobs.positions(job))[job.id]
        return Batch.from_stored(job, position, resumable=await self._is_resumable(job))

    async def page(self, *, limit: int, cursor: str | None, state: State | None, label: str | None) -> Batches:
        """Return the newest batches, without their sweeps."""
        jobs, after = await self.jobs.page(limit=limit, cursor=cursor, state=state, label=label)
        positions = await self.jobs.positions(*jobs)
        return Batches(batches=[BatchItem.from_stored(job, positions[job.id]) for job in jobs], next=after)

    async def resume(self, job_id: str, owner: str | None) -> StoredJob:
        """Continue a batch: what was cancelled of it, or failed for a reason that may have passed.

        One that has not ended is returned unchanged.

        Raises:
            NotFoundError: There is none.
            ForbiddenError: It belongs to another token.
            ConflictError: Nothing of it is left to run.
        """
        job = await self.jobs.owned(job_id, owner)
        if job.state in UNFINISHED:
            return job
        if not await self._is_resumable(job):
            raise ConflictError("It is done: nothing is left to run.", kind="done")
        return await self.jobs.resume(job_id, progress={})

    async def sweep(self, job_id: str) -> JsonObject:
        """Return the batch's sweep as it was sent.

        Raises:
            NotFoundError: There is no such batch.
        """
        return (await self.jobs.get(job_id)).sweep or {}

    async def table(self, job_id: str, figures: Sequence[str], client: str) -> bytes | SpoolFile:
        """Return every row column by column, with those figures, as JSON of `BatchTable`.

        Raises:
            NotFoundError: There is no such batch.
            TemporaryError: Too much is being computed, or waits to be read.
        """
        job = await self.jobs.get(job_id)
        fields = job.request["fields"]
        names = [*table.FIXED, *fields, *figures, "source"]
        size, call = table.TABLE_VALUE_BYTES * job.total * len(names), self._page_call(client)
        with (
            self.gate.computing(client, rendering.ROW_COST * job.total),
            self.spool.reserved(client, size) as write,
            self.spool.scratch(client, size) as scratch,
        ):
            pages = table.ColumnPages(names, scratch)
            async for rows in self.rows(job.id):
                pages.add(await call(rendering.column_texts, rows, fields, figures))
            units = {name: unit for name, unit in table.units(job).items() if name in names}
            head = {"batch": job.id, "state": job.state, "units": units}

            async def assembled(path: Path | None) -> bytes:
                return await asyncio.to_thread(pages.assembled, head, path)

            return await write(assembled)

    async def summary(self, job_id: str, figures: Sequence[str], baseline: str | None, client: str) -> BatchSummary:
        """Return the summary of its finished rows.

        Raises:
            NotFoundError: There is no such batch.
            InvalidError: It does not have that baseline.
            TemporaryError: Too much is being read.
        """
        return await self._summaries.get(await self.jobs.get(job_id), figures, baseline, client)

    async def requirements(self, job_id: str) -> BatchRequirements:
        """Return how its runs keep its requirements.

        Raises:
            NotFoundError: There is no such batch.
        """
        job = await self.jobs.get(job_id)
        judged = JudgedRuns(job)
        if job.request.get("requirements"):
            async for rows in self.rows(job.id):
                await asyncio.to_thread(judged.add, rows)
        return judged.answer(job)

    async def results(
        self, job_id: str, file_format: FormatName, client: str, page: Page
    ) -> tuple[StoredJob, AsyncIterator[bytes], ExitStack]:
        """Return the batch, its rows in that format piece by piece, and what counts them as open until it is closed.

        Raises:
            NotFoundError: There is no such batch.
            TemporaryError: Too much is being computed.
        """
        job, counted = await self.jobs.get(job_id), ExitStack()
        counted.enter_context(self.gate.streams.hold(client, 1))
        rows = self.rows(job.id, page.first, page.limit)
        return job, table.RENDERERS[file_format](job, page, rows, self._page_call(client)), counted

    async def rows(self, job_id: str, first: int = 0, limit: int | None = None) -> AsyncIterator[list[JobRow]]:
        """Read its rows in order from that one on, so many at most, some at a time."""
        last = None if limit is None else first + limit
        while last is None or first < last:
            count = ROWS_AT_ONCE if last is None else min(ROWS_AT_ONCE, last - first)
            rows = await self.store.read(self.store.job_runs.rows, job_id, first - 1, count)
            if not rows:
                return
            yield rows
            first = rows[-1].position + 1

    async def _is_resumable(self, job: StoredJob) -> bool:
        """Check whether something of a batch that has ended is left to run, or may run now."""
        if job.state == "done":
            return job.failed > 0 and await self.store.read(self.store.job_runs.may_be_tried_again, job.id)
        return job.state not in UNFINISHED

    async def _checked(self, scenario: Scenario, names: Sequence[str], sweep: Sweep) -> Scenario:
        """Check what takes no time; return the scenario as it is driven."""
        self.jobs.check_runs(sweep.size * len(names))
        settled = await self.roads.settled(scenario)
        try:
            check_at_once(sweep, settled.model_dump(mode="json"))
        except SweepError as error:
            raise _unusable(error) from None
        return settled

    async def _base(
        self, scenario: Scenario, names: Sequence[str], sweep: Sweep, *, given_length: bool
    ) -> tuple[SweepBase, dict[str, MeasuredRoad]]:
        """Return what the sweep changes, and the measured roads that scenario and sweep name.

        Raises:
            InvalidError: A road is not there.
        """
        plain = scenario.model_dump(mode="json")
        of_base = await self.roads.named(measured_roads(plain))
        roads = {**of_base, **await self.roads.named(swept_roads(sweep.plain()), "/sweep")}
        lengths: dict[str | None, float] = {}
        if not given_length:
            lengths = {None: Road().length} | {profile: road.length for profile, road in roads.items()}
        return SweepBase(scenario=plain, strategies=names, lengths=lengths), roads

    async def _planned(self, base: SweepBase, sweep: Sweep, client: str, add: AddRuns | None = None) -> _Planned:
        """Plan piece by piece, and refuse what is over a limit.

        Raises:
            InvalidError: Values cannot be used.
            CostLimitError: It is over a limit.
            TemporaryError: Later.
        """
        planned, count = _Planned(), max(1, PLANNED_AT_ONCE // len(base.strategies))
        for first in range(0, sweep.size, count):
            cost = PLAN_COST * min(count, sweep.size - first) * len(base.strategies)
            try:
                piece = await self._call(client, cost, plan.plan, base, sweep, first, count)
            except SweepError as error:
                raise _unusable(error) from None
            planned.total += len(piece.runs)
            planned.contradictory += piece.contradictory
            planned.cost += piece.cost
            planned.max_run_cost = max(planned.max_run_cost, piece.max_run_cost)
            self.jobs.check_cost(planned.cost, planned.max_run_cost)
            if add is not None:
                await add(piece.runs)
        return planned

    async def _call(self, client: str, cost: float, function: Callable[..., T], *args: Any) -> T:
        """Run a function in a process; a long one behind interactive runs."""
        workers = self.workers if cost < QUICK else self.batch_workers
        return await workers.call(function, *args, client=client, cost=cost)

    def _page_call(self, client: str) -> Callable[..., Awaitable[Any]]:
        """Runs a function of a page of rows in a worker, so that clients take turns page by page."""
        return partial(self.workers.call, client=client, cost=rendering.ROW_COST * ROWS_AT_ONCE)

    async def _queued_cost(self, own: float) -> float:
        """Cost of other jobs' runs before a new job of that cost ends, as all share the processes [s of one core]."""
        unfinished = await self.store.read(self.store.jobs.unfinished)
        return sum(min(own, job.estimated_cost * job.open_runs / job.total) for job in unfinished if job.open_runs)


def _has_length(scenario: Scenario) -> bool:
    """Check whether the road was given a length: else points on measured roads are as long as these."""
    return "length" in scenario.road.model_fields_set


def _unusable(error: SweepError) -> InvalidError:
    return InvalidError("The sweep has fields that cannot be used; errors names each.", errors=error.problems())
