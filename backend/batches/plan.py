"""The plan of a batch: each point's scenario and each run's cost, piece by piece. Runs in a worker: no web here."""

import statistics
import time
from collections.abc import Mapping, Sequence
from dataclasses import dataclass

import orjson
from pydantic import ValidationError

from backend import digest
from backend.batches.points import Sweep, points
from backend.cost.affordable import simulate
from backend.cost.estimate import estimate
from backend.job_run import UNAVAILABLE_KEY, JobRun
from backend.json_types import JsonObject
from backend.scenario_at import NO_ROADS, contradiction, scenario_at
from sim_core.controller_files import ControllerFileError
from sim_core.errors import RidelabError
from sim_core.scenario import SCHEMA_VERSION
from sim_core.scenario.measured import MeasuredRoad

TRIAL_RUNS = 5  # to tell how long a batch takes
TRIAL_LIMIT = 1.0  # estimated cost [s] beyond which a run is not tried
PROFILE, LENGTH = "road.profile", "road.length"


@dataclass(frozen=True, slots=True, kw_only=True)
class SweepBase:
    """What a sweep changes.

    Attributes:
        scenario: Plain.
        schema_version: Of the scenario.
        strategies: Ids: each point runs under all of them.
        lengths: Of the roads by profile [m], where the scenario was given none: points on another road are as long.
    """

    scenario: JsonObject
    schema_version: int = SCHEMA_VERSION
    strategies: Sequence[str]
    lengths: Mapping[str | None, float]


@dataclass(frozen=True, slots=True, kw_only=True)
class PlanPiece:
    """Some of a batch's runs.

    Attributes:
        runs: A point's strategies side by side; one whose fields contradict each other has a reason.
        cost: Estimated cost of all [s of one core].
        max_run_cost: The greatest of one run [s of one core].
    """

    runs: list[JobRun]
    cost: float
    max_run_cost: float

    @property
    def contradictory(self) -> int:
        """Count the runs whose fields contradict each other."""
        return sum(run.reason is not None for run in self.runs)


def plan(base: SweepBase, sweep: Sweep, first: int, count: int) -> PlanPiece:
    """Plan `count` points from the one of number `first` under every strategy.

    Raises:
        SweepError: The sweep has fields or values that cannot be used.
    """
    runs: list[JobRun] = []
    cost = max_run_cost = 0.0
    for changes in _points(base, sweep, first, count):
        text = orjson.dumps(changes).decode()
        position = first * len(base.strategies) + len(runs)
        try:
            scenario = scenario_at(base.scenario, changes, base.schema_version)
        except ValidationError as error:
            reason = contradiction(error)
            runs += [JobRun(position + i, text, name, reason=reason) for i, name in enumerate(base.strategies)]
            continue
        runs += [JobRun(position + i, text, name) for i, name in enumerate(base.strategies)]
        costs = [estimate(scenario, name) for name in base.strategies]
        cost, max_run_cost = cost + sum(costs), max(max_run_cost, *costs)
    return PlanPiece(runs=runs, cost=cost, max_run_cost=max_run_cost)


def with_keys(scenario: JsonObject, schema_version: int, runs: Sequence[JobRun]) -> list[JobRun]:
    """Return the runs with the keys of their results, or with the reason why they have none.

    Args:
        scenario: The plain one that they change.
        schema_version: Of it.
        runs: A point's side by side.
    """
    keyed: list[JobRun] = []
    changes, at = None, None
    for run in runs:
        try:
            if at is None or run.changes != changes:
                changes, at = run.changes, scenario_at(scenario, orjson.loads(run.changes), schema_version)
            keyed.append(run._replace(key=digest.result_key(at, run.strategy)))
        except ValidationError as error:
            keyed.append(run._replace(key="", reason=contradiction(error)))
        except RidelabError as error:
            keyed.append(run._replace(key=UNAVAILABLE_KEY, reason=error.message))
    return keyed


def trial_time(base: SweepBase, sweep: Sweep, roads: Mapping[str, MeasuredRoad] = NO_ROADS) -> float | None:
    """Time of one point under all strategies [s], the median of a few; None where a run would take too long."""
    every_point = _points(base, sweep)
    times = []
    step = max(1, len(every_point) // TRIAL_RUNS)
    for changes in every_point[step // 2 :: step][:TRIAL_RUNS]:
        try:
            scenario = scenario_at(base.scenario, changes, roads=roads)
            if max(estimate(scenario, name) for name in base.strategies) > TRIAL_LIMIT:
                return None
            begin = time.perf_counter()
            for name in base.strategies:
                simulate(scenario, name).summary()
            times.append(time.perf_counter() - begin)
        except ControllerFileError:  # each point might take its whole time
            return None
        except (ValidationError, RidelabError):
            continue
    return statistics.median(times) if times else None


def _points(base: SweepBase, sweep: Sweep, first: int = 0, count: int | None = None) -> list[JsonObject]:
    some = points(sweep, base.scenario, first, count)
    return [
        {LENGTH: base.lengths[changes[PROFILE]], **changes} if base.lengths and PROFILE in changes else changes
        for changes in some
    ]
