"""What a worker process computes of a job; no web here."""

import time

import orjson

from backend.compute.chunk_messages import Chunk
from backend.outcome import Outcome
from backend.scenario_at import scenario_at


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
        outcomes[run.key] = chunk.compute(scenario, run.strategy, run.key)
    return list(outcomes.values())
