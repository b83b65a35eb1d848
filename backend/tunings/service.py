"""Tunings: accepted whole or refused, then read and resumed while the scheduler drives them."""

import asyncio
import math
from dataclasses import dataclass

from backend.batches import plan
from backend.batches.plan import SweepBase
from backend.batches.points import Sweep
from backend.compute.workers import Workers
from backend.cost.estimate import estimate
from backend.errors import ConflictError, InvalidError
from backend.gate import Gate
from backend.jobs.kind import AddRuns, JobSize
from backend.jobs.service import Jobs, request_hash
from backend.json_types import JsonObject
from backend.settings import Settings
from backend.store import Store, StoredJob
from backend.store.job import UNFINISHED, State
from backend.tunings.answers import Trials, Tuning, TuningEstimate, TuningItem, Tunings
from backend.tunings.measure import Aims
from backend.tunings.models import TuningRequest
from backend.tunings.space import first_weights, longest_run, ranges_of, road
from backend.tunings.steps import TUNING, first_progress
from sim_core.scenario import Scenario, dotted


@dataclass(eq=False, kw_only=True)
class TuningService:
    """The service of tunings."""

    store: Store
    batch_workers: Workers
    gate: Gate
    settings: Settings

    def __post_init__(self) -> None:
        self.jobs = Jobs(kind=TUNING, store=self.store, gate=self.gate, settings=self.settings)

    async def estimate(self, request: TuningRequest, client: str) -> TuningEstimate:
        """Return the size and the estimated time of that tuning.

        It is refused where `create` refuses it.
        """
        stored = request.stored()
        runs, whole_cost = await self._workload(stored, request.trials)
        first = first_weights(stored["scenario"], request.strategy, ranges_of(stored))
        points = [{**weights, **road(stored, seed)} for weights in first for seed in request.seeds]
        sweep = Sweep.model_validate({"list": points})
        cost = plan.TRIAL_RUNS * estimate(request.scenario, request.strategy)
        with self.gate.computing(client, cost):
            each = await self.batch_workers.call(
                plan.trial_time,
                SweepBase(scenario=stored["scenario"], strategies=[request.strategy], lengths={}),
                sweep,
                client=client,
            )
        return TuningEstimate(
            runs=runs,
            generations=math.ceil(request.trials / request.population),
            estimated_cost=whole_cost,
            estimated_seconds=None if each is None else each * runs / self.settings.batch_workers,
        )

    async def create(self, request: TuningRequest, key: str | None, owner: str | None) -> StoredJob:
        """Accept a tuning, which is planned later: when this returns, it is committed.

        Raises:
            ConflictError: The key had another request.
            CostLimitError: It has too many runs.
            BusyError: Too many are waiting.
        """
        stored = request.stored()
        hashed = request_hash({**stored, "scenario": request.scenario.identity(), "trials": request.trials})
        existing = await self.jobs.existing(key, hashed)
        if existing is not None:
            return existing
        self.jobs.check_runs(_count_runs(stored, request.trials)[0])
        await self.jobs.check_room()
        job = StoredJob(
            kind=TUNING.name,
            state="planning",
            label=request.label,
            owner=owner,
            request=stored,
            progress=first_progress(attempt=1),
            total=request.trials,
            request_hash=hashed,
        )
        return await self.jobs.accept(job, key)

    async def plan(self, job: StoredJob, add: AddRuns) -> JobSize:  # it has no runs of its own
        """Estimate the cost of a tuning that was accepted.

        Raises:
            CostLimitError: It is over a limit.
            TemporaryError: Later.
        """
        _, cost = await self._workload({**job.request, "scenario": job.scenario}, job.total)
        return JobSize(total=job.total, estimated_cost=cost)

    async def answer(self, job: StoredJob) -> Tuning:
        """Return the answer about a tuning: its trials give the front, its generations' events the history."""
        trials = await self.store.read(self.store.trials.of, job.id)
        history = await self.store.read(self.store.job_events.history, job.id)
        return await asyncio.to_thread(Tuning.whole, job, trials, history)

    async def page(self, *, limit: int, cursor: str | None, state: State | None, label: str | None) -> Tunings:
        """Return the newest tunings."""
        jobs, after = await self.jobs.page(limit=limit, cursor=cursor, state=state, label=label)
        return Tunings(tunings=[TuningItem.of(job) for job in jobs], next=after)

    async def trials(self, job_id: str) -> Trials:
        """Return every trial.

        Raises:
            NotFoundError: There is no such tuning.
        """
        job = await self.jobs.get(job_id)
        trials = await self.store.read(self.store.trials.of, job.id)
        return Trials(tuning=job.id, trials=trials)

    async def resume(self, job_id: str, trials: int | None, owner: str | None) -> StoredJob:
        """Continue a tuning, up to so many trials; one that has not ended is returned unchanged.

        Raises:
            NotFoundError: There is none.
            ForbiddenError: It belongs to another token.
            ConflictError: It has not ended and other trials are asked for, or there is nothing left to do.
            InvalidError: It has more trials already.
            CostLimitError: It would be over a limit.
            BusyError: Too many are waiting.
        """
        job = await self.jobs.owned(job_id, owner)
        total = job.total if trials is None else trials
        if job.state in UNFINISHED and total == job.total:
            return job
        if job.state in UNFINISHED:
            raise _not_ended()
        if total < job.done + job.failed:
            raise InvalidError(f"It has {job.done + job.failed} trials already", parameter="trials")
        if job.state == "done" and total == job.total:
            raise ConflictError("It is done: name a greater number of trials to go on.", kind="done")
        _, cost = await self._workload({**job.request, "scenario": job.scenario}, total)
        progress = job.progress | {"step": "search", "attempt": job.progress["attempt"] + 1}
        progress.pop("problem", None)
        resumed = await self.jobs.resume(job_id, total=total, estimated_cost=cost, answer=None, progress=progress)
        if resumed.total != total:  # somebody else resumed it meanwhile, with another number of trials
            raise _not_ended()
        return resumed

    async def _workload(self, request: JsonObject, trials: int) -> tuple[int, float]:
        """Return the most runs it can take, and their estimated cost [s of one core].

        Raises:
            CostLimitError: It is over the limits of a batch.
            TemporaryError: Later.
        """
        runs, passive = _count_runs(request, trials)
        self.jobs.check_runs(runs)
        each, of_passive = await self.batch_workers.call(_run_costs, request)
        cost = (runs - passive) * each + passive * of_passive
        self.jobs.check_cost(cost, each)
        return runs, cost


def _count_runs(request: JsonObject, trials: int) -> tuple[int, int]:
    """Return the most runs a tuning can take, and how many of them are the passive car's."""
    aims = Aims.of(request)
    training, validation = len(request["seeds"]), len(request["fresh_seeds"])
    points = len(aims.objectives) + 3  # of the comparison at most: the paper's, the own, each best, the knee
    passive = training + validation if aims.needs_passive else 0
    return trials * training + points * validation + passive, passive


def _run_costs(request: JsonObject) -> tuple[float, float]:
    """Return the estimated costs of a tuning's longest run and of the passive car's; runs in a worker [s]."""
    changes = road(request, request["seeds"][0]) | longest_run(request)
    scenario = Scenario.model_validate(dotted.with_changes(request["scenario"], changes))
    return estimate(scenario, request["strategy"]), estimate(scenario, "passive")


def _not_ended() -> ConflictError:
    return ConflictError("It has not ended: cancel it to change its number of trials.", kind="not-ended")
