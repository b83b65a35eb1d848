"""What a worker process computes for the paper page; no web here."""

from collections.abc import Mapping, Sequence
from typing import Any

from backend.hil.drive import simulate
from sim_core.catalogue import PAPER_SIGNALS
from sim_core.scenario import Road, Scenario, Speed
from sim_core.simulate import simulate as simulate_core
from sim_core.strategies import Strategy
from sim_core.study.attribution import COMFORT_FIGURES, VARIANTS
from sim_core.study.paper import IN_ECU, SIMULATED, figures_by_window, figures_of, scenario_for

ROAD_END = 110  # Eq. 3 [m]
SPEEDS_KMH = tuple(range(10, 85, 5))  # of Figures 3-6, which the paper draws over speed


def simulated_values(chosen: Mapping[str, str], seeds: Sequence[int]) -> list[dict[str, dict[str, list[float]]]]:
    """For each seed: strategy -> its `figures_by_window`, under these readings."""
    return [{name: _figures(scenario_for(chosen, seed), name) for name in SIMULATED} for seed in seeds]


def ecu_values(chosen: Mapping[str, str], seeds: Sequence[int]) -> list[dict[str, dict[str, list[float]]]]:
    """The same of hardware in the loop.

    Raises:
        EcuUnavailableError: The ECU's program cannot take part.
    """
    return [{IN_ECU: _figures(scenario_for(chosen, seed), IN_ECU)} for seed in seeds]


def _figures(scenario: Scenario, name: str) -> dict[str, list[float]]:
    return figures_by_window(scenario, simulate(scenario, name))


def combinations(seeds: Sequence[int]) -> list[dict[str, dict[str, Any]]]:
    """For each seed: variant -> its eight `figures`, its comfort figures and its travel time."""
    return [{variant.id: _one(variant.scenario(seed), variant.strategy) for variant in VARIANTS} for seed in seeds]


def _one(scenario: Scenario, strategy: Strategy) -> dict[str, Any]:
    result = simulate_core(scenario, strategy)
    comfort = {key: result.comfort[key] for key in COMFORT_FIGURES}
    return {"figures": figures_of(result), "travel_time": result.travel_time, **comfort}


def peaks_over_speed(seeds: Sequence[int]) -> list[dict[str, list[list[float]]]]:
    """For each seed: `rough` (the paper's road) and `smooth` (the bump alone), peaks on the bump of the passive car.

    Each a row for every speed of SPEEDS_KMH, a column for every one of PAPER_SIGNALS; the paper's road, to its end.
    """
    return [{"rough": _peaks(64e-6, seed), "smooth": _peaks(0, seed)} for seed in seeds]


def _peaks(roughness: float, seed: int) -> list[list[float]]:
    rows = []
    for speed in SPEEDS_KMH:
        scenario = Scenario(
            road=Road(roughness=roughness, seed=seed, length=ROAD_END),
            speed=Speed(initial_speed_kmh=speed),
        )
        metrics = simulate(scenario, "passive").metrics["bump"]
        rows.append([metrics[signal]["peak"] for signal in PAPER_SIGNALS])
    return rows
