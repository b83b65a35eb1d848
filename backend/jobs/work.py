"""What a worker process computes of a job; no web here."""

import time
from collections.abc import Mapping, Sequence

import orjson

from backend.ecu.drive import simulate
from backend.jobs.chunk import ComputedRun, WaitingRun
from backend.jobs.sweep.plan import scenario_at
from backend.json_types import JsonObject
from backend.paper import work as paper
from backend.runs.work import elapsed_ms, refusal, summary_json
from sim_core.errors import MissingRoadError, RidelabError
from sim_core.scenario import Scenario
from sim_core.scenario.measured import MeasuredRoad


def run_chunk(
    base: JsonObject,
    schema_version: int,
    runs: Sequence[WaitingRun],
    roads: Mapping[str, MeasuredRoad],
    budget: float,
) -> list[ComputedRun]:
    """Simulate the runs in order, at least the first; start no other one after `budget` [s].

    Runs of one point lie side by side and share its scenario, equal ones their result.
    """
    end = time.perf_counter() + budget
    computed: dict[str, ComputedRun] = {}
    changes, scenario = None, None
    for run in runs:
        if run.key in computed:
            continue
        if computed and time.perf_counter() > end:
            break
        if scenario is None or run.changes != changes:
            changes, scenario = run.changes, scenario_at(base, orjson.loads(run.changes), schema_version, roads)
        begin, cacheable = time.perf_counter(), True
        try:
            status, (summary, fallbacks) = "ok", _summary(scenario, run.strategy)
        except RidelabError as error:
            status, summary, fallbacks = "failed", orjson.dumps(refusal(error)).decode(), 0.0
            cacheable = not isinstance(error, MissingRoadError)
        elapsed = elapsed_ms(begin)
        computed[run.key] = ComputedRun(
            key=run.key,
            strategy=run.strategy,
            status=status,
            summary=summary,
            compute_ms=elapsed,
            fallbacks=fallbacks,
            cacheable=cacheable,
        )
    return list(computed.values())


def _summary(scenario: Scenario, strategy: str) -> tuple[str, float]:
    """A run's stored summary, as JSON, and its QP solver's fallbacks."""
    if strategy.startswith(paper.PREFIX):
        return orjson.dumps(paper.compute(strategy, scenario), option=orjson.OPT_SERIALIZE_NUMPY).decode(), 0.0
    result = simulate(scenario, strategy)
    return summary_json(result).decode(), float(result.events["qp_fallbacks"] or 0)
