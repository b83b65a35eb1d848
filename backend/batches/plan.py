"""The plan of a batch: each point's scenario, each run's key and cost. Runs in a worker: no web here."""

import statistics
import time
from collections.abc import Iterable, Mapping, Sequence
from dataclasses import dataclass

import orjson
from pydantic import ValidationError

from backend import digest
from backend.batches import notes
from backend.batches.points import Sweep, axes, points
from backend.cost.affordable import simulate
from backend.cost.estimate import estimate
from backend.job_run import JobRun, PackedRuns
from backend.json_types import JsonObject
from backend.scenario_at import NO_ROADS, contradiction, scenario_at
from sim_core.controller_files import ControllerFileError
from sim_core.errors import RidelabError
from sim_core.scenario.measured import MeasuredRoad

PILOTS = 5  # runs tried to tell how long a batch takes
PILOT_LIMIT = 1.0  # estimated cost [s] beyond which a run is not tried
NO_LENGTHS: Mapping[str | None, float] = {}
PROFILE, LENGTH = "road.profile", "road.length"


@dataclass(frozen=True, slots=True, kw_only=True)
class SweepPlan:
    """A batch before it is stored.

    Attributes:
        fields: Dotted names of the fields that change.
        notes: Which of its runs are alike, and why, in sentences.
        runs: A point's strategies side by side; one whose fields contradict each other has failed already.
        total: How many there are.
        contradictory: How many have failed already.
        cost: Estimated cost of all [s of one core].
        max_run_cost: The greatest of one run [s of one core].
    """

    fields: list[str]
    notes: list[str]
    runs: PackedRuns
    total: int
    contradictory: int
    cost: float
    max_run_cost: float


def rekeyed(base: JsonObject, schema_version: int, runs: Iterable[JobRun]) -> dict[int, tuple[str | None, str | None]]:
    """By position this core version's key of each run, or the reason why it has none."""
    keys: dict[int, tuple[str | None, str | None]] = {}
    for run in runs:
        try:
            scenario = scenario_at(base, orjson.loads(run.changes), schema_version)
            keys[run.position] = (digest.result_key(scenario, run.strategy), None)
        except ValidationError as error:
            keys[run.position] = (None, contradiction(error))
        except RidelabError as error:
            keys[run.position] = (None, error.message)
    return keys


def plan(
    base: JsonObject,
    strategies: Sequence[str],
    sweep: Sweep,
    lengths: Mapping[str | None, float] = NO_LENGTHS,
) -> SweepPlan:
    """Plan every point under every strategy.

    Args:
        base: The plain scenario whose fields the sweep changes.
        strategies: Ids.
        sweep: The points.
        lengths: Of the roads by profile [m], where base was given none: points on another road are as long as it.

    Raises:
        SweepError: The sweep has fields or values that cannot be used.
    """
    fields, changes_by_point = _points(base, sweep, lengths)
    runs: list[JobRun] = []
    cost = max_run_cost = 0.0
    for changes in changes_by_point:
        text = orjson.dumps(changes).decode()
        try:
            scenario = scenario_at(base, changes)
        except ValidationError as error:
            reason = contradiction(error)
            for name in strategies:
                runs.append(JobRun(len(runs), text, name, "", reason))
            continue
        for name in strategies:
            each = estimate(scenario, name)
            cost, max_run_cost = cost + each, max(max_run_cost, each)
            runs.append(JobRun(len(runs), text, name, digest.result_key(scenario, name)))
    said = notes.notes(base, changes_by_point, axes(sweep, fields), runs)
    return SweepPlan(
        fields=fields,
        notes=said,
        runs=PackedRuns(runs),
        total=len(runs),
        contradictory=sum(not run.key for run in runs),
        cost=cost,
        max_run_cost=max_run_cost,
    )


def _points(base: JsonObject, sweep: Sweep, lengths: Mapping[str | None, float]) -> tuple[list[str], list[JsonObject]]:
    fields, every_point = points(sweep, base)
    if not lengths or PROFILE not in fields:
        return fields, every_point
    return fields, [
        {LENGTH: lengths[changes[PROFILE]], **changes} if PROFILE in changes else changes for changes in every_point
    ]


def pilot(
    base: JsonObject,
    strategies: Sequence[str],
    sweep: Sweep,
    lengths: Mapping[str | None, float] = NO_LENGTHS,
    roads: Mapping[str, MeasuredRoad] = NO_ROADS,
) -> float | None:
    """Time of one point under all strategies [s], the median of a few; None where a run would take too long."""
    _, every_point = _points(base, sweep, lengths)
    times = []
    step = max(1, len(every_point) // PILOTS)
    for changes in every_point[step // 2 :: step][:PILOTS]:
        try:
            scenario = scenario_at(base, changes, roads=roads)
            if max(estimate(scenario, name) for name in strategies) > PILOT_LIMIT:
                return None
            begin = time.perf_counter()
            for name in strategies:
                simulate(scenario, name).summary()
            times.append(time.perf_counter() - begin)
        except ControllerFileError:  # each point might take its whole time
            return None
        except (ValidationError, RidelabError):
            continue
    return statistics.median(times) if times else None
