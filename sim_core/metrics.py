"""Metrics of a run: RMS and peak per window as the paper's tables, and what the field expects beside them.

A record has a column for each held command, with the values at both its ends: forces jump where a command changes, and
so do the accelerations. Mean squares are trapezoids within the columns; windows end between samples, where the drive
does.
"""

from collections.abc import Sequence
from math import sqrt

import numpy as np

from sim_core.arrays import FloatArray
from sim_core.car.plant import RECORDED
from sim_core.catalogue import METRIC_SIGNALS, WINDOWS
from sim_core.comfort import vibration_dose, weighted
from sim_core.drive.sampling import RoadInput
from sim_core.drive.speed_profile import KMH, TARGET_BAND, Drive
from sim_core.recording import Recording
from sim_core.result import Series, Span, StrategyResult
from sim_core.scenario import Scenario, Vehicle
from sim_core.strategies import SpeedPolicy, Strategy, SuspensionPolicy
from sim_core.windows import SNAP, Sections, Windows, sections_of, windows_of

_ROW = {signal: row for row, signal in enumerate(METRIC_SIGNALS)}
_SPEEDS = len(RECORDED) - len(METRIC_SIGNALS)  # those of the deflections come before them
_JUMPING = slice(2)  # the accelerations: they jump with the force and are steep lines in between
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
    metrics = _by_window(signals, windows, road_input, scenario.real_vehicle)

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
            **_airborne(signals[_LOADS], windows, static),
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
    table: FloatArray, windows: Windows, road_input: RoadInput, vehicle: Vehicle
) -> dict[str, dict[str, dict[str, float]]]:
    """RMS and peak of METRIC_SIGNALS in WINDOWS."""
    durations = windows.sections.durations
    rough, bump, _ = squares = _squares(table, windows.sections).T
    means = rough / durations[0], bump / durations[1], squares.sum(axis=0) / durations.sum()
    highest = np.maximum(table.max(axis=1), -table.min(axis=1))
    peaks = _peaks(table, highest, windows)
    kinks = _peaks_at_kinks(table[_LOADS], highest[_LOADS], peaks[:, _LOADS], vehicle, windows, road_input)
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
    table = np.stack([series.columns(signal) for signal in METRIC_SIGNALS])
    fine, commands = table.shape[1] - 1, table.shape[2]
    spans = [(drive.time_at(first) / fine_step, drive.time_at(last) / fine_step) for first, last in stretches]
    if any(not 0 <= first < last <= fine * commands + SNAP for first, last in spans):
        raise ValueError("A stretch ends behind its beginning and lies on the road that was driven")
    sections = sections_of(spans, fine)
    means = _squares(table, sections).sum(axis=1) / sections.durations.sum()
    return dict(zip(METRIC_SIGNALS, np.sqrt(means).tolist(), strict=True))


def _squares(table: FloatArray, sections: Sections) -> FloatArray:
    """The square of each of METRIC_SIGNALS, integrated over each section (8, sections), in fine steps."""
    squares = _integrals(table, table, sections)
    low, high = table[_JUMPING, :-1], table[_JUMPING, 1:]  # straight in between: the square's mean is (a² + ab + b²)/3
    products = np.stack(
        [np.vecdot(low[:, :, inner], high[:, :, inner]).sum(axis=1) for inner in sections.inner], axis=1
    )
    at_edges = (low[:, :, sections.edges] * high[:, :, sections.edges]).reshape(len(low), -1)
    squares[_JUMPING] += (products + at_edges @ sections.shares.T - squares[_JUMPING]) / 3
    return squares


def _integrals(a: FloatArray, b: FloatArray, sections: Sections) -> FloatArray:
    """The product of each signal in `a` with that in `b`, integrated by trapezoids over each section.

    Args:
        a: Signals (signals, fine steps of a command + 1, commands).
        b: As many.
        sections: Over which.

    Returns:
        In fine steps (signals, sections).
    """
    samples = np.stack([np.vecdot(a[:, :, inner], b[:, :, inner]) for inner in sections.inner], axis=1)
    whole = samples.sum(axis=2) - (samples[:, :, 0] + samples[:, :, -1]) / 2
    at_edges = a[:, :, sections.edges] * b[:, :, sections.edges]
    lines = (at_edges[:, :-1] + at_edges[:, 1:]) / 2
    return np.asarray(whole + lines.reshape(len(a), -1) @ sections.shares.T)


def _peaks(table: FloatArray, highest: FloatArray, windows: Windows) -> FloatArray:
    """Largest magnitude of each signal in each section (sections, signals), at samples and at its ends.

    Args:
        table: Signals (signals, fine steps of a command + 1, commands).
        highest: Their largest magnitude under each command (signals, commands).
        windows: Where the sections lie.
    """
    sections = windows.sections
    inner = [highest[:, commands].max(axis=1, initial=0) for commands in sections.inner]
    at_edges = table[:, :, sections.edges].reshape(len(table), -1)
    edges = [np.abs(at_edges @ weights).max(axis=1, initial=0) for weights in windows.edge_values]
    return np.maximum(inner, edges)


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
    for inner, peak, rise in zip(windows.sections.inner, peaks, most_rise, strict=True):
        near[:, inner] = highest[:, inner] >= peak[:, np.newaxis] - rise
    kinks = np.flatnonzero(near.take(windows.kink_command))
    samples, commands = loads.shape[1:]
    met = road_input.drive.kinks
    axle, step, share = met.axle(kinks), met.step[kinks] % (samples - 1), met.share[kinks]
    sample = (axle * (samples - 1) + step) * commands + windows.kink_command[kinks]
    before, after = loads.take(sample), loads.take(sample + commands)
    values = before + share * (after - before) + np.take(tyres, axle) * road_input.above_chord(kinks)
    if vehicle.tyre_lift_off:
        values = np.maximum(values, -np.take(vehicle.static_loads, axle))
    values = np.abs(values)
    ends = kinks.searchsorted(windows.kink_ends).tolist()
    return np.array([[values[first:last].max(initial=0) for first, last in axle] for axle in ends]).T


def _power(forces: FloatArray, speeds: FloatArray, windows: Windows) -> dict[str, float]:
    """Mean and largest |u·ḋ| summed over both axles [W]."""
    mean = peak = 0.0
    if forces.any():
        front, rear = np.abs(forces * speeds)
        power = (front + rear)[np.newaxis]
        mean = float(_integrals(power, np.ones_like(power), windows.sections).sum() / windows.sections.durations.sum())
        peak = float(_peaks(power, power.max(axis=1), windows).max())
    return {"actuator_mean_power": mean, "actuator_peak_power": peak}


def _airborne(loads: FloatArray, windows: Windows, static: tuple[float, float]) -> dict[str, float]:
    """Time with a tyre off the road, or pulling on it where it cannot lift off [ms]."""
    keys = "airborne_ms", "front_airborne_ms", "rear_airborne_ms"
    unloaded = loads <= -np.reshape(static, (2, 1, 1))
    if not unloaded.any():
        return dict.fromkeys(keys, 0.0)
    front, rear = unloaded
    samples = np.array([front | rear, front, rear], dtype=np.float64)
    milliseconds = _integrals(samples, samples, windows.sections).sum(axis=1) * (windows.fine_step * 1000)
    return dict(zip(keys, milliseconds.tolist(), strict=True))


def _target_reached(scenario: Scenario, arrival: float) -> bool:
    """Arrival within the band around the target; a target at or above the initial speed asks for nothing."""
    target = scenario.speed.target_speed_kmh * KMH
    if target >= scenario.speed.initial_speed_kmh * KMH:
        return True
    return abs(arrival - target) <= TARGET_BAND + 1e-9
