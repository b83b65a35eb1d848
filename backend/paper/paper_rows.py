"""The rows behind the paper page, each stored under what it depends on, computed by workers. No web here.

A row is what one strategy gave on one road under some choices, or what a whole study gave on one road. A job of the
kind `reproduction` computes it as one of its runs, named by the strategy or the study.
"""

import time
from collections.abc import Iterable, Mapping
from functools import lru_cache
from typing import Any

import orjson

from backend import digest
from backend.cost.affordable import simulate
from backend.job_run import JobRun
from backend.json_types import JsonObject
from backend.outcome import JSON_OPTIONS, Outcome, elapsed_ms
from backend.paper.attribution import COMFORT_FIGURES, VARIANTS
from backend.paper.claims import FIGURES, STRATEGIES, WITHOUT_RUNS, figures_by_window, figures_of, scenario_for
from backend.paper.interpretations import changes_of
from sim_core import RidelabError, Road, Scenario, Speed
from sim_core.catalogue import BUMP, PAPER_SIGNALS, PEAK
from sim_core.simulate import simulate as simulate_core

ATTRIBUTION, SPEEDS = "attribution", "speeds"  # studies
ROAD_END = 110  # Eq. 3 [m]
SPEEDS_KMH = tuple(range(10, 85, 5))  # of Figures 3-6, which the paper draws over speed


def requests_under(choices: Mapping[str, str], roads: range) -> dict[str, tuple[JobRun, ...]]:
    """Return by strategy the rows under these choices (question -> choice), road by road."""
    of_runs = [(name, choice) for name, choice in choices.items() if name not in WITHOUT_RUNS]
    return _requests(tuple(sorted(of_runs)), roads)


@lru_cache(256)
def _requests(choices: tuple[tuple[str, str], ...], roads: range) -> dict[str, tuple[JobRun, ...]]:
    changes = [{**changes_of(dict(choices)), "road.seed": seed} for seed in roads]
    texts = [orjson.dumps(each).decode() for each in changes]
    scenarios = [scenario_for(dict(choices), seed) for seed in roads]
    return {
        name: tuple(
            JobRun(0, text, name, digest.paper_row_key(scenario, name))
            for scenario, text in zip(scenarios, texts, strict=True)
        )
        for name in STRATEGIES
    }


def requests_of_study(study: str, roads: range) -> tuple[JobRun, ...]:
    """The rows of ATTRIBUTION or SPEEDS, road by road."""
    return tuple(
        JobRun(
            0, orjson.dumps({"road.seed": seed}).decode(), study, digest.derived_key(f"paper.{study}", {"road": seed})
        )
        for seed in roads
    )


def compute_row(scenario: Scenario, name: str, key: str) -> Outcome:
    """The row of that strategy or study, as `{"row": …}`."""
    begin = time.perf_counter()
    try:
        json = orjson.dumps({"row": _row(scenario, name.removeprefix("paper."))}, option=JSON_OPTIONS)
    except RidelabError as error:
        return Outcome.failure(key, name, error, begin)
    return Outcome(key=key, strategy=name, status="ok", json=json, compute_ms=elapsed_ms(begin))


def _row(scenario: Scenario, name: str) -> Any:
    if name == ATTRIBUTION:
        seed = scenario.road.seed
        return {variant.id: _one(variant.scenario(seed), variant.strategy) for variant in VARIANTS}
    if name == SPEEDS:
        return peaks_over_speed(scenario.road.seed)
    return figures_by_window(scenario, simulate(scenario, name))


def figures_by_strategy(
    rows: JsonObject, requests: Mapping[str, Iterable[JobRun]], window: str
) -> dict[str, dict[tuple[str, str, str], list[float]]]:
    """Values as `backend.paper.claims.judge` takes them, of the strategies that have every row.

    Args:
        rows: By key.
        requests: Of `requests_under`.
        window: The choice of that question.
    """
    complete = {
        name: [rows[each.key] for each in row_requests]
        for name, row_requests in requests.items()
        if all(each.key in rows for each in row_requests)
    }
    return {
        name: {figure: [run[window][index] for run in runs] for index, figure in enumerate(FIGURES)}
        for name, runs in complete.items()
    }


def _one(scenario: Scenario, strategy: str) -> JsonObject:
    """A variant's eight `figures`, its comfort figures and its travel time."""
    result = simulate_core(scenario, strategy)
    comfort = {key: result.comfort[key] for key in COMFORT_FIGURES}
    return {"figures": figures_of(result), "travel_time": result.travel_time, **comfort}


def peaks_over_speed(seed: int) -> dict[str, list[list[float]]]:
    """`rough` (the paper's road) and `smooth` (the bump alone): peaks on the bump of the passive car.

    Each a row for every speed of SPEEDS_KMH, a column for every one of PAPER_SIGNALS; the paper's road, to its end.
    """
    return {"rough": _peaks(64e-6, seed), "smooth": _peaks(0, seed)}


def _peaks(roughness: float, seed: int) -> list[list[float]]:
    rows = []
    for speed in SPEEDS_KMH:
        scenario = Scenario(
            road=Road(roughness=roughness, seed=seed, length=ROAD_END),
            speed=Speed(initial_speed_kmh=speed),
        )
        metrics = simulate(scenario, "passive").metrics[BUMP]
        rows.append([metrics[signal][PEAK] for signal in PAPER_SIGNALS])
    return rows
