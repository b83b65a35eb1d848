"""The rows behind the paper page, each stored under what it depends on, computed by workers. No web here.

A row is what one strategy gave on one road under some readings, or what a whole study gave on one road. It is a run of
a job, named by a strategy that begins with `PREFIX`.
"""

from collections.abc import Iterable, Mapping
from dataclasses import dataclass
from functools import lru_cache

import orjson

from backend import digest
from backend.ecu.drive import simulate
from backend.jobs.chunk import PlannedRun
from backend.json_types import JsonObject
from backend.paper.attribution import COMFORT_FIGURES, VARIANTS
from backend.paper.claims import FIGURES, STRATEGIES, WINDOW, figures_by_window, figures_of, scenario_for
from backend.paper.readings import changes_of
from sim_core.catalogue import BUMP, PAPER_SIGNALS, PEAK
from sim_core.scenario import Road, Scenario, Speed
from sim_core.simulate import simulate as simulate_core

PREFIX = "paper."
ATTRIBUTION, SPEEDS = f"{PREFIX}attribution", f"{PREFIX}speeds"
ROAD_END = 110  # Eq. 3 [m]
SPEEDS_KMH = tuple(range(10, 85, 5))  # of Figures 3-6, which the paper draws over speed


@dataclass(frozen=True, slots=True, kw_only=True)
class RowRequest:
    """A row to get: its key, and the run of a job that computes it (`changes` is JSON text)."""

    key: str
    strategy: str
    changes: str

    def run(self, position: int) -> PlannedRun:
        """The run that computes it."""
        return PlannedRun(position, self.changes, self.strategy, self.key)


def requests_under(choices: Mapping[str, str], roads: range) -> dict[str, tuple[RowRequest, ...]]:
    """By strategy the rows under these readings (reading -> choice), road by road."""
    # Where the RMS are taken changes no run.
    return _requests(tuple(sorted((name, choice) for name, choice in choices.items() if name != WINDOW)), roads)


@lru_cache(256)
def _requests(choices: tuple[tuple[str, str], ...], roads: range) -> dict[str, tuple[RowRequest, ...]]:
    changes = [{**changes_of(dict(choices)), "road.seed": seed} for seed in roads]
    texts = [orjson.dumps(each).decode() for each in changes]
    scenarios = [scenario_for(dict(choices), seed) for seed in roads]
    return {
        name: tuple(
            RowRequest(key=digest.figures_key(scenario, name), strategy=f"{PREFIX}{name}", changes=text)
            for scenario, text in zip(scenarios, texts, strict=True)
        )
        for name in STRATEGIES
    }


def requests_of_study(study: str, roads: range) -> tuple[RowRequest, ...]:
    """The rows of ATTRIBUTION or SPEEDS, road by road."""
    return tuple(
        RowRequest(
            key=digest.derived_key(study, {"road": seed}),
            strategy=study,
            changes=orjson.dumps({"road.seed": seed}).decode(),
        )
        for seed in roads
    )


def compute(strategy: str, scenario: Scenario) -> JsonObject:
    """The row of that run, as `{"row": …}`."""
    if strategy == ATTRIBUTION:
        seed = scenario.road.seed
        return {"row": {variant.id: _one(variant.scenario(seed), variant.strategy) for variant in VARIANTS}}
    if strategy == SPEEDS:
        return {"row": peaks_over_speed(scenario.road.seed)}
    return {"row": figures_by_window(scenario, simulate(scenario, strategy.removeprefix(PREFIX)))}


def figures_by_strategy(
    rows: JsonObject, requests: Mapping[str, Iterable[RowRequest]], window: str
) -> dict[str, dict[tuple[str, str, str], list[float]]]:
    """Values as `backend.paper.claims.judge` takes them, of the strategies that have every row.

    Args:
        rows: By key.
        requests: Of `requests_under`.
        window: The choice of that reading.
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
