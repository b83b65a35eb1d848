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
from sim_core.scenario import Scenario
from sim_core.strategies import SpeedPolicy, Strategy, SuspensionPolicy
from sim_core.windows import SNAP, Windows, segments_of, weights_of, windows_of

_ROW = {signal: row for row, signal in enumerate(RECORDED)}  # the first are METRIC_SIGNALS
_JUMPING = ("body_acceleration", "pitch_acceleration")  # with the force; steep lines in between
_LOAD_ROWS = _ROW["front_tyre_load"], _ROW["rear_tyre_load"]
_LOADS = slice(_LOAD_ROWS[0], _LOAD_ROWS[1] + 1)


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
    bump_end = bump.start + bump.width + scenario.vehicle.wheelbase
    table = recording.table
    places = windows_of(road_input.drive, drive, bump.start, bump_end, scenario.road.length, *table.shape[1:])
    tyres = scenario.real_vehicle.front_tyre_stiffness, scenario.real_vehicle.rear_tyre_stiffness
    metrics = _by_window(table[: len(METRIC_SIGNALS)], places, road_input, tyres)

    arrival = float(drive.at(np.array(drive.time_at(bump.start)))[1])
    static = scenario.real_vehicle.static_loads
    planned = strategy.speed is SpeedPolicy.PLANNED
    actuated = strategy.suspension is not SuspensionPolicy.PASSIVE
    rough, whole = metrics["rough_road"], metrics["whole"]
    travel = max(whole["front_deflection"]["peak"], whole["rear_deflection"]["peak"])
    power = _power(table)
    filtered = weighted(table[_ROW["body_acceleration"]], road_input.fine_step)[: len(road_input.series["time"])]
    return StrategyResult(
        strategy=strategy.id,
        metrics=metrics,
        comfort={
            "weighted_rms": sqrt(float(filtered @ filtered) / len(filtered)),
            "vibration_dose": vibration_dose(filtered, road_input.fine_step),
            "front_dynamic_load_coefficient": rough["front_tyre_load"]["rms"] / static[0],
            "rear_dynamic_load_coefficient": rough["rear_tyre_load"]["rms"] / static[1],
            "actuator_mean_power": float(power.ravel() @ places.weights[-1]),
            "actuator_peak_power": float(max(power[block].max(initial=0) for part in places.within for block in part)),
        },
        events={
            **_airborne(table, places, static),
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
        series=Series(road_input.series, dict(zip(RECORDED, table, strict=True))),
    )


def _by_window(
    table: FloatArray, places: Windows, road_input: RoadInput, tyres: tuple[float, float]
) -> dict[str, dict[str, dict[str, float]]]:
    """RMS and peak of METRIC_SIGNALS in WINDOWS."""
    samples = table.reshape(len(table), -1)
    rms = _rms(table, places.weights, places.segments)
    peaks = [_peaks(table, part) for part in places.within]
    _add_kinks(peaks, table[_LOADS], tyres, places, road_input)
    following = table.shape[2]  # the next sample of a command
    arrival, leaving, end = (
        np.abs(samples[:, i] + share * (samples[:, i + following] - samples[:, i])) if share else np.zeros(len(samples))
        for i, share in places.ends
    )
    rough, bump = np.maximum(peaks[0], arrival), np.maximum.reduce([peaks[1], arrival, leaving])
    by_window = rough, bump, np.maximum.reduce([rough, bump, peaks[2], end])
    return {
        window: {
            signal: {"rms": float(rms[_ROW[signal], i]), "peak": float(by_window[i][_ROW[signal]])}
            for signal in METRIC_SIGNALS
        }
        for i, window in enumerate(WINDOWS)
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
    segments = segments_of(spans, fine, commands)[np.newaxis]
    rms = _rms(table, weights_of(segments).reshape(1, -1), segments.reshape(1, -1))
    return {signal: float(rms[_ROW[signal], 0]) for signal in METRIC_SIGNALS}


def _rms(table: FloatArray, weights: FloatArray, segments: FloatArray) -> FloatArray:
    """RMS of METRIC_SIGNALS in each window (8, windows)."""
    samples = table.reshape(len(table), -1)
    squares = (samples * samples) @ weights.T
    for signal in _JUMPING:  # straight between samples: a trapezoid's (a² + b²)/2 is (b - a)²/6 more than their mean
        change = np.diff(table[_ROW[signal]], axis=0).ravel()
        squares[_ROW[signal]] -= segments @ (change * change) / 6
    return np.asarray(np.sqrt(np.maximum(squares, 0)))


def _peaks(table: FloatArray, blocks: tuple[tuple[slice, slice], ...]) -> FloatArray:
    """Largest magnitude of each signal in those blocks (signals,)."""
    found = np.zeros(len(table))
    for fine, commands in blocks:
        part = table[:, fine, commands]
        np.maximum(found, part.max(axis=(1, 2), initial=0), out=found)
        np.maximum(found, -part.min(axis=(1, 2), initial=0), out=found)
    return found


def _add_kinks(
    peaks: Sequence[FloatArray],
    loads: FloatArray,
    tyres: tuple[float, float],
    places: Windows,
    road_input: RoadInput,
) -> None:
    """Raise the peaks of the tyre loads to their values at kinks of the road between two samples.

    There a load deviates from the line between the samples by the tyre's stiffness times the height of the kink.

    Args:
        peaks: Of METRIC_SIGNALS at the samples, in each of Windows.within.
        loads: Front and rear (2, fine steps of a command + 1, commands) [N].
        tyres: Stiffness, front and rear [N/m].
        places: Where the windows lie.
        road_input: The road under the axles.
    """
    kinks, near = road_input.drive.kinks, _kinks_near_peaks(peaks, loads, tyres, places, road_input)
    axles, step = kinks.axle[near], kinks.step[near] % (loads.shape[1] - 1)
    command = places.kink_command[near] % loads.shape[2]
    share, height = road_input.at_kinks(near)
    before, after = loads[axles, step, command], loads[axles, step + 1, command]
    values = np.abs(before + share * (after - before) + np.take(tyres, axles) * height)
    for row, axle in zip(_LOAD_ROWS, places.kinks, strict=True):
        for peak, part in zip(peaks, axle, strict=True):
            first, last = near.searchsorted((part.start, part.stop))
            peak[row] = max(peak[row], values[first:last].max(initial=0))


def _kinks_near_peaks(
    peaks: Sequence[FloatArray],
    loads: FloatArray,
    tyres: tuple[float, float],
    places: Windows,
    road_input: RoadInput,
) -> NDArray[np.intp]:
    """Indices of the kinks that may raise a peak: under commands whose load comes near it, and those of the bump."""
    kinks, bump, margin = road_input.drive.kinks, road_input.surface.bump, road_input.drive.max_step_distance
    most_rise = max(tyres) * road_input.surface.max_chord_deviation(margin)
    highest = np.maximum(loads.max(axis=1), -loads.min(axis=1)).take(places.kink_command)
    near = np.zeros(len(highest), dtype=bool)
    for row, axle in zip(_LOAD_ROWS, places.kinks, strict=True):
        for peak, part in zip(peaks, axle, strict=True):
            near[part] |= highest[part] >= peak[row] - most_rise
    for part in (slice(kinks.rear), slice(kinks.rear, None)):
        first, last = kinks.position[part].searchsorted((bump.start - margin, bump.start + bump.width + margin))
        near[part][first:last] = True
    return np.flatnonzero(near)


def _power(table: FloatArray) -> FloatArray:
    """|u·ḋ| summed over both axles (fine steps of a command + 1, commands) [W]."""
    front, rear = (
        np.abs(table[_ROW[f"{axle}_force"]] * table[_ROW[f"{axle}_deflection_speed"]]) for axle in ("front", "rear")
    )
    return np.asarray(front + rear)


def _airborne(table: FloatArray, places: Windows, static: tuple[float, float]) -> dict[str, float]:
    """Time with a tyre pulling on the road, which only the linear model can [ms]."""
    loads = table[_LOADS].reshape(2, -1)
    if all(load.min() >= -rest for load, rest in zip(loads, static, strict=True)):
        return {"airborne_ms": 0.0, "front_airborne_ms": 0.0, "rear_airborne_ms": 0.0}
    front, rear = (load < -rest for load, rest in zip(loads, static, strict=True))
    milliseconds = places.weights[-1] * (places.duration * 1000)
    return {
        "airborne_ms": float((front | rear) @ milliseconds),
        "front_airborne_ms": float(front @ milliseconds),
        "rear_airborne_ms": float(rear @ milliseconds),
    }


def _target_reached(scenario: Scenario, arrival: float) -> bool:
    """Arrival within the band around the target; a target at or above the initial speed asks for nothing."""
    target = scenario.speed.target_speed_kmh * KMH
    if target >= scenario.speed.initial_speed_kmh * KMH:
        return True
    return abs(arrival - target) <= TARGET_BAND + 1e-9
