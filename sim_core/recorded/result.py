"""The result of a recorded drive over a scenario's road: what `simulate` returns for a simulated one."""

from collections.abc import Callable, Mapping, Sequence
from dataclasses import replace
from itertools import pairwise
from math import isnan, nan

import numpy as np
from numpy.typing import NDArray

from sim_core.arrays import FloatArray
from sim_core.blas import single_threaded
from sim_core.catalogue import EVENTS, METRIC_SIGNALS, REFERENCES, SIGNALS, WHOLE, WINDOWS
from sim_core.errors import RefusedError
from sim_core.metrics.definition import ByWindow, comfort_metrics, drive_events, window_metrics
from sim_core.metrics.sampled import TimeSpan, sampled_sums
from sim_core.recorded.kink_peaks import peaks_at_kinks
from sim_core.recorded.offsets import describe_offsets, without_gravity
from sim_core.recorded.placing import PlacedRecording, place_recording
from sim_core.recorded.track import track_of
from sim_core.result import RecordingReport, Series, StrategyResult, no_columns
from sim_core.scenario import Scenario
from sim_core.scenario.parts import KMH
from sim_core.scenario.recorded import LONGEST, PREFIX, RecordedDrive
from sim_core.simulate import simulate
from sim_core.speed.stages import make_spans

END_TOLERANCE = 0.5  # what a recording may lack at either end of the road [m]


@single_threaded
def recorded_result(
    scenario: Scenario, drive: RecordedDrive, drives: Callable[[Scenario, str], StrategyResult] = simulate
) -> StrategyResult:
    """Return what a recording says over a scenario's road, by the metrics of a simulated run.

    It is placed on the road by its likeness to the strategies' simulated drives (`placing.place_recording`); where no
    position matches one better than chance, its own distance is used as the position. A metric whose signal is missing
    or does not cover its window is NaN. `recording` of the result says what was done and what is missing.

    Args:
        scenario: Whose road, car and windows; its measured road's heights with it.
        drive: The recording.
        drives: Simulates what it may be like; a drive that raises TooExpensiveError is left out, and a note says so.

    Raises:
        RefusedError: It has no part of the scenario's road, too few samples there, or its car does not move.
    """
    recorded = drive.signals()
    signals = without_gravity(recorded)
    track = track_of(signals, scenario.speed.initial)
    length = float(np.ptp(track.distance))
    if not length:
        raise RefusedError("The car does not move in this recording")
    if length > LONGEST:
        raise RefusedError(f"The recording is {length:.0f} m long, and the most is {LONGEST:g}: cut it to this road")
    placed = place_recording(scenario, lambda name: drives(scenario, name), signals, track)
    signals |= {key: -signals[key] for key in placed.inverted}
    position, time = placed.position, track.time
    if track.clocked and placed.placement is not None:
        time = time * placed.placement.scale
    speed = float(position[-1] - position[0]) / float(time[-1] - time[0])
    time = time - (float(np.interp(0.0, position, time)) if position[0] <= 0 else time[0] - position[0] / speed)
    if position[-1] <= 0 or position[0] >= scenario.road.length:
        raise RefusedError("The recording has no part of this road: its distance lies elsewhere")
    if np.count_nonzero(_on_road(position, scenario)) < 2:
        raise RefusedError("The recording has too few samples on this road")
    # Between samples too: the ends of the road rarely are samples.
    whole = {key: signals.get(key, np.full(len(time), nan)) for key in SIGNALS} | {"time": time, "position": position}
    result, notes = _evaluated(scenario, whole, f"{PREFIX}{drive.id}", timed=track.timed)
    notes = [*track.notes, *describe_offsets(recorded, float(np.ptp(time))), *placed.notes, *notes]
    return replace(result, recording=_report(placed, scenario, whole, drive.samples, notes))


def _report(
    placed: PlacedRecording, scenario: Scenario, signals: Mapping[str, FloatArray], samples: int, notes: Sequence[str]
) -> RecordingReport:
    names = "offset", "scale", "likeness", "reference"
    position = signals["position"]
    return RecordingReport(
        **{name: getattr(placed.placement, name, None) for name in names},
        samples=samples,
        start=max(0.0, float(position[0])),
        end=min(scenario.road.length, float(position[-1])),
        missing=_missing(signals),
        notes=tuple(notes),
    )


def _missing(signals: Mapping[str, FloatArray]) -> tuple[str, ...]:
    """Return the signals that have no values."""
    return tuple(key for key in METRIC_SIGNALS if np.isnan(signals[key]).all())


def _evaluated(
    scenario: Scenario, signals: Mapping[str, FloatArray], strategy: str, *, timed: bool
) -> tuple[StrategyResult, list[str]]:
    """Return the result, and what to say of metrics that are missing or known less well than a run's."""
    road, position, time, vehicle = scenario.road, signals["position"], signals["time"], scenario.real_vehicle
    edges = [0.0, scenario.bump_start, min(scenario.bump_left, road.length), road.length]
    ends = np.clip(edges, position[0], position[-1]).tolist()
    sections = [_times(start, stop, position, time) for start, stop in pairwise(edges)]
    static = vehicle.static_loads
    sums = sampled_sums(signals, sections, static, vehicle.stop_clearances)
    at_kinks = peaks_at_kinks(scenario, signals, sections)
    if at_kinks is not None:
        loads = [METRIC_SIGNALS.index(f"{axle}_tyre_load") for axle in ("front", "rear")]
        sums.peaks[:, loads] = np.maximum(sums.peaks[:, loads], at_kinks)
    metrics = window_metrics(sums)
    events: dict[str, float | bool | None] = dict.fromkeys(EVENTS, None)
    arrival = _speed_at(road.bump.start, signals) if timed and road.has_bump else nan
    on_road = _on_road(position, scenario)
    result = StrategyResult(
        strategy=strategy,
        scenario=scenario,
        metrics=metrics,
        comfort=comfort_metrics(sums, metrics, scenario),
        events=events | drive_events(sums, metrics, scenario),
        reference={
            **dict.fromkeys(REFERENCES),
            "front_static_load": static[0],
            "rear_static_load": static[1],
            "deflection_limit": scenario.mpc.deflection_limit,
        },
        stages=make_spans(("cruise", "bump", "cruise"), ends, np.interp(ends, position, time).tolist()),
        travel_time=sum(sums.durations) if timed else nan,
        arrival_speed_kmh=arrival / KMH,
        series=Series({key: values[on_road] for key, values in signals.items()}, no_columns),
    )
    recorded = [sections[0] is not None, road.has_bump and sections[1] is not None, None not in sections]
    windows = [window for window, whole in zip(WINDOWS, recorded, strict=True) if whole]
    return result, _lacking(scenario, signals, metrics, windows, same_road=at_kinks is not None)


def _lacking(
    scenario: Scenario,
    signals: Mapping[str, FloatArray],
    metrics: ByWindow,
    windows: Sequence[str],
    *,
    same_road: bool,
) -> list[str]:
    """Say which metrics are missing although their windows were recorded, which windows were not, and why."""
    notes, missing, position = [], _missing(signals), signals["position"]
    if missing:
        notes.append(f"It has no {', '.join(_in_a_sentence(key) for key in missing)}: their metrics are missing")
    if WHOLE not in windows:
        part = f"{max(0.0, position[0]):.1f} to {min(position[-1], scenario.road.length):.1f} m"
        notes.append(
            f"It covers {part} of {scenario.road.length:g} m: metrics of windows that reach beyond are missing, and "
            "with the whole run those of comfort, events and travel time"
        )
    for key in METRIC_SIGNALS:
        gaps = [WINDOWS[window].label for window in windows if isnan(metrics[window][key]["rms"])]
        if gaps and key not in missing:
            notes.append(f"{SIGNALS[key].label} has gaps: it has no metrics in {', '.join(gaps)}")
    if not same_road and not {"front_tyre_load", "rear_tyre_load"} <= set(missing):
        notes.append("Peaks of tyre loads are those of its samples; a run's are between samples too")
    return notes


def _in_a_sentence(signal: str) -> str:
    """Return the label of a signal as it stands within a sentence."""
    label = SIGNALS[signal].label
    return label[0].lower() + label[1:]


def _times(start: float, stop: float, position: FloatArray, time: FloatArray) -> TimeSpan | None:
    """Return when a part of the road was driven [s]; None where it was not recorded, but for half a metre at an end."""
    first, last = max(start, float(position[0])), min(stop, float(position[-1]))
    if first > start + END_TOLERANCE or last < stop - END_TOLERANCE:
        return None
    begin, finish = np.interp([first, max(first, last)], position, time).tolist()
    return begin, finish


def _on_road(position: FloatArray, scenario: Scenario) -> NDArray[np.bool_]:
    """Check which samples lie on the scenario's road (m,)."""
    return (position >= 0) & (position <= scenario.road.length)


def _speed_at(place: float, signals: Mapping[str, FloatArray]) -> float:
    """Return the car's speed at a position [m/s], recorded or the mean over a metre; NaN where it was not recorded."""
    position, time, speed = (signals[key] for key in ("position", "time", "speed"))
    if not position[0] <= place <= position[-1]:
        return nan
    if np.isfinite(speed).any():
        return float(np.interp(place, position[np.isfinite(speed)], speed[np.isfinite(speed)]))
    around = np.clip([place - 0.5, place + 0.5], position[0], position[-1])
    begin, end = np.interp(around, position, time)
    return float((around[1] - around[0]) / (end - begin)) if end > begin else nan
