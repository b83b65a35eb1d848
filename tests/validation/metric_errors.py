"""The table of docs/explanation/metrics.md: how far each metric is from a run in steps of 0.02 ms.

Over twenty class B roads; to print it:

.venv/bin/python -m tests.validation.metric_errors
"""

import multiprocessing
from functools import partial

from sim_core import Road, Scenario, simulate
from tests.validation.reference.held import errors

SEEDS = range(1, 21)
STRATEGIES = ("lv", "lv_hil", "lqr", "suspension_only", "speed_only", "passive")
ROWS = {
    "body acceleration, RMS": ("rough_road.body_acceleration.rms", "bump.body_acceleration.rms"),
    "pitch acceleration, RMS": ("rough_road.pitch_acceleration.rms", "bump.pitch_acceleration.rms"),
    "tyre loads, RMS": tuple(f"{w}.{a}_tyre_load.rms" for w in ("rough_road", "bump") for a in ("front", "rear")),
    "travel, RMS": tuple(f"{w}.{a}_deflection.rms" for w in ("rough_road", "bump") for a in ("front", "rear")),
    "forces, RMS": tuple(f"{w}.{a}_force.rms" for w in ("rough_road", "bump") for a in ("front", "rear")),
    "body acceleration, peak": ("rough_road.body_acceleration.peak", "bump.body_acceleration.peak"),
    "pitch acceleration, peak": ("rough_road.pitch_acceleration.peak", "bump.pitch_acceleration.peak"),
    "tyre loads, peak": tuple(f"{w}.{a}_tyre_load.peak" for w in ("rough_road", "bump") for a in ("front", "rear")),
    "travel, peak": tuple(f"{w}.{a}_deflection.peak" for w in ("rough_road", "bump") for a in ("front", "rear")),
    "forces, peak": tuple(f"{w}.{a}_force.peak" for w in ("rough_road", "bump") for a in ("front", "rear")),
    "weighted RMS": ("comfort.weighted_rms",),
    "vibration dose value": ("comfort.vibration_dose",),
    "actuator power, mean": ("comfort.actuator_mean_power",),
    "actuator power, peak": ("comfort.actuator_peak_power",),
}


def errors_of(strategy: str, scenarios: list[Scenario]) -> list[dict[str, float]]:
    """Of each scenario the errors of its metrics, computed in two processes."""
    with multiprocessing.get_context("spawn").Pool(2) as pool:
        return pool.map(partial(_errors, strategy), scenarios, chunksize=5)


def _errors(strategy: str, scenario: Scenario) -> dict[str, float]:
    return errors(scenario, strategy, simulate(scenario, strategy))


def main() -> None:
    """Print it: the mean size of the errors, then the largest."""
    roads = [Scenario(road=Road(seed=seed)) for seed in SEEDS]
    by_strategy = {name: errors_of(name, roads) for name in STRATEGIES}
    print("| % off, mean (worst road) |", " | ".join(f"`{name}`" for name in STRATEGIES), "|")
    print("|---|" + "---:|" * len(STRATEGIES))
    for label, keys in ROWS.items():
        cells = []
        for name in STRATEGIES:
            sizes = [abs(each[key]) * 100 for each in by_strategy[name] for key in keys]
            cells.append(f"{sum(sizes) / len(sizes):.2f} ({max(sizes):.2f})" if max(sizes) else "")
        print(f"| {label} | " + " | ".join(cells) + " |")


if __name__ == "__main__":
    main()
