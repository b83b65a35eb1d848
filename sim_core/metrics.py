"""Metrics of a run: RMS and peak per window as the paper's tables, and what the field expects beside them."""

from dataclasses import dataclass
from math import sqrt

import numpy as np

from sim_core.comfort import vibration_dose, weighted
from sim_core.controller import SolverReport
from sim_core.hil.loop import Tally
from sim_core.longitudinal import KMH, TARGET_BAND, Drive
from sim_core.result import FloatArray, Span, StrategyResult
from sim_core.road import kinks
from sim_core.scenario import Scenario
from sim_core.signals import METRIC_SIGNALS
from sim_core.strategies import SpeedPolicy, Strategy, SuspensionPolicy


@dataclass(frozen=True, slots=True, eq=False, kw_only=True)
class Recording:
    """Series on the fine grid (signals.SIGNALS), its step [s], and the deflections' speeds (2, n) [m/s]."""

    step: float
    series: dict[str, FloatArray]
    deflection_speed: FloatArray


def evaluate(
    scenario: Scenario,
    strategy: Strategy,
    drive: Drive,
    stages: tuple[Span, ...],
    recording: Recording,
    report: SolverReport,
    limited_steps: int,
    tally: Tally | None = None,
) -> StrategyResult:
    """Everything a run reports, from its recording; `tally` of a strategy with an ECU."""
    series = recording.series
    windows = _windows(scenario, series["position"])
    arrival = float(drive.at(np.array(drive.time_at(scenario.road.bump.start)))[1])
    between = _between_samples(scenario, drive, recording)
    metrics = {
        window: {
            signal: _statistics(series[signal][kept], between.get((window, signal), 0.0)) for signal in METRIC_SIGNALS
        }
        for window, kept in windows.items()
    }
    static = scenario.real_vehicle.static_loads
    bump_end = scenario.road.bump.start + scenario.road.bump.width + scenario.vehicle.wheelbase
    planned = strategy.speed is SpeedPolicy.PLANNED
    actuated = strategy.suspension is not SuspensionPolicy.PASSIVE
    rough = metrics["rough_road"]
    power = np.abs(series["front_force"] * recording.deflection_speed[0])
    power += np.abs(series["rear_force"] * recording.deflection_speed[1])
    filtered = weighted(series["body_acceleration"], recording.step)
    return StrategyResult(
        strategy=strategy.id,
        metrics=metrics,
        comfort={
            "weighted_rms": _rms(filtered),
            "vibration_dose": vibration_dose(filtered, recording.step),
            "front_dynamic_load_coefficient": rough["front_tyre_load"]["rms"] / static[0],
            "rear_dynamic_load_coefficient": rough["rear_tyre_load"]["rms"] / static[1],
            "actuator_mean_power": float(power.mean()),
            "actuator_peak_power": float(power.max()),
        },
        events={
            **_airborne(recording, static),
            "target_reached": _target_reached(scenario, arrival) if planned else None,
            "bump_complete": bump_end <= scenario.road.length,
            "travel_exceeded_mm": _travel_exceeded(scenario, series),
            "limited_steps": limited_steps,
            "qp_solves": report.solves,
            "qp_fallbacks": report.fallbacks,
            "qp_failures": report.failures,
            "max_slack_mm": report.max_slack * 1000,
            "ecu_most_iterations": tally.iterations if tally else None,
            "ecu_clipped_values": tally.clipped if tally else None,
            "ecu_held_commands": tally.held if tally else None,
        },
        reference={
            "front_static_load": static[0],
            "rear_static_load": static[1],
            "deflection_limit": scenario.mpc.deflection_limit,
            "force_limit": scenario.mpc.force_limit if actuated else None,
            "target_speed": scenario.speed.target_speed_kmh * KMH if planned else None,
            "target_band": TARGET_BAND if planned else None,
        },
        stages=stages,
        travel_time=drive.time_at(scenario.road.length),
        arrival_speed_kmh=arrival / KMH,
        series=series,
    )


def _windows(scenario: Scenario, position: FloatArray) -> dict[str, slice]:
    """Samples of each window; the front axle from 0 to the bump, and on the bump until the rear has left it."""
    bump = scenario.road.bump
    arrival = int(position.searchsorted(bump.start))
    leaving = int(position.searchsorted(bump.start + bump.width + scenario.vehicle.wheelbase, side="right"))
    return {"rough_road": slice(0, arrival), "bump": slice(arrival, leaving), "whole": slice(0, len(position))}


def _rms(values: FloatArray) -> float:
    return sqrt(float(np.dot(values, values)) / len(values))


def _statistics(values: FloatArray, between: float) -> dict[str, float]:
    return {"rms": _rms(values), "peak": float(max(values.max(), -values.min(), between))}


def _between_samples(scenario: Scenario, drive: Drive, recording: Recording) -> dict[tuple[str, str], float]:
    """Magnitudes that no sample shows, by (window, signal), to join the peaks.

    At the bump window's two ends every signal, linear between samples; where an axle meets a kink of the bump its tyre
    load, which turns there: carried on from the three samples before (error of third order in the fine step).
    """
    bump, series, h = scenario.road.bump, recording.series, recording.step
    last = len(series["time"]) - 1
    found: dict[tuple[str, str], float] = {}
    for end in (bump.start, bump.start + bump.width + scenario.vehicle.wheelbase):
        i, share = _place(drive.time_at(end), h)
        if i < last:
            for signal in METRIC_SIGNALS:
                low, high = float(series[signal][i]), float(series[signal][i + 1])
                _join(found, ("bump", signal), abs(low + share * (high - low)))
    for signal, behind in (("front_tyre_load", 0.0), ("rear_tyre_load", scenario.vehicle.wheelbase)):
        for kink in kinks(bump):
            i, share = _place(drive.time_at(kink + behind), h)
            if 2 <= i <= last:
                before, middle, here = (float(value) for value in series[signal][i - 2 : i + 1])
                slope, bend = here - middle, here - 2 * middle + before
                _join(found, ("bump", signal), abs(here + share * slope + share * (share + 1) / 2 * bend))
    found |= {("whole", signal): value for (_, signal), value in found.items()}
    return found


def _place(time: float, step: float) -> tuple[int, float]:
    """The sample before a time, and how far on to the next."""
    place = time / step
    return int(place), place - int(place)


def _join(found: dict[tuple[str, str], float], key: tuple[str, str], value: float) -> None:
    found[key] = max(value, found.get(key, 0.0))


def _airborne(recording: Recording, static: tuple[float, float]) -> dict[str, float]:
    """Time with a tyre pulling on the road, which only the linear model can [ms]."""
    front = recording.series["front_tyre_load"] < -static[0]
    rear = recording.series["rear_tyre_load"] < -static[1]
    each = recording.step * 1000
    return {
        "airborne_ms": float(np.count_nonzero(front | rear)) * each,
        "front_airborne_ms": float(np.count_nonzero(front)) * each,
        "rear_airborne_ms": float(np.count_nonzero(rear)) * each,
    }


def _travel_exceeded(scenario: Scenario, series: dict[str, FloatArray]) -> float:
    largest = max(float(np.abs(series[name]).max()) for name in ("front_deflection", "rear_deflection"))
    return max(0.0, largest - scenario.mpc.deflection_limit) * 1000


def _target_reached(scenario: Scenario, arrival: float) -> bool:
    """Arrival within the band around the target; a target at or above the initial speed asks for nothing."""
    target = scenario.speed.target_speed_kmh * KMH
    if target >= scenario.speed.initial_speed_kmh * KMH:
        return True
    return abs(arrival - target) <= TARGET_BAND + 1e-9
