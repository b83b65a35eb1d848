"""The steps of a tuning: a generation is proposed, computed and committed; the last step is the comparison.

The database is the truth. The next step follows from what is committed: the trials of complete generations, and sweeps
that are found again by their keys. So whoever takes a step, and however often it is begun, it is the same step, and
what a crash interrupts goes on where its sweep stands.
"""

import asyncio
import logging
from collections.abc import Sequence
from concurrent.futures import ThreadPoolExecutor
from functools import partial
from typing import Any, Literal

import orjson

from backend.batches.kind import SWEEP
from backend.batches.points import Sweep
from backend.batches.service import BatchService
from backend.custom_controllers import registry as custom_controllers
from backend.custom_controllers.registry import Watch
from backend.errors import ServiceError, TemporaryError
from backend.job_run import JobRow
from backend.jobs.kind import JobFailedError, JobKind
from backend.json_types import JsonObject, Summary
from backend.store import Store, StoredJob
from backend.store.jobs import ParentEndedError
from backend.store.trials import StoredTrial
from backend.tunings import comparison, front
from backend.tunings.comparison_models import TuningComparison
from backend.tunings.measure import Aims, Failure, Measured, RunsByRoad
from backend.tunings.objectives import UndefinedObjectiveError
from backend.tunings.space import Weights, first_weights, has_own_weights, ranges_of, road, weights_at, weights_of
from sim_core import __version__ as CORE_VERSION
from sim_core.errors import RidelabError
from sim_core.scenario import SCHEMA_VERSION, Scenario
from sim_core.scenario.versions import restored

logger = logging.getLogger(__name__)

Step = Literal["search", "comparison"]
TUNING = JobKind(name="tuning", word="tuning", plural="tunings", size_pointer="/trials", run_pointer="/scenario")


class TuningSteps:
    """Takes the steps; Optuna has a thread of its own."""

    def __init__(self, store: Store, sweeps: BatchService, own_files: Watch) -> None:
        self._store = store
        self._own_files = own_files
        self._sweeps = sweeps
        self._asking = ThreadPoolExecutor(1, thread_name_prefix="tuner")

    def close(self) -> None:
        """Stop proposing."""
        self._asking.shutdown(wait=False, cancel_futures=True)

    async def step(self, job: StoredJob) -> None:
        """Take the next step to its end.

        Raises:
            JobFailedError: It cannot go on.
            TemporaryError: The service is full.
        """
        try:
            await self._check_controller(job.request)
            if job.core_version != CORE_VERSION:
                await self._begin_anew(job)
                return
            trials = await self._store.read(self._store.trials.of, job.id)
            aims = Aims.of(job.request)
            if len(trials) < job.total:
                await self._generation(job, trials, aims)
            else:
                await self._compare(job, trials, aims)
        except ParentEndedError:
            return  # it was cancelled meanwhile
        except UndefinedObjectiveError as error:
            raise JobFailedError(str(error)) from error
        except TemporaryError:
            raise
        except ServiceError as error:
            raise JobFailedError(error.message) from error

    async def _check_controller(self, request: JsonObject) -> None:
        """Check that a custom controller is the one that the tuning began with: two are not mixed."""
        if (source := request.get("source")) is not None:
            await self._own_files.refresh_if_changed()
            if custom_controllers.source(request["strategy"]) != source:
                raise JobFailedError(f"{source['file']} has changed or gone since it began: begin another tuning")

    async def _begin_anew(self, job: StoredJob) -> None:
        """Restart from the beginning, so that numbers of two core versions are not mixed; the search is repeatable."""
        logger.warning("Tuning %s begins again with core %s", job.id, CORE_VERSION)
        try:
            scenario = restored(job.request["scenario"], job.schema_version).model_dump(mode="json")
        except (RidelabError, ValueError) as error:
            raise JobFailedError(f"Core {CORE_VERSION} cannot read its scenario") from error
        await self._advance(
            job,
            event="restart",
            drop_trials=True,
            request={**job.request, "scenario": scenario},
            core_version=CORE_VERSION,
            schema_version=SCHEMA_VERSION,
            progress=first_progress(job.progress["attempt"] + 1),
            done=0,
            failed=0,
            answer=None,
        )

    async def _generation(self, job: StoredJob, trials: list[StoredTrial], aims: Aims) -> None:
        seeds, generation = job.request["seeds"], job.progress["generation"]
        sweep = await self._existing(job, str(generation))
        if sweep is None:
            sets = await self._next_weights(job, trials)
            sweep = await self._submit(job, str(generation), job.request["strategy"], sets, seeds)
        measured = await self._measured(job, "search", sweep, aims, seeds)
        if measured is None:
            return
        new = [
            aims.trial(len(trials) + index, generation, weights, runs)
            for index, (weights, runs) in enumerate(zip(_sets_of(job, sweep), measured, strict=True))
        ]
        if not trials and all(trial.values is None for trial in new):
            raise JobFailedError(f"No set of weights could be run. {new[0].reason}")
        succeeded = sum(trial.status == "ok" for trial in new)
        feasible = job.progress["feasible"] + sum(trial.feasible for trial in new)
        await self._advance(
            job,
            event="progress",
            details=await asyncio.to_thread(_quality, [*trials, *new], len(aims.objectives)),
            new_trials=new,
            progress=_waiting_for(job, "search", sweep) | {"generation": generation + 1, "feasible": feasible},
            done=job.done + succeeded,
            failed=job.failed + len(new) - succeeded,
        )

    async def _next_weights(self, job: StoredJob, trials: list[StoredTrial]) -> list[Weights]:
        """The generation's sets of weights: first the paper's and the scenario's own, then what Optuna proposes."""
        from backend.tunings.search import ask  # Optuna and all: not before there is a tuning

        request = job.request
        scenario, strategy, ranges = request["scenario"], request["strategy"], ranges_of(request)
        count = min(request["population"], job.total - len(trials))
        first = first_weights(scenario, strategy, ranges)[len(trials) : len(trials) + count]
        proposing = partial(ask, request, trials, generation=job.progress["generation"], count=count - len(first))
        points = await asyncio.get_running_loop().run_in_executor(self._asking, proposing)
        present = weights_at(scenario, strategy, ranges)
        return [*first, *(weights_of(point, ranges, present) for point in points)]

    async def _compare(self, job: StoredJob, trials: list[StoredTrial], aims: Aims) -> None:
        request, objectives = job.request, len(aims.objectives)
        has_own = has_own_weights(request, trials)
        roles = await asyncio.to_thread(comparison.roles, trials, objectives, own=has_own)
        sweep = await self._existing(job, "comparison")
        if sweep is None:
            sets = [trials[number].weights for number in roles]
            sweep = await self._submit(job, "comparison", request["strategy"], sets, _roads(job))
        measured = await self._measured(job, "comparison", sweep, aims, _roads(job))
        if measured is None:
            return
        by_number = dict(zip(roles, measured, strict=True))
        points = await asyncio.to_thread(
            comparison.compared, trials, roles, by_number, request["seeds"], request["fresh_seeds"], aims
        )
        await self._advance(
            job,
            event="state",
            state="done",
            progress=_waiting_for(job, "comparison", sweep),
            answer=TuningComparison(batch=sweep.id, figures=comparison.columns(aims), points=points).model_dump(),
        )

    async def _measured(
        self, job: StoredJob, step: Step, sweep: StoredJob, aims: Aims, seeds: Sequence[int]
    ) -> list[RunsByRoad] | None:
        """The metrics of each set of weights on each road; None where the tuning has ended meanwhile."""
        progress = _waiting_for(job, step, sweep)
        event = "state" if job.state != "running" or job.progress["step"] != step else None
        if not await self._advance(job, event=event, state="running", progress=progress):
            await self._store.write(self._store.jobs.cancel, sweep.id)
            return None
        passive: dict[int, Summary] = {}
        if aims.needs_passive:
            passive = await self._passive(job)
        await self._wait_for(sweep)
        measured: list[RunsByRoad] = []
        async for rows in self._sweeps.rows(sweep.id):
            values = await asyncio.to_thread(_measure, rows, aims, seeds, passive)
            for row, value in zip(rows, values, strict=True):
                index, road = divmod(row.position, len(seeds))
                if index == len(measured):
                    measured.append({})
                measured[index][seeds[road]] = value
        return measured

    async def _passive(self, job: StoredJob) -> dict[int, Summary]:
        """The passive car's runs by road, on every road of the tuning."""
        seeds = _roads(job)
        sweep = await self._existing(job, "passive") or await self._submit(job, "passive", "passive", [{}], seeds)
        await self._wait_for(sweep)
        summaries: dict[int, Summary] = {}
        async for rows in self._sweeps.rows(sweep.id):
            for row in rows:
                summary = orjson.loads(row.summary or "{}")
                if row.status != "ok":
                    raise JobFailedError(f"The passive car failed. {row.reason or summary.get('reason')}")
                summaries[seeds[row.position]] = summary
        return summaries

    async def _existing(self, job: StoredJob, name: str) -> StoredJob | None:
        return await self._store.read(self._store.jobs.by_idempotency_key, SWEEP.name, _key(job, name))

    async def _submit(
        self, job: StoredJob, name: str, strategy: str, sets: Sequence[Weights], seeds: Sequence[int]
    ) -> StoredJob:
        """Submit each set of weights on each road, a set's roads side by side."""
        points = [{**weights, **road(job.request, seed)} for weights in sets for seed in seeds]
        sweep = Sweep.model_validate({"list": points})
        scenario = Scenario.model_validate(job.request["scenario"])
        return await self._sweeps.create(
            scenario, [strategy], sweep, key=_key(job, name), parent_id=job.id, owner=job.owner
        )

    async def _wait_for(self, sweep: StoredJob) -> None:
        """Wait until the sweep has ended.

        Raises:
            JobFailedError: It was cancelled, or failed as a whole.
        """
        now = await self._store.ended(sweep.id)
        if now is None or now.state == "cancelled":
            raise JobFailedError("One of its batches was cancelled")
        if now.state == "failed":
            raise JobFailedError(f"One of its batches failed. {now.reason}")

    async def _advance(self, job: StoredJob, **changes: Any) -> bool:
        return await self._store.write(self._store.jobs.advance, job, **changes)


def first_progress(attempt: int) -> JsonObject:
    """Return the progress of a tuning without trials: attempt, step, complete generations, feasible trials."""
    return {"step": "search", "attempt": attempt, "generation": 0, "feasible": 0, "batch": None}


def _waiting_for(job: StoredJob, step: Step, sweep: StoredJob) -> JsonObject:
    return job.progress | {"step": step, "batch": sweep.id}


def _key(job: StoredJob, name: str) -> str:
    """Return the sweep's idempotency key; its spaces keep it apart from every key that a request can send."""
    return f"tuning {job.id} {job.progress['attempt']} {name}"


def _roads(job: StoredJob) -> list[int]:
    """Return every road of the tuning: the training roads, then the validation roads."""
    return [*job.request["seeds"], *job.request["fresh_seeds"]]


def _sets_of(job: StoredJob, sweep: StoredJob) -> list[Weights]:
    """Return the sets of weights in a generation's sweep."""
    seeds = job.request["seeds"]
    of_road = road(job.request, seeds[0])
    points = (sweep.sweep or {})["list"][:: len(seeds)]
    return [{name: value for name, value in point.items() if name not in of_road} for point in points]


def _measure(
    rows: Sequence[JobRow], aims: Aims, seeds: Sequence[int], passive: dict[int, Summary]
) -> list[Measured | Failure]:
    return [aims.measured(row, passive.get(seeds[row.position % len(seeds)], {})) for row in rows]


def _quality(trials: Sequence[StoredTrial], objectives: int) -> JsonObject:
    """Return the values of the best trials so far, for a generation's event."""
    best = [front.best(trials, index) for index in range(objectives)]
    return {
        "best": [None if trial is None or trial.values is None else trial.values[i] for i, trial in enumerate(best)],
        "hypervolume": front.dominated_share(front.front(trials), trials[0].values),
    }
