"""The result of a recorded drive over a scenario's road: what `simulate` returns for a simulated one."""

from collections.abc import Callable, Mapping
from dataclasses import dataclass, replace
from functools import partial
from itertools import pairwise
from math import nan

import numpy as np
from numpy.typing import NDArray

from sim_core.arrays import FloatArray
from sim_core.catalogue import EVENTS, METRIC_SIGNALS, SIGNALS, WINDOWS
from sim_core.errors import RidelabError
from sim_core.metrics.sampled import Span as Times
from sim_core.metrics.sampled import airborne_ms, comfort_metrics, stop_contact_ms, window_metrics
from sim_core.recorded.alignment import Placement, correlations, place
from sim_core.result import RecordingReport, Series, Span, StrategyResult, no_columns
from sim_core.scenario import Scenario
from sim_core.scenario.parts import KMH
from sim_core.scenario.recorded import LONGEST, PREFIX, REFERENCES, RecordedDrive
from sim_core.simulate import simulate
from sim_core.strategies import STRATEGIES

PLACED_BY = METRIC_SIGNALS[:6]  # not by the forces, in which laws differ most
GOOD_LIKENESS = 0.9  # no other one is tried
END_TOLERANCE = 0.5  # what a recording may lack at either end of the road [m]
SLOWEST = 0.1  # a recorded speed below counts as this where it gives the time [m/s]
OPPOSITE = -0.5  # correlation of a signal whose sign may be the other way round


@dataclass(frozen=True, slots=True, kw_only=True)
class _Track:
    """Distance (m,) [m] and time (m,) [s] of a recording, from anywhere; what they come from, in words."""

    distance: FloatArray
    time: FloatArray
    clocked: bool  # the distance is of the recorder's clock: a scale of the one is a scale of the other
    timed: bool  # the time, or the speed that gives it, was recorded
    notes: tuple[str, ...] = ()


def recorded_result(
    scenario: Scenario, drive: RecordedDrive, drives: Callable[[Scenario, str], StrategyResult] = simulate
) -> StrategyResult:
    """What a recording says over a scenario's road, by the metrics of a simulated run.

    It is placed on the road by its likeness to a quickly simulated drive (`alignment.place`); where it is like none,
    its distance is taken as the position. A metric whose signal is missing or does not cover its window is NaN. What
    was done and what is missing stands in `recording` of the result.

    Args:
        scenario: Whose road, car and windows; its measured road's heights with it.
        drive: The recording.
        drives: Simulates what it may be like.

    Raises:
        RidelabError: It has no part of the scenario's road.
    """
    signals = drive.signals()
    track = _track(signals, scenario.speed.initial)
    if (length := float(np.ptp(track.distance))) > LONGEST:
        raise RidelabError(f"The recording is {length:.0f} m long, and the most is {LONGEST:g}: cut it to this road")
    placement, reference, notes = _placed(partial(drives, scenario), signals, track)
    position = placement.offset + placement.scale * track.distance
    time = track.time * placement.scale if track.clocked else track.time
    speed = float(position[-1] - position[0]) / float(time[-1] - time[0])
    time = time - (float(np.interp(0.0, position, time)) if position[0] <= 0 else time[0] - position[0] / speed)
    if np.count_nonzero(_on_road(position, scenario)) < 2:
        raise RidelabError("The recording has no part of this road: its distance lies elsewhere")
    # Between samples too: the ends of the road rarely are samples.
    whole = {key: signals.get(key, np.full(len(time), nan)) for key in SIGNALS} | {"time": time, "position": position}
    start, end = float(position[0]), float(position[-1])
    missing = tuple(key for key in METRIC_SIGNALS if np.isnan(whole[key]).all())
    notes = (*track.notes, *notes, *_lacking(missing, start, end, scenario))
    report = RecordingReport(
        offset=None if reference is None else placement.offset,
        scale=None if reference is None else placement.scale,
        likeness=None if reference is None else placement.likeness,
        reference=reference,
        samples=drive.samples,
        start=max(0.0, start),
        end=min(scenario.road.length, end),
        missing=missing,
        notes=notes,
    )
    result = _evaluated(scenario, whole, f"{PREFIX}{drive.id}", timed=track.timed)
    return replace(result, recording=report)


def _track(signals: Mapping[str, FloatArray], initial: float) -> _Track:
    """From whichever of time, position and speed there are; `initial` is the scenario's speed [m/s]."""
    time, position, speed = (signals.get(key) for key in ("time", "position", "speed"))
    if time is not None and position is not None:
        return _Track(distance=position, time=time, clocked=False, timed=True)
    assumed = f"It is taken as driven at the initial speed, {initial / KMH:g} km/h: it has no speed"
    if speed is not None:
        order = np.arange(len(speed))
        there = np.isfinite(speed)
        speed = np.interp(order, order[there], speed[there])
    if time is not None:
        if speed is None:
            return _Track(distance=initial * time, time=time, clocked=True, timed=True, notes=(assumed,))
        distance = _integral(np.maximum(speed, 0.0), time)
        return _Track(
            distance=distance, time=time, clocked=True, timed=True, notes=("Its distance is its speed over its time",)
        )
    if position is None:
        raise RidelabError("A recording has a time or a distance")
    if speed is None:
        return _Track(distance=position, time=position / initial, clocked=True, timed=False, notes=(assumed,))
    each = 1 / np.maximum(speed, SLOWEST)
    time = _integral(each, position)
    return _Track(distance=position, time=time, clocked=True, timed=True, notes=("Its time follows from its speed",))


def _integral(values: FloatArray, over: FloatArray) -> FloatArray:
    """From the first sample on, by trapezoids (n,)."""
    return np.concatenate([[0.0], np.cumsum((values[1:] + values[:-1]) / 2 * np.diff(over))])


def _placed(
    drives: Callable[[str], StrategyResult], signals: Mapping[str, FloatArray], track: _Track
) -> tuple[Placement, str | None, tuple[str, ...]]:
    """Where it lies, the strategy it is like (None where it is like none), and what to say of it."""
    keys = [key for key in PLACED_BY if key in signals and np.nanmax(signals[key]) > np.nanmin(signals[key])]
    rows = np.array([signals[key] for key in keys])
    best: tuple[Placement, str] | None = None
    for name in REFERENCES if keys else ():
        try:
            series = drives(name).series
        except RidelabError:  # of a car that this law cannot hold
            continue
        simulated = np.array([series[key] for key in keys])
        placement = place(track.distance, rows, series["position"], simulated)
        if placement is not None and (best is None or placement.likeness > best[0].likeness):
            best, at = (placement, name), placement.offset + placement.scale * track.distance
            against = [
                key
                for key, value in zip(keys, correlations(at, rows, series["position"], simulated), strict=True)
                if value < OPPOSITE
            ]
        if best is not None and best[0].likeness >= GOOD_LIKENESS:
            break
    if best is None:
        said = "It was not placed: at no one place of this road is it like a simulated drive; its distance is taken"
        return Placement(offset=0.0, scale=1.0, likeness=nan), None, (f"{said} as the position",)
    placement, name = best
    notes = [
        f"It was placed where it is like {STRATEGIES[name].label} (correlation {placement.likeness:.2f}): position = "
        f"{placement.offset:.3f} m + {placement.scale:.5f} of its distance"
    ]
    notes += [
        f"{SIGNALS[key].label} moves against the simulated one: is its sign the other way round?" for key in against
    ]
    return placement, name, tuple(notes)


def _lacking(missing: tuple[str, ...], start: float, end: float, scenario: Scenario) -> list[str]:
    said = []
    if missing:
        said.append(f"It has no {', '.join(missing)}: their metrics are missing")
    if start > END_TOLERANCE or end < scenario.road.length - END_TOLERANCE:
        part = f"{max(0.0, start):.1f} to {min(end, scenario.road.length):.1f} m"
        said.append(f"It covers {part} of {scenario.road.length:g} m: metrics of windows that reach beyond are missing")
    return said


def _evaluated(scenario: Scenario, signals: Mapping[str, FloatArray], strategy: str, *, timed: bool) -> StrategyResult:
    road, position, time = scenario.road, signals["position"], signals["time"]
    bump_end, on_road = min(scenario.bump_left, road.length), _on_road(position, scenario)

    def times(start: float, stop: float) -> Times | None:
        first, last = max(start, float(position[0])), min(stop, float(position[-1]))
        if first > start + END_TOLERANCE or last < stop - END_TOLERANCE or last <= first:
            return None
        begin, finish = np.interp([first, last], position, time).tolist()
        return (begin, finish) if finish > begin else None

    ends = dict(
        zip(WINDOWS, ((0.0, scenario.bump_start), (scenario.bump_start, bump_end), (0.0, road.length)), strict=True)
    )
    spans = {name: times(*each) for name, each in ends.items()}
    metrics = window_metrics(signals, spans)
    static, whole = scenario.real_vehicle.static_loads, spans["whole"]
    travel = max(metrics["whole"][key]["peak"] for key in ("front_deflection", "rear_deflection"))
    arrival = _speed_at(road.bump.start, signals) if timed and road.has_bump else nan
    events: dict[str, float | bool | None] = dict.fromkeys(EVENTS, None)
    events |= airborne_ms(signals, whole, static)
    events["stop_contact_ms"] = stop_contact_ms(signals, whole, scenario.real_vehicle.bump_stop_clearance)
    if road.has_bump:
        events["bump_complete"] = spans["bump"] is not None and scenario.bump_left <= road.length
    events["travel_exceeded_mm"] = max(0.0, travel - scenario.mpc.deflection_limit) * 1000 if travel == travel else None
    return StrategyResult(
        strategy=strategy,
        scenario=scenario,
        metrics=metrics,
        comfort=comfort_metrics(signals, whole, metrics["rough_road"], static),
        events=events,
        reference={
            "front_static_load": static[0],
            "rear_static_load": static[1],
            "deflection_limit": scenario.mpc.deflection_limit,
            "force_limit": None,
            "target_speed": None,
            "target_band": None,
        },
        stages=_stages([0.0, scenario.bump_start, bump_end, road.length], position, time),
        travel_time=whole[1] - whole[0] if whole and timed else nan,
        arrival_speed_kmh=arrival / KMH,
        series=Series({key: values[on_road] for key, values in signals.items()}, no_columns),
    )


def _on_road(position: FloatArray, scenario: Scenario) -> NDArray[np.bool_]:
    """Which samples lie on the scenario's road."""
    return (position >= 0) & (position <= scenario.road.length)


def _speed_at(place: float, signals: Mapping[str, FloatArray]) -> float:
    """Speed of the car there [m/s], recorded or over the metre around; NaN where it was not there."""
    position, time, speed = (signals[key] for key in ("position", "time", "speed"))
    if not position[0] <= place <= position[-1]:
        return nan
    if np.isfinite(speed).any():
        return float(np.interp(place, position[np.isfinite(speed)], speed[np.isfinite(speed)]))
    around = np.clip([place - 0.5, place + 0.5], position[0], position[-1])
    begin, end = np.interp(around, position, time)
    return float((around[1] - around[0]) / (end - begin)) if end > begin else nan


def _stages(edges: list[float], position: FloatArray, time: FloatArray) -> tuple[Span, ...]:
    """Cruise, bump and cruise again, as far as it was recorded."""
    within = np.clip(edges, position[0], position[-1]).tolist()
    names = "cruise", "bump", "cruise"
    at = np.interp(within, position, time).tolist()
    return tuple(
        Span(stage=stage, start_time=t0, end_time=t1, start_position=x0, end_position=x1)
        for stage, (x0, x1), (t0, t1) in zip(names, pairwise(within), pairwise(at), strict=True)
        if x1 > x0
    )
