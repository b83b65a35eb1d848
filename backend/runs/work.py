"""The part of a run that a worker process computes: simulations and their decimated time histories.

Nothing of the web is imported here, so that a worker starts quickly and stays small.
"""

import time
from collections.abc import Sequence
from dataclasses import dataclass

import orjson

from backend.ecu.drive import simulate
from backend.json_types import JsonObject
from backend.runs.series import SeriesArray, pack
from sim_core.errors import MissingRoadError, RidelabError, TooExpensiveError
from sim_core.result import StrategyResult
from sim_core.scenario import Scenario

SUMMARY_BYTES = 20 * 1024  # a summary's dictionaries and numbers as Python holds them


@dataclass(frozen=True, slots=True, kw_only=True)
class ComputedResult:
    """One strategy's computed result.

    Attributes:
        summary: `StrategyResult.summary()` as plain JSON values, or `refusal` where the core refused.
        compute_ms: The worker's own time [ms]; work shared between strategies is counted at the first.
        cacheable: Whether the scenario is to blame for a failure; else it is not stored, and tried again next time.
        points: About how many samples `series` has; None where none were asked for.
        series: See `backend.runs.series`; None where none were asked for, or where it failed.
    """

    status: str
    summary: JsonObject
    compute_ms: float
    cacheable: bool = True
    points: int | None = None
    series: SeriesArray | None = None

    @property
    def size(self) -> int:
        """Memory it takes, roughly [bytes]."""
        return SUMMARY_BYTES + (self.series.nbytes if self.series is not None else 0)


def run(scenario: Scenario, strategies: Sequence[str], points: int | None) -> dict[str, ComputedResult]:
    """Simulate the strategies one after the other, so that what they share is worked out once.

    Args:
        scenario: What to drive.
        strategies: Ids.
        points: About how many samples of each time history to return; None is no series at all.
    """
    return {strategy: _run_one(scenario, strategy, points) for strategy in strategies}


def _run_one(scenario: Scenario, strategy: str, points: int | None) -> ComputedResult:
    begin = time.perf_counter()
    try:
        result = simulate(scenario, strategy)
    except RidelabError as error:
        elapsed, cacheable = elapsed_ms(begin), not isinstance(error, MissingRoadError)
        summary = refusal(error)
        return ComputedResult(status="failed", summary=summary, compute_ms=elapsed, cacheable=cacheable, points=points)
    summary = orjson.loads(summary_json(result))
    elapsed = elapsed_ms(begin)
    series = None if points is None else pack(result, points)
    return ComputedResult(status="ok", summary=summary, compute_ms=elapsed, points=points, series=series)


def refusal(error: RidelabError) -> JsonObject:
    """Why there is no result, as it is stored: the reason; of a run that is too expensive also `kind` and `fields`."""
    if isinstance(error, TooExpensiveError):
        return {"reason": error.message, "kind": "too-expensive", "fields": list(error.fields)}
    return {"reason": error.message}


def summary_json(result: StrategyResult) -> bytes:
    """A result without its series as JSON."""
    return orjson.dumps(result.summary(), option=orjson.OPT_SERIALIZE_NUMPY, default=dict)


def elapsed_ms(begin: float) -> float:
    """Time since `time.perf_counter()` gave `begin` [ms]."""
    return round(1000 * (time.perf_counter() - begin), 2)
