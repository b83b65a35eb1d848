"""What a batch will run: each point's scenario, each run's key and cost. Runs in a worker: no web here."""

import statistics
import time
from collections.abc import Iterable, Mapping, Sequence
from dataclasses import dataclass
from typing import Any

import orjson
from pydantic import ValidationError

from backend import digest
from backend.chunk import WaitingRun
from sim_core import dotted
from sim_core.errors import RidelabError
from sim_core.scenario import SCHEMA_VERSION, Scenario
from sim_core.simulation import simulate
from sim_core.versions import restored
from sim_core.workload import estimate

PILOTS = 5  # runs tried to tell how long a batch takes
PILOT_LIMIT = 1.0  # estimated cost [s] beyond which a run is not tried


@dataclass(frozen=True, slots=True, kw_only=True)
class PlannedRun:
    """One run of a batch before it is stored; `key` is None where `reason` says why it cannot run."""

    changes: str
    strategy: str
    key: str | None
    reason: str | None = None


@dataclass(frozen=True, slots=True, kw_only=True)
class Plan:
    """Every run of a batch in order, a point's strategies side by side, and their estimated cost [s of one core]."""

    runs: list[PlannedRun]
    cost: float
    dearest: float


def scenario_at(base: Mapping[str, Any], changes: Mapping[str, Any], schema_version: int = SCHEMA_VERSION) -> Scenario:
    """The scenario of one point; fields have the names they had under that schema version.

    Raises:
        NewerScenarioError: A newer version of Ridelab stored it.
        ValidationError: Its fields contradict each other.
    """
    changed = dotted.with_changes(base, changes)
    return Scenario.model_validate(changed) if schema_version == SCHEMA_VERSION else restored(changed, schema_version)


def rekeyed(
    base: Mapping[str, Any], schema_version: int, runs: Iterable[WaitingRun]
) -> dict[int, tuple[str | None, str | None]]:
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


def plan(base: Mapping[str, Any], strategies: Sequence[str], points: Sequence[Mapping[str, Any]]) -> Plan:
    """Plan every point under every strategy; a point whose fields contradict each other is a failed run, no error."""
    runs: list[PlannedRun] = []
    cost = dearest = 0.0
    for changes in points:
        text = orjson.dumps(changes).decode()
        try:
            scenario = scenario_at(base, changes)
        except ValidationError as error:
            reason = contradiction(error)
            runs += [PlannedRun(changes=text, strategy=name, key=None, reason=reason) for name in strategies]
            continue
        costs = [estimate(scenario, name) for name in strategies]
        cost, dearest = cost + sum(costs), max(dearest, *costs)
        runs += [PlannedRun(changes=text, strategy=name, key=digest.result_key(scenario, name)) for name in strategies]
    return Plan(runs=runs, cost=cost, dearest=dearest)


def contradiction(error: ValidationError) -> str:
    """What is wrong with a point, for its row."""
    first = error.errors(include_input=False, include_url=False)[0]
    field = first.get("ctx", {}).get("field") or ".".join(map(str, first["loc"]))
    return f"{field}: {first['msg']}" if field else str(first["msg"])


def pilot(base: Mapping[str, Any], strategies: Sequence[str], points: Sequence[Mapping[str, Any]]) -> float | None:
    """Time of one point under all strategies [s], the median of some tried ones; None where trying takes too long."""
    times = []
    step = max(1, len(points) // PILOTS)
    for changes in points[step // 2 :: step][:PILOTS]:
        try:
            scenario = scenario_at(base, changes)
            if sum(estimate(scenario, name) for name in strategies) > PILOT_LIMIT * len(strategies):
                return None
            begin = time.perf_counter()
            for name in strategies:
                simulate(scenario, name).summary()
            times.append(time.perf_counter() - begin)
        except (ValidationError, RidelabError):
            continue
    return statistics.median(times) if times else None
