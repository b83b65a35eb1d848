"""What a worker process does with a chunk of a batch; no web here."""

import time
from collections.abc import Mapping, Sequence
from typing import Any

import orjson

from backend.batches.plan import scenario_at
from backend.chunk import ComputedRun, WaitingRun
from backend.errors import EcuUnavailableError
from backend.hil.drive import simulate
from backend.worker import elapsed_ms, refusal, summary_json
from sim_core.errors import RidelabError


def run_chunk(
    base: Mapping[str, Any], schema_version: int, runs: Sequence[WaitingRun], budget: float
) -> list[ComputedRun]:
    """Simulate them in order, the first in any case, and begin no further one after `budget` [s].

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
            changes, scenario = run.changes, scenario_at(base, orjson.loads(run.changes), schema_version)
        begin, lasting = time.perf_counter(), True
        try:
            status, summary = "ok", summary_json(simulate(scenario, run.strategy)).decode()
        except RidelabError as error:
            status, summary = "failed", orjson.dumps(refusal(error)).decode()
            lasting = not isinstance(error, EcuUnavailableError)
        elapsed = elapsed_ms(begin)
        computed[run.key] = ComputedRun(
            key=run.key,
            strategy=run.strategy,
            status=status,
            summary=summary,
            compute_ms=elapsed,
            lasting=lasting,
        )
    return list(computed.values())
