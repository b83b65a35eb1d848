"""Metrics of a run: RMS and peak per window as the paper's tables, and what the field expects beside them.

A record has a row for each held command, with the values at both its ends: forces jump where a command changes, and so
do the accelerations. Mean squares are trapezoids within the rows; windows end between samples, where the drive does.
"""

from dataclasses import dataclass
from itertools import pairwise
from math import ceil, floor, sqrt

import numpy as np
from numpy.typing import NDArray

from sim_core.caching import cached_up_to
from sim_core.catalogue import METRIC_SIGNALS, WINDOWS
from sim_core.comfort import vibration_dose, weighted
from sim_core.drive.sampling import AxlePath, RoadInput, SampledDrive
from sim_core.drive.speed_profile import KMH, TARGET_BAND, Drive
from sim_core.recording import RECORDED_SIGNALS, Recording
from sim_core.result import FloatArray, Series, Span, StrategyResult
from sim_core.scenario import Scenario
from sim_core.strategies import SpeedPolicy, Strategy, SuspensionPolicy

_ROW = {signal: row for row, signal in enumerate(RECORDED_SIGNALS)}
_JUMPING = ("body_acceleration", "pitch_acceleration")  # with the force; steep lines in between
_TYRE_LOADS = ("front_tyre_load", "rear_tyre_load")
_SNAP = 1e-6  # of a fine step: a window that ends so near to a sample ends there
_NEAR = 1e-3  # of a fine step: a kink met so near to a window's end is met at it


@dataclass(frozen=True, slots=True, eq=False, kw_only=True)
class AxleKinks:
    """The sample before each kink of an axle's road (k,), and which are met on rough road, bump and after."""

    samples: NDArray[np.intp]
    within: tuple[slice, ...]


@dataclass(frozen=True, slots=True, eq=False, kw_only=True)
class Windows:
    """Where a record's windows lie in the samples of its rows put end to end.

    Attributes:
        weights: Share of each sample in a window's mean (windows, samples), by trapezoids.
        segments: Share of the line from each sample to the next in the same (windows, samples - 1); 0 across a jump.
        within: The samples of the rough road, of the bump, and of what follows it.
        ends: Of the windows' ends between two samples, the one before and how far on to the next.
        kinks: Where each axle meets the kinks of its road.
        duration: Of the whole record [s].
    """

    weights: FloatArray
    segments: FloatArray
    within: tuple[slice, ...]
    ends: tuple[tuple[int, float], ...]
    kinks: tuple[AxleKinks, ...]
    duration: float


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
    rows, per_row = recording.table.shape[1:]
    places = _windows(road_input.drive, drive, bump.start, bump_end, scenario.road.length, rows, per_row)
    samples = recording.table.reshape(len(RECORDED_SIGNALS), -1)
    tyres = scenario.real_vehicle.front_tyre_stiffness, scenario.real_vehicle.rear_tyre_stiffness
    metrics = _by_window(samples, places, road_input, tyres)

    arrival = float(drive.at(np.array(drive.time_at(bump.start)))[1])
    static = scenario.real_vehicle.static_loads
    planned = strategy.speed is SpeedPolicy.PLANNED
    actuated = strategy.suspension is not SuspensionPolicy.PASSIVE
    rough, whole = metrics["rough_road"], metrics["whole"]
    travel = max(whole["front_deflection"]["peak"], whole["rear_deflection"]["peak"])
    power = _power(samples) if actuated else np.zeros(1)
    filtered = weighted(recording.table[_ROW["body_acceleration"]], road_input.fine_step)[
        : len(road_input.series["time"])
    ]
    return StrategyResult(
        strategy=strategy.id,
        metrics=metrics,
        comfort={
            "weighted_rms": sqrt(float(filtered @ filtered) / len(filtered)),
            "vibration_dose": vibration_dose(filtered, road_input.fine_step),
            "front_dynamic_load_coefficient": rough["front_tyre_load"]["rms"] / static[0],
            "rear_dynamic_load_coefficient": rough["rear_tyre_load"]["rms"] / static[1],
            "actuator_mean_power": float(power @ places.weights[-1]) if actuated else 0.0,
            "actuator_peak_power": float(power[: places.within[-1].stop].max()),
        },
        events={
            **_airborne(samples, places, static),
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
        series=Series(road_input.series, dict(zip(RECORDED_SIGNALS, recording.table, strict=True))),
    )


def _by_window(
    samples: FloatArray, places: Windows, road_input: RoadInput, tyres: tuple[float, float]
) -> dict[str, dict[str, dict[str, float]]]:
    """RMS and peak of METRIC_SIGNALS in WINDOWS, from samples (10, n)."""
    squares = np.stack([places.weights @ (values * values) for values in samples])
    for signal in _JUMPING:  # straight between samples: a trapezoid's (a² + b²)/2 is (b - a)²/6 more than their mean
        change = np.diff(samples[_ROW[signal]])
        squares[_ROW[signal]] -= places.segments @ (change * change) / 6
    rms = np.sqrt(np.maximum(squares, 0))
    peaks = [np.maximum(part.max(axis=1, initial=0), -part.min(axis=1, initial=0)) for part in _parts(samples, places)]
    for axle, signal in enumerate(_TYRE_LOADS):
        row, at, share = _ROW[signal], places.kinks[axle].samples, road_input.drive.axles[axle].kink_share
        before = samples[row].take(at)
        there = before + share * (samples[row].take(at + 1) - before) + tyres[axle] * road_input.kink_rise[axle]
        for peak, part in zip(peaks, places.kinks[axle].within, strict=True):
            peak[row] = max(peak[row], there[part].max(initial=0), -there[part].min(initial=0))
    arrival, leaving, end = (
        np.abs(samples[:, i] + share * (samples[:, i + 1] - samples[:, i])) if share else np.zeros(len(samples))
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


def _parts(samples: FloatArray, places: Windows) -> list[FloatArray]:
    return [samples[:, part] for part in places.within]


@cached_up_to(16)
def _windows(
    sampled: SampledDrive, drive: Drive, bump_start: float, bump_end: float, length: float, rows: int, per_row: int
) -> Windows:
    """The windows of a record with so many rows of so many samples."""
    h, fine = sampled.fine_step, per_row - 1
    arrival, leaving, end = (drive.time_at(place) / h for place in (bump_start, min(bump_end, length), length))
    edges = [round(place) if abs(place - round(place)) < _SNAP else place for place in (0.0, arrival, leaving, end)]
    spans = list(pairwise(edges))

    steps = np.arange(rows * fine)
    segments = np.zeros((len(WINDOWS), rows, per_row))
    for i, (first, last) in enumerate([spans[0], spans[1], (edges[0], edges[-1])]):
        share = np.clip(np.minimum(steps + 1, last) - np.maximum(steps, first), 0.0, 1.0) / (last - first)
        segments[i, :, :-1] = share.reshape(rows, fine)
    weights = segments / 2
    weights[:, :, 1:] += segments[:, :, :-1] / 2

    def sample(step: int) -> int:
        return step // fine * per_row + step % fine

    def first_sample(place: float) -> int:
        return sample(ceil(place))

    def stop_sample(place: float) -> int:
        """One past the last sample up to a place; where a row ends there, that row's last."""
        whole = floor(place)
        return sample(whole) if whole == place and whole % fine == 0 else sample(whole) + 1

    def axle_kinks(axle: AxlePath) -> AxleKinks:
        met = axle.kink_step + axle.kink_share
        inside = (slice(*met.searchsorted((first - _NEAR, last + _NEAR))) for first, last in spans)
        return AxleKinks(samples=axle.kink_step // fine * per_row + axle.kink_step % fine, within=tuple(inside))

    return Windows(
        weights=weights.reshape(len(WINDOWS), -1),
        segments=segments.reshape(len(WINDOWS), -1)[:, :-1],
        within=tuple(slice(first_sample(first), stop_sample(last)) for first, last in spans),
        ends=tuple((sample(floor(place)), place - floor(place)) for place in edges[1:]),
        kinks=tuple(axle_kinks(axle) for axle in sampled.axles),
        duration=(edges[-1] - edges[0]) * h,
    )


def _power(samples: FloatArray) -> FloatArray:
    """|u·ḋ| summed over both axles (n,) [W]."""
    front, rear = (
        np.abs(samples[_ROW[f"{axle}_force"]] * samples[_ROW[f"{axle}_deflection_speed"]]) for axle in ("front", "rear")
    )
    return np.asarray(front + rear)


def _airborne(samples: FloatArray, places: Windows, static: tuple[float, float]) -> dict[str, float]:
    """Time with a tyre pulling on the road, which only the linear model can [ms]."""
    loads = [samples[_ROW[signal]] for signal in _TYRE_LOADS]
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
