"""The one definition of every metric, for drives that were simulated and for recorded ones.

Both fill the same sums: kernel/record.c while a run is driven, `metrics/sampled.py` from the samples of a recording. A
test reads runs' own exports back as recordings and holds both to each other (tests/unit/test_read_back.py).
"""

from collections.abc import Sequence
from dataclasses import dataclass
from math import isnan, nan, sqrt

import numpy as np

from sim_core.arrays import FloatArray
from sim_core.catalogue import METRIC_SIGNALS, WINDOWS
from sim_core.scenario import Scenario

_LINES = sum(signal.endswith("acceleration") for signal in METRIC_SIGNALS)  # straight between samples

ByWindow = dict[str, dict[str, dict[str, float]]]


@dataclass(frozen=True, slots=True, kw_only=True)
class Sums:
    """Accumulated sums from which the metrics of a drive are computed.

    What was not recorded is NaN.

    Sections are the rough road, the bump, and what follows it; together they are the whole drive.

    Attributes:
        time_unit: Unit of all times and of integrals over time [s].
        durations: Time spent in each section (3,).
        squares: Integral of the square of each of METRIC_SIGNALS in each section (3, 8).
        peaks: Largest magnitude there (3, 8).
        weighted_squares: Sum of the squares of the weighted acceleration's samples [m^2/s^4].
        weighted_fourths: Sum of their fourth powers [m^4/s^8].
        weighted_samples: How many samples there are.
        weighted_step: Time between them [s].
        power: Integral of |u·ḋ|, summed over both axles [W].
        peak_power: Its peak [W].
        airborne: For how long any tyre was off the road.
        front_airborne: For how long the front one was.
        rear_airborne: For how long the rear one was.
        on_stops: For how long either suspension was on its bump stops.
    """

    time_unit: float
    durations: Sequence[float]
    squares: FloatArray
    peaks: FloatArray
    weighted_squares: float
    weighted_fourths: float
    weighted_samples: int
    weighted_step: float
    power: float
    peak_power: float
    airborne: float
    front_airborne: float
    rear_airborne: float
    on_stops: float


def mean_squares(a: FloatArray, b: FloatArray) -> FloatArray:
    """Return mean squares between samples a and b of METRIC_SIGNALS (8, n): accelerations as lines, else trapezoids."""
    squares = (a * a + b * b) / 2
    squares[:_LINES] = (2 * squares[:_LINES] + (a * b)[:_LINES]) / 3
    return squares


def window_metrics(sums: Sums) -> ByWindow:
    """Return RMS and peak of METRIC_SIGNALS in WINDOWS.

    NaN where a signal is not known throughout a window, or that is empty, as where there is no bump.
    """
    squares, peaks, times = sums.squares.tolist(), sums.peaks.tolist(), list(sums.durations)
    squares[-1] = [sum(each) for each in zip(*squares, strict=True)]  # the whole, not what follows the bump
    peaks[-1], times[-1] = [max(each) for each in zip(*peaks, strict=True)], sum(times)
    return {
        window: {
            signal: {"rms": sqrt(square / time), "peak": square if isnan(square) else peak}
            if time
            else {"rms": nan, "peak": nan}
            for signal, square, peak in zip(METRIC_SIGNALS, *of_section, strict=True)
        }
        for window, time, *of_section in zip(WINDOWS, times, squares, peaks, strict=True)
    }


def comfort_metrics(sums: Sums, metrics: ByWindow, scenario: Scenario) -> dict[str, float]:
    """Return the metrics of comfort (catalogue.COMFORT).

    Args:
        sums: Of the drive.
        metrics: Its `window_metrics`.
        scenario: Whose car it is.
    """
    rough, static = metrics["rough_road"], scenario.real_vehicle.static_loads
    return {
        "weighted_rms": sqrt(sums.weighted_squares / sums.weighted_samples),
        "vibration_dose": (sums.weighted_fourths * sums.weighted_step) ** 0.25,  # (∫ a_w⁴ dt)^¼ (ISO 2631-1, 6.3.2)
        "front_dynamic_load_coefficient": rough["front_tyre_load"]["rms"] / static[0],
        "rear_dynamic_load_coefficient": rough["rear_tyre_load"]["rms"] / static[1],
        "actuator_mean_power": sums.power / sum(sums.durations),
        "actuator_peak_power": sums.peak_power,
    }


def drive_events(sums: Sums, metrics: ByWindow, scenario: Scenario) -> dict[str, float | bool | None]:
    """Return the events (catalogue.EVENTS) that follow from a drive's signals, for `comfort_metrics`' arguments.

    The others tell of a controller, which a recording does not have.
    """
    milliseconds, whole = 1000 * sums.time_unit, metrics["whole"]
    travel = float(np.max([whole[f"{axle}_deflection"]["peak"] for axle in ("front", "rear")]))  # NaN if either is
    complete = scenario.bump_left <= scenario.road.length and not isnan(sums.durations[1])
    over = max(0.0, travel - scenario.mpc.deflection_limit) * 1000
    return {
        "airborne_ms": milliseconds * sums.airborne,
        "front_airborne_ms": milliseconds * sums.front_airborne,
        "rear_airborne_ms": milliseconds * sums.rear_airborne,
        "stop_contact_ms": milliseconds * sums.on_stops,
        "bump_complete": complete if scenario.road.has_bump else None,
        "travel_exceeded_mm": None if isnan(travel) else over,
    }
