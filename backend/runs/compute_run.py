"""The part of a run that a worker process computes: simulations and their decimated time histories.

Nothing of the web is imported here, so that a worker starts quickly and stays small.
"""

import time
from collections.abc import Mapping

import orjson

from backend import digest
from backend.cost.affordable import drive, simulate
from backend.custom_controllers import registry as custom_controllers
from backend.outcome import JSON_OPTIONS, Outcome, Sampling, elapsed_ms
from backend.runs.series import pack
from sim_core import RidelabError, Scenario
from sim_core.controller_files import ControllerFileError, source_of
from sim_core.scenario.recorded import recording_id
from sim_core.strategies import strategy_named


def compute_run(scenario: Scenario, keys: Mapping[str, str], sampling: Sampling | None) -> dict[str, Outcome]:
    """Simulate strategies one after the other, so that what they share is worked out once.

    Args:
        scenario: What to drive.
        keys: Of the results, by strategy.
        sampling: Which samples of the time histories to return; None is no series at all.
    """
    return {strategy: compute(scenario, strategy, key, sampling) for strategy, key in keys.items()}


def compute(scenario: Scenario, strategy: str, key: str, sampling: Sampling | None = None) -> Outcome:
    """Simulate one strategy; arguments as of `compute_run`."""
    begin = time.perf_counter()
    try:
        if key and custom_controllers.is_custom(strategy) and digest.result_key(scenario, strategy) != key:
            raise ControllerFileError("Its file was saved meanwhile: run it again")
        return custom_controllers.run_in_sandbox_process(strategy, _compute, scenario, strategy, key, sampling)
    except RidelabError as error:
        return Outcome.failure(key, strategy, error, begin, sampling)


def _compute(scenario: Scenario, strategy: str, key: str, sampling: Sampling | None) -> Outcome:
    begin = time.perf_counter()
    recorded = recording_id(strategy) is not None
    result = simulate(scenario, strategy) if recorded else drive(scenario, strategy)
    source = None if recorded else source_of(strategy_named(strategy))
    summary = result.summary() if source is None else {"source": source, **result.summary()}
    json = orjson.dumps(summary, option=JSON_OPTIONS, default=dict)
    return Outcome(
        key=key,
        strategy=strategy,
        status="ok",
        json=json,
        compute_ms=elapsed_ms(begin),
        fallbacks=float(result.events["qp_fallbacks"] or 0),
        sampling=sampling,
        series=None if sampling is None else pack(result, sampling),
    )
