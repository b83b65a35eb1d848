"""Metrics of a run: RMS and peak per window as the paper's tables, and what the field expects beside them.

A record has a column for each held command, with the values at both its ends: forces jump where a command changes, and
so do the accelerations. Mean squares are trapezoids within the columns; windows end between samples, where the drive
does.
"""

from collections.abc import Sequence
from math import sqrt

import numpy as np
from numpy.typing import NDArray

from sim_core.arrays import FloatArray
from sim_core.car.plant import RECORDED
from sim_core.catalogue import METRIC_SIGNALS, WINDOWS
from sim_core.comfort import vibration_dose, weighted
from sim_core.drive.sampling import RoadInput
from sim_core.drive.speed_profile import KMH, TARGET_BAND, Drive
from sim_core.recording import Recording
from sim_core.result import Series, Span, StrategyResult
from sim_core.scenario import Scenario, Vehicle
from sim_core.sections import Integrand, SectionValues, over_sections
from sim_core.strategies import SpeedPolicy, Strategy, SuspensionPolicy
from sim_core.windows import Windows, section_ends, windows_of

_ROW = {signal: row for row, signal in enumerate(METRIC_SIGNALS)}
_SPEEDS = len(RECORDED) - len(METRIC_SIGNALS)  # those of the deflections come before them
# The accelerations jump with the force and are steep lines in between.
_INTEGRANDS = [Integrand.SQUARE_OF_LINE] * 2 + [Integrand.SQUARE] * (len(METRIC_SIGNALS) - 2)
_LOADS = slice(_ROW["front_tyre_load"], _ROW["rear_tyre_load"] + 1)
_FORCES = slice(_ROW["front_force"], _ROW["rear_force"] + 1)


def evaluate(
    scenario: Scenario,
    strategy: Strategy,
    drive: Drive,
    stages: tuple[Span, ...],
    recording: Recording,
) -> StrategyResult:
    """Everything a run reports, from its recording."""
    bump, road_input = scenario.road.bump, recording.road_input
    report, loop = recording.report, recording.loop
    speeds, signals = recording.table[:_SPEEDS], recording.table[_SPEEDS:]
    samples, commands = signals.shape[1:]
    bump_end = bump.end + scenario.vehicle.wheelbase
    windows = windows_of(road_input.drive, drive, bump.start, bump_end, scenario.road.length, samples - 1, commands)
    values = over_sections(signals, _INTEGRANDS, windows.ends)
    metrics = _by_window(values, signals[_LOADS], windows, road_input, scenario.real_vehicle)

    arrival = windows.arrival_speed
    static = scenario.real_vehicle.static_loads
    planned = strategy.speed is SpeedPolicy.PLANNED
    actuated = strategy.suspension is not SuspensionPolicy.PASSIVE
    rough, whole = metrics["rough_road"], metrics["whole"]
    travel = max(whole["front_deflection"]["peak"], whole["rear_deflection"]["peak"])
    filtered = weighted(signals[_ROW["body_acceleration"]], road_input.fine_step, len(road_input.series["time"]))
    return StrategyResult(
        strategy=strategy.id,
        metrics=metrics,
        comfort={
            "weighted_rms": sqrt(float(filtered @ filtered) / len(filtered)),
            "vibration_dose": vibration_dose(filtered, road_input.fine_step),
            "front_dynamic_load_coefficient": rough["front_tyre_load"]["rms"] / static[0],
            "rear_dynamic_load_coefficient": rough["rear_tyre_load"]["rms"] / static[1],
            **_power(signals[_FORCES], speeds, windows),
        },
        events={
            **_airborne(signals[_LOADS], values.highest[_LOADS], windows, static),
            "target_reached": _target_reached(scenario, arrival) if planned else None,
            "bump_complete": bump_end <= scenario.road.length,
            "travel_exceeded_mm": max(0.0, travel - scenario.mpc.deflection_limit) * 1000,
            "limited_steps": recording.limited,
            "qp_solves": report.solves,
            "qp_fallbacks": report.fallbacks,
            "qp_failures": report.failures,
            "max_slack_mm": report.max_slack * 1000,
            "ecu_most_iterations": loop.iterations if loop else None,
            "ecu_clipped_values": loop.clipped if loop else None,
            "ecu_held_commands": loop.held if loop else None,
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
        series=Series(road_input.series, dict(zip(METRIC_SIGNALS, signals, strict=True))),
    )


def _by_window(
    values: SectionValues, loads: FloatArray, windows: Windows, road_input: RoadInput, vehicle: Vehicle
) -> dict[str, dict[str, dict[str, float]]]:
    """RMS and peak of METRIC_SIGNALS in WINDOWS."""
    durations = windows.ends[:, 1] - windows.ends[:, 0]
    rough, bump, _ = squares = values.integrals.T
    means = rough / durations[0], bump / durations[1], squares.sum(axis=0) / durations.sum()
    peaks = values.peaks
    kinks = _peaks_at_kinks(loads, values.highest[_LOADS], peaks[:, _LOADS], vehicle, windows, road_input)
    peaks[:, _LOADS] = np.maximum(peaks[:, _LOADS], kinks)
    return {
        window: {
            signal: {"rms": rms, "peak": peak}
            for signal, rms, peak in zip(METRIC_SIGNALS, np.sqrt(mean).tolist(), highest.tolist(), strict=True)
        }
        for window, mean, highest in zip(WINDOWS, means, (*peaks[:2], peaks.max(axis=0)), strict=True)
    }


def rms_between(series: Series, drive: Drive, stretches: Sequence[tuple[float, float]]) -> dict[str, float]:
    """RMS of METRIC_SIGNALS over all the time in which the front axle is in one of these stretches of the road.

    Args:
        series: Of a run; as exact as its metrics, whose windows `stretches` may differ from.
        drive: How that run drove.
        stretches: First and last position [m], from x = 0 to the road's end at most; none overlap.

    Raises:
        ValueError: A stretch is empty, or the run does not reach its end.
    """
    time = series["time"]
    fine_step = float(time[-1]) / (len(time) - 1)
    table = np.ascontiguousarray([series.columns(signal) for signal in METRIC_SIGNALS])
    times = [(drive.time_at(first), drive.time_at(last)) for first, last in stretches]
    ends = section_ends([(first / fine_step, last / fine_step) for first, last in times])
    durations = ends[:, 1] - ends[:, 0]
    if (durations <= 0).any() or ends.min() < 0 or ends.max() > (table.shape[1] - 1) * table.shape[2]:
        raise ValueError("A stretch ends behind its beginning and lies on the road that was driven")
    means = over_sections(table, _INTEGRANDS, ends).integrals.sum(axis=1) / durations.sum()
    return dict(zip(METRIC_SIGNALS, np.sqrt(means).tolist(), strict=True))


def _peaks_at_kinks(
    loads: FloatArray,
    highest: FloatArray,
    peaks: FloatArray,
    vehicle: Vehicle,
    windows: Windows,
    road_input: RoadInput,
) -> FloatArray:
    """Largest magnitude of the tyre loads at kinks of the road between two samples, in each section (sections, 2).

    There a load deviates from the line between the samples by the tyre's stiffness times the height of the kink. Only
    kinks that may raise a peak count: under commands whose samples come near it.

    Args:
        loads: Front and rear (2, fine steps of a command + 1, commands) [N].
        highest: Their largest magnitude under each command (2, commands) [N].
        peaks: Their largest magnitude in each section, at samples (sections, 2) [N].
        vehicle: The real one.
        windows: Where the sections lie.
        road_input: The road under the axles.
    """
    tyres = vehicle.front_tyre_stiffness, vehicle.rear_tyre_stiffness
    beside, on_bump = road_input.surface.slope_range()
    most_rise = max(tyres) * np.array([beside, on_bump, beside]) * windows.step_distance / 4
    near = np.ones(highest.shape, dtype=np.bool_)
    for inner, peak, rise in zip(windows.inner, peaks, most_rise, strict=True):
        near[:, inner] = highest[:, inner] >= peak[:, np.newaxis] - rise
    kinks, command = _kinks_under(np.flatnonzero(near), windows.first_kink)
    samples, commands = loads.shape[1:]
    met = road_input.drive.kinks
    axle, step, share = met.axle(kinks), met.step[kinks] % (samples - 1), met.share[kinks]
    sample = (axle * (samples - 1) + step) * commands + command
    before, after = loads.take(sample), loads.take(sample + commands)
    values = before + share * (after - before) + np.take(tyres, axle) * road_input.above_chord(kinks)
    if vehicle.tyre_lift_off:
        values = np.maximum(values, -np.take(vehicle.static_loads, axle))
    values = np.abs(values)
    ends = kinks.searchsorted(windows.kink_ends).tolist()
    return np.array([[values[first:last].max(initial=0) for first, last in axle] for axle in ends]).T


def _kinks_under(commands: NDArray[np.intp], first_kink: NDArray[np.intp]) -> tuple[NDArray[np.intp], NDArray[np.intp]]:
    """The kinks met under some commands, and the command each of them is met under; both as in `Windows.first_kink`."""
    first = first_kink[commands]
    count = first_kink[commands + 1] - first
    command = np.repeat(np.arange(len(commands)), count)
    number = np.arange(len(command)) - (count.cumsum() - count)[command]
    return first[command] + number, commands[command]


def _power(forces: FloatArray, speeds: FloatArray, windows: Windows) -> dict[str, float]:
    """Mean and largest |u·ḋ| summed over both axles [W]."""
    mean = peak = 0.0
    if forces.any():
        each = forces * speeds
        power = np.abs(each, out=each).sum(axis=0, keepdims=True)
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
    target = scenario.speed.target_speed_kmh * KMH
    if target >= scenario.speed.initial_speed_kmh * KMH:
        return True
    return abs(arrival - target) <= TARGET_BAND + 1e-9
