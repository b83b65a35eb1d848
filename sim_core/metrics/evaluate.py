"""Metrics of a run: RMS and peak per window as the paper's tables, and what the field expects beside them.

A record has a column for each held command, with the values at both its ends: forces jump where a command changes, and
so do the accelerations. Mean squares are trapezoids within the columns; windows end between samples, where the drive
does.
"""

from collections.abc import Sequence
from math import sqrt

import numpy as np

from sim_core.arrays import FloatArray
from sim_core.catalogue import METRIC_SIGNALS, WINDOWS
from sim_core.kernel import binding
from sim_core.loop.excitation import Excitation
from sim_core.loop.run import Recording, Run
from sim_core.metrics.comfort import vibration_dose, weighted
from sim_core.metrics.sections import Integrand, SectionValues, over_sections
from sim_core.metrics.tyre_peaks import peaks_with_kinks
from sim_core.metrics.windows import Windows, section_ends, windows_of
from sim_core.result import Series, StrategyResult
from sim_core.scenario import Scenario, Vehicle
from sim_core.scenario.parts import KMH
from sim_core.speed.profile import TARGET_BAND, SpeedProfile
from sim_core.vehicle.plant import RECORDED

_ROW = {signal: row for row, signal in enumerate(METRIC_SIGNALS)}
_SPEEDS = len(RECORDED) - len(METRIC_SIGNALS)  # those of the deflections come before them
# The accelerations jump with the force and are steep lines in between.
_INTEGRANDS = [Integrand.SQUARE_OF_LINE] * 2 + [Integrand.SQUARE] * (len(METRIC_SIGNALS) - 2)
_LOADS = slice(_ROW["front_tyre_load"], _ROW["rear_tyre_load"] + 1)
_FORCES = slice(_ROW["front_force"], _ROW["rear_force"] + 1)


def evaluate(run: Run, recording: Recording) -> StrategyResult:
    """Everything a run reports, from its recording."""
    scenario, controller, speed_profile = run.scenario, run.controller, run.speed_profile
    bump, excitation, report = scenario.road.bump, run.excitation, controller.report
    speeds, signals = recording.table[:_SPEEDS], recording.table[_SPEEDS:]
    windows = windows_of(excitation.grid, speed_profile, bump.start, scenario.bump_left, scenario.road.length)
    values = over_sections(signals, _INTEGRANDS, windows.ends)
    metrics = _by_window(values, signals[_LOADS], windows, excitation, scenario.real_vehicle)

    arrival = windows.arrival_speed
    static = scenario.real_vehicle.static_loads
    planned, actuated = run.plan == "planned", controller.actuated
    rough, whole = metrics["rough_road"], metrics["whole"]
    travel = max(whole["front_deflection"]["peak"], whole["rear_deflection"]["peak"])
    filtered = weighted(signals[_ROW["body_acceleration"]], excitation.grid.fine_step, len(excitation.series["time"]))
    return StrategyResult(
        strategy=controller.id,
        metrics=metrics,
        comfort={
            "weighted_rms": sqrt(float(filtered @ filtered) / len(filtered)),
            "vibration_dose": vibration_dose(filtered, excitation.grid.fine_step),
            "front_dynamic_load_coefficient": rough["front_tyre_load"]["rms"] / static[0],
            "rear_dynamic_load_coefficient": rough["rear_tyre_load"]["rms"] / static[1],
            **_power(signals[_FORCES], speeds, windows),
        },
        events={
            **_airborne(signals[_LOADS], values.highest[_LOADS], windows, static),
            "target_reached": _target_reached(scenario, arrival) if planned else None,
            "bump_complete": scenario.bump_left <= scenario.road.length,
            "travel_exceeded_mm": max(0.0, travel - scenario.mpc.deflection_limit) * 1000,
            "limited_steps": recording.limited,
            "qp_solves": report.solves,
            "qp_fallbacks": report.fallbacks,
            "qp_failures": report.failures,
            "max_slack_mm": report.max_slack * 1000,
            "ecu_most_iterations": report.most_iterations,
            "ecu_clipped_values": report.clipped_values,
            "ecu_held_commands": recording.held_commands,
        },
        reference={
            "front_static_load": static[0],
            "rear_static_load": static[1],
            "deflection_limit": scenario.mpc.deflection_limit,
            "force_limit": scenario.mpc.force_limit if actuated else None,
            "target_speed": scenario.speed.target if planned else None,
            "target_band": TARGET_BAND if planned else None,
        },
        stages=run.stages,
        travel_time=speed_profile.time_at(scenario.road.length),
        arrival_speed_kmh=arrival / KMH,
        series=Series(excitation.series, dict(zip(METRIC_SIGNALS, signals, strict=True))),
    )


def _by_window(
    values: SectionValues, loads: FloatArray, windows: Windows, excitation: Excitation, vehicle: Vehicle
) -> dict[str, dict[str, dict[str, float]]]:
    """RMS and peak of METRIC_SIGNALS in WINDOWS."""
    durations = windows.ends[:, 1] - windows.ends[:, 0]
    rough, bump, _ = squares = values.integrals.T
    means = rough / durations[0], bump / durations[1], squares.sum(axis=0) / durations.sum()
    peaks, highest = values.peaks, values.highest[_LOADS]
    peaks[:, _LOADS] = peaks_with_kinks(loads, highest, peaks[:, _LOADS].T, vehicle, windows, excitation).T
    return {
        window: {
            signal: {"rms": rms, "peak": peak}
            for signal, rms, peak in zip(METRIC_SIGNALS, np.sqrt(mean).tolist(), highest.tolist(), strict=True)
        }
        for window, mean, highest in zip(WINDOWS, means, (*peaks[:2], peaks.max(axis=0)), strict=True)
    }


def rms_between(
    series: Series, speed_profile: SpeedProfile, intervals: Sequence[tuple[float, float]]
) -> dict[str, float]:
    """RMS of METRIC_SIGNALS over all the time in which the front axle is in one of these intervals of the road.

    Args:
        series: Of a run; as exact as its metrics, whose windows `intervals` may differ from.
        speed_profile: Of that run.
        intervals: First and last position [m], from x = 0 to the road's end at most; none overlap.

    Raises:
        ValueError: An interval is empty, or the run does not reach its end.
    """
    time = series["time"]
    fine_step = float(time[-1]) / (len(time) - 1)
    table = np.ascontiguousarray([series.columns(signal) for signal in METRIC_SIGNALS])
    times = [(speed_profile.time_at(first), speed_profile.time_at(last)) for first, last in intervals]
    ends = section_ends([(first / fine_step, last / fine_step) for first, last in times])
    durations = ends[:, 1] - ends[:, 0]
    if (durations <= 0).any() or ends.min() < 0 or ends.max() > (table.shape[1] - 1) * table.shape[2]:
        raise ValueError("An interval ends behind its beginning and lies on the road that was driven")
    means = over_sections(table, _INTEGRANDS, ends).integrals.sum(axis=1) / durations.sum()
    return dict(zip(METRIC_SIGNALS, np.sqrt(means).tolist(), strict=True))


def _power(forces: FloatArray, speeds: FloatArray, windows: Windows) -> dict[str, float]:
    """Mean and largest |u·ḋ| summed over both axles [W], from samples (2, fine steps of a command + 1, commands)."""
    mean = peak = 0.0
    if forces.any():
        power = np.empty((1, *forces.shape[1:]))
        binding.power(forces, speeds, power)
        values = over_sections(power, [Integrand.VALUE], windows.ends)
        mean = float(values.integrals.sum() / (windows.ends[-1, 1] - windows.ends[0, 0]))
        peak = float(values.peaks.max())
    return {"actuator_mean_power": mean, "actuator_peak_power": peak}


def _airborne(
    loads: FloatArray, highest: FloatArray, windows: Windows, static: tuple[float, float]
) -> dict[str, float]:
    """Time with a tyre off the road, or pulling on it where it cannot lift off [ms].

    Args:
        loads: Front and rear (2, fine steps of a command + 1, commands) [N].
        highest: Their largest magnitude under each command (2, commands) [N].
        windows: Where the sections lie.
        static: The static loads [N].
    """
    keys = "airborne_ms", "front_airborne_ms", "rear_airborne_ms"
    if (highest < np.reshape(static, (2, 1))).all():
        return dict.fromkeys(keys, 0.0)
    front, rear = loads <= -np.reshape(static, (2, 1, 1))
    samples = np.array([front | rear, front, rear], dtype=np.float64)
    durations = over_sections(samples, [Integrand.VALUE] * 3, windows.ends).integrals.sum(axis=1)
    return dict(zip(keys, (durations * (windows.fine_step * 1000)).tolist(), strict=True))


def _target_reached(scenario: Scenario, arrival: float) -> bool:
    """Arrival within the band around the target; a target at or above the initial speed asks for nothing."""
    target = scenario.speed.target
    return target >= scenario.speed.initial or abs(arrival - target) <= TARGET_BAND + 1e-9
