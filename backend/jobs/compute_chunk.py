"""What a worker process computes of a job; no web here."""

import time
from collections.abc import Callable, Mapping

import orjson

from backend.jobs.chunk_messages import Chunk, Computed
from backend.outcome import Outcome
from backend.paper.paper_rows import compute_row
from backend.runs.compute_run import compute
from backend.scenario_at import scenario_at
from sim_core.scenario import Scenario

# By the job's kind, from the scenario, the run's strategy and its key.
COMPUTED_BY: Mapping[Computed, Callable[[Scenario, str, str], Outcome]] = {
    "sweep": compute,
    "reproduction": compute_row,
}


def compute_chunk(chunk: Chunk) -> list[Outcome]:
    """Compute the chunk's runs in order, at least the first; begin no other one after its budget.

    Runs of one point lie side by side and share its scenario, equal ones their result.
    """
    end = time.perf_counter() + chunk.budget
    outcomes: dict[str, Outcome] = {}
    changes, scenario = None, None
    for run in chunk.runs:
        if run.key in outcomes:
            continue
        if outcomes and time.perf_counter() > end:
            break
        if scenario is None or run.changes != changes:
            changes = run.changes
            scenario = scenario_at(chunk.base, orjson.loads(changes), chunk.schema_version, chunk.roads)
        outcomes[run.key] = COMPUTED_BY[chunk.kind](scenario, run.strategy, run.key)
    return list(outcomes.values())
