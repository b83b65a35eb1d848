"""The result of a run: its metrics by their one definition, and what its controller, its stages and its speed add.

A record has a column for each held command, with the values at both its ends: forces jump where a command changes, and
so do the accelerations. Mean squares are trapezoids within the columns; windows end between samples, where the drive
does.
"""

from collections.abc import Mapping, Sequence
from itertools import pairwise
from math import ceil, inf, nan

import numpy as np

from sim_core.arrays import FloatArray
from sim_core.caching import cached
from sim_core.catalogue import EVENTS, METRIC_SIGNALS
from sim_core.kernel.record import Recorder
from sim_core.loop.excitation import TimeGrid
from sim_core.loop.run import Run
from sim_core.metrics.comfort import weighting
from sim_core.metrics.definition import Sums, comfort_metrics, drive_events, mean_squares, window_metrics
from sim_core.result import Series, StrategyResult
from sim_core.road.profile import kinks
from sim_core.scenario import Scenario
from sim_core.scenario.parts import KMH
from sim_core.speed.profile import TARGET_BAND, SpeedProfile

_STEP_TOLERANCE = 1e-6  # of a fine step: a section that ends so near to a sample ends there


def evaluate(run: Run) -> StrategyResult:
    """Drive a run, and return everything that it reports.

    Raises:
        RidelabError: As `Run.drive` says.
    """
    scenario, controller, speed_profile, recorder = run.scenario, run.controller, run.speed_profile, make_recorder(run)
    trajectory, report, grid = run.drive(recorder), controller.report, run.excitation.grid
    arrival = _arrival_speed(run)
    sums = Sums(
        time_unit=grid.fine_step,
        durations=(recorder.ends[:, 1] - recorder.ends[:, 0]).tolist(),
        squares=recorder.integrals,
        peaks=recorder.peaks,
        weighted_samples=len(grid.series["time"]),
        weighted_step=grid.fine_step,
        **recorder.totals,
    )
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
        signals = trajectory.sample(run.first_step + commands.start, run.first_step + commands.stop)
        return dict(zip(METRIC_SIGNALS, signals[-len(METRIC_SIGNALS) :], strict=True))

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
        series=Series(run.excitation.series, columns, trajectory.car.fine),
        label=controller.label,
    )


def make_recorder(run: Run) -> Recorder:
    """Return what measures a run's car in its steps, over the rough road, the bump, and what follows it."""
    excitation, short, vehicle, scenario = run.excitation, run.steps.short, run.scenario.real_vehicle, run.scenario
    lifted = [-static for static in vehicle.static_loads]
    least = lifted if vehicle.tyre_lift_off else [-inf, -inf]  # one that does not lift off pulls on the road
    grid, surface, length = excitation.grid, excitation.surface, scenario.road.length
    ends, longest = _sections(grid, run.speed_profile, scenario.bump_start, min(scenario.bump_left, length), length)
    beside, on_bump = surface.slope_range()
    return Recorder(
        fine=grid.fine // short,
        first=run.first_step,
        ends=ends,
        max_chord_deviation=np.array([beside, on_bump, beside]) * longest / 4,
        weighted_samples=len(grid.series["time"]),
        weighting=weighting(grid.fine_step),
        tyres=np.array([[vehicle.front_tyre_stiffness, vehicle.rear_tyre_stiffness], least, lifted]),
        clearance=np.array(vehicle.stop_clearances),
        road=(surface.roughness, surface.layout),
        position=grid.axles,
        height=excitation.height,
        kinks=np.array([*sorted(kinks(surface.bump)), inf]),  # a tyre load may peak just there
    )


@cached
def _sections(
    grid: TimeGrid, speed_profile: SpeedProfile, start: float, end: float, length: float
) -> tuple[FloatArray, FloatArray]:
    """Return the first and last place of the rough road, the bump, and what follows it (3, 2) [fine steps].

    By the time that the front axle spends in each; together they are the whole run. Then the longest fine step in each
    (3,) [m].

    Args:
        grid: Of the run.
        speed_profile: Likewise.
        start: Of the bump [m].
        end: Likewise.
        length: Of the road [m].
    """
    h = grid.fine_step
    bounds = [0.0, *(speed_profile.time_at(position) / h for position in (start, end, length))]
    ends = section_ends(list(pairwise(bounds)))
    distance = np.diff(grid.axles[0, grid.on_record.start :])
    return ends, np.array([distance[int(first) : ceil(last)].max(initial=0) for first, last in ends.tolist()])


def section_ends(spans: Sequence[tuple[float, float]]) -> FloatArray:
    """Ends (sections, 2) of sections that begin and end so many fine steps from x = 0: at a sample where near one."""
    steps = np.array(spans)
    nearest = np.round(steps)
    return np.where(np.abs(steps - nearest) < _STEP_TOLERANCE, nearest, steps)


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


def _arrival_speed(run: Run) -> float:
    """Return the car's speed as the front axle meets the bump [m/s]; NaN where there is none."""
    start = run.scenario.bump_start
    if start >= run.scenario.road.length:
        return nan
    return float(run.speed_profile.at(np.array(run.speed_profile.time_at(start)))[1])


def _target_reached(scenario: Scenario, arrival: float) -> bool:
    """Arrival within the band around the target; a target at or above the initial speed asks for nothing."""
    target = scenario.speed.target
    return target >= scenario.speed.initial or abs(arrival - target) <= TARGET_BAND + 1e-9
