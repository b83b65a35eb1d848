"""Metrics of a run: RMS and peak per window as the paper's tables, and what the field expects beside them.

A record has a column for each held command, with the values at both its ends: forces jump where a command changes, and
so do the accelerations. Mean squares are trapezoids within the columns; windows end between samples, where the drive
does.
"""

from collections.abc import Mapping, Sequence
from math import isnan, nan, sqrt

import numpy as np

from sim_core.arrays import FloatArray
from sim_core.catalogue import METRIC_SIGNALS, WINDOWS
from sim_core.kernel.record import Recorder
from sim_core.loop.run import Recording, Run
from sim_core.metrics.windows import Windows, section_ends
from sim_core.result import Series, StrategyResult
from sim_core.scenario import Scenario
from sim_core.scenario.parts import KMH
from sim_core.speed.profile import TARGET_BAND, SpeedProfile

_AIRBORNE = "airborne_ms", "front_airborne_ms", "rear_airborne_ms"
_NOTHING = {"rms": nan, "peak": nan}
_LINES = sum(signal.endswith("acceleration") for signal in METRIC_SIGNALS)  # straight between samples


def evaluate(run: Run, windows: Windows, recorder: Recorder, recording: Recording) -> StrategyResult:
    """Everything a run reports, from what was measured while it was driven."""
    scenario, controller, speed_profile = run.scenario, run.controller, run.speed_profile
    excitation, trajectory, report = run.excitation, recording.trajectory, controller.report
    ends, arrival = windows.ends, windows.arrival_speed
    metrics = _by_window(recorder, ends)
    fine_step, duration = excitation.grid.fine_step, float(ends[-1, 1])
    samples, (squares, fourths), (power, most_power) = len(excitation.series["time"]), recorder.weighted, recorder.power
    static = scenario.real_vehicle.static_loads
    planned, actuated = run.plan == "planned", controller.actuated
    rough, whole = metrics["rough_road"], metrics["whole"]
    travel = max(whole["front_deflection"]["peak"], whole["rear_deflection"]["peak"])

    def columns(commands: slice) -> Mapping[str, FloatArray]:
        return dict(zip(METRIC_SIGNALS, recording.table(commands)[-len(METRIC_SIGNALS) :], strict=True))

    return StrategyResult(
        strategy=controller.id,
        scenario=scenario,
        metrics=metrics,
        comfort={
            "weighted_rms": sqrt(squares / samples),
            "vibration_dose": (fourths * fine_step) ** 0.25,  # (∫ a_w⁴ dt)^¼ (ISO 2631-1, 6.3.2)
            "front_dynamic_load_coefficient": rough["front_tyre_load"]["rms"] / static[0],
            "rear_dynamic_load_coefficient": rough["rear_tyre_load"]["rms"] / static[1],
            "actuator_mean_power": power / duration,
            "actuator_peak_power": most_power,
        },
        events={
            **dict(zip(_AIRBORNE, (1000 * fine_step * time for time in recorder.airborne), strict=True)),
            "stop_contact_ms": 1000 * fine_step * recorder.on_stops,
            "target_reached": _target_reached(scenario, arrival) if planned else None,
            "bump_complete": scenario.bump_left <= scenario.road.length if scenario.road.has_bump else None,
            "travel_exceeded_mm": max(0.0, travel - scenario.mpc.deflection_limit) * 1000,
            "limited_steps": trajectory.limited,
            "qp_solves": report.solves,
            "qp_fallbacks": report.fallbacks,
            "qp_failures": report.failures,
            "max_slack_mm": report.max_slack * 1000,
            "ecu_most_iterations": report.most_iterations,
            "ecu_clipped_values": report.clipped_values,
            "ecu_held_commands": trajectory.held_commands,
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
        series=Series(excitation.series, columns, recording.car.fine),
    )


def _by_window(recorder: Recorder, ends: FloatArray) -> dict[str, dict[str, dict[str, float]]]:
    """Return RMS and peak of METRIC_SIGNALS in WINDOWS; NaN in one that is empty, as where there is no bump."""
    squares, peaks, times = recorder.integrals.tolist(), recorder.peaks.tolist(), (ends[:, 1] - ends[:, 0]).tolist()
    squares[-1] = [sum(each) for each in zip(*squares, strict=True)]  # the whole, not what follows the bump
    peaks[-1], times[-1] = [max(each) for each in zip(*peaks, strict=True)], sum(times)
    return {
        window: {
            signal: {"rms": sqrt(square / time), "peak": square if isnan(square) else peak} if time else _NOTHING
            for signal, square, peak in zip(METRIC_SIGNALS, *of_section, strict=True)
        }
        for window, time, *of_section in zip(WINDOWS, times, squares, peaks, strict=True)
    }


def mean_squares(a: FloatArray, b: FloatArray) -> FloatArray:
    """Of METRIC_SIGNALS between samples a and b (signals, n): accelerations as lines, all else by trapezoids."""
    squares = (a * a + b * b) / 2
    squares[:_LINES] = (2 * squares[:_LINES] + (a * b)[:_LINES]) / 3
    return squares


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
    times = [(speed_profile.time_at(first), speed_profile.time_at(last)) for first, last in intervals]
    ends = section_ends([(first / fine_step, last / fine_step) for first, last in times])
    durations = ends[:, 1] - ends[:, 0]
    table = np.array([series.columns(signal) for signal in METRIC_SIGNALS])
    if (durations <= 0).any() or ends.min() < 0 or ends.max() > table[0, :, 1:].size:
        raise ValueError("An interval ends behind its beginning and lies on the road that was driven")
    a, b = (each.reshape(len(table), -1) for each in (table[:, :, :-1], table[:, :, 1:]))
    until = np.cumsum(np.pad(mean_squares(a, b), ((0, 0), (1, 0))), axis=1)  # the integral up to each place
    place = np.arange(until.shape[1])
    means = [np.diff(np.interp(ends, place, integral)).sum() / durations.sum() for integral in until]
    return dict(zip(METRIC_SIGNALS, np.sqrt(means).tolist(), strict=True))


def _target_reached(scenario: Scenario, arrival: float) -> bool:
    """Arrival within the band around the target; a target at or above the initial speed asks for nothing."""
    target = scenario.speed.target
    return target >= scenario.speed.initial or abs(arrival - target) <= TARGET_BAND + 1e-9
