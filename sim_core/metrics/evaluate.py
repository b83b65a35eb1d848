"""The result of a run: its metrics by their one definition, and what its controller, its stages and its speed add.

A record has a column for each held command, with the values at both its ends: forces jump where a command changes, and
so do the accelerations. Mean squares are trapezoids within the columns; windows end between samples, where the drive
does.
"""

from collections.abc import Mapping, Sequence

import numpy as np

from sim_core.arrays import FloatArray
from sim_core.catalogue import EVENTS, METRIC_SIGNALS
from sim_core.kernel.record import Recorder
from sim_core.loop.run import Recording, Run
from sim_core.metrics.definition import Sums, comfort_metrics, drive_events, mean_squares, window_metrics
from sim_core.metrics.windows import Windows, section_ends
from sim_core.result import Series, StrategyResult
from sim_core.scenario import Scenario
from sim_core.scenario.parts import KMH
from sim_core.speed.profile import TARGET_BAND, SpeedProfile


def evaluate(run: Run, windows: Windows, recorder: Recorder, recording: Recording) -> StrategyResult:
    """Everything a run reports, from what was measured while it was driven."""
    scenario, controller, speed_profile = run.scenario, run.controller, run.speed_profile
    trajectory, report = recording.trajectory, controller.report
    arrival, sums = windows.arrival_speed, _sums(run, windows, recorder)
    metrics = window_metrics(sums)
    static = scenario.real_vehicle.static_loads
    planned, actuated = run.plan == "planned", controller.actuated
    events: Mapping[str, float | bool | None] = {
        **drive_events(sums, metrics, scenario),
        "target_reached": _target_reached(scenario, arrival) if planned else None,
        "limited_steps": trajectory.limited,
        "qp_solves": report.solves,
        "qp_fallbacks": report.fallbacks,
        "qp_failures": report.failures,
        "max_slack_mm": report.max_slack * 1000,
        "ecu_most_iterations": report.most_iterations,
        "ecu_clipped_values": report.clipped_values,
        "ecu_held_commands": trajectory.held_commands,
    }

    def columns(commands: slice) -> Mapping[str, FloatArray]:
        return dict(zip(METRIC_SIGNALS, recording.table(commands)[-len(METRIC_SIGNALS) :], strict=True))

    return StrategyResult(
        strategy=controller.id,
        scenario=scenario,
        metrics=metrics,
        comfort=comfort_metrics(sums, metrics, scenario),
        events={key: events[key] for key in EVENTS},
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
        series=Series(run.excitation.series, columns, recording.car.fine),
        label=controller.label,
    )


def _sums(run: Run, windows: Windows, recorder: Recorder) -> Sums:
    """Return what was summed while a run was driven; its unit of time is the fine step."""
    grid = run.excitation.grid
    return Sums(
        time_unit=grid.fine_step,
        durations=(windows.ends[:, 1] - windows.ends[:, 0]).tolist(),
        squares=recorder.integrals,
        peaks=recorder.peaks,
        weighted_samples=len(grid.series["time"]),
        weighted_step=grid.fine_step,
        **recorder.totals,
    )


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
