"""A speed profile and its road, sampled: everything about a run that no suspension changes.

What follows from the speed profile alone is kept apart from the road's heights: another road of the same length, or
another bump in the same place, only looks its heights up.
"""

from dataclasses import dataclass
from math import ceil

import numpy as np

from sim_core.arrays import FloatArray
from sim_core.caching import cached
from sim_core.control.controller import Controller
from sim_core.kernel import binding
from sim_core.road.profile import GRID, RoadProfile, detail, road_profile
from sim_core.scenario import Road, Scenario
from sim_core.speed.profile import SPEED_CONTROL_PERIOD, SpeedPlan, SpeedProfile

FINEST, COARSEST = 5e-5, 1e-3  # bounds of the fine step [s]
ON_STOP = 1e-4  # longest fine step of a car that rests on a stop: each small motion meets the kink of its force [s]
SHORT_STEP = 1e-3  # longest step in which a delayed controller's commands may arrive [s]


@dataclass(frozen=True, slots=True, eq=False, kw_only=True)
class TimeGrid:
    """A speed profile in control steps from the run-in to the road's end, and in fine ones.

    Attributes:
        time: Control instants (steps + 1,) [s], 0 when the front axle is at x = 0.
        fine: Fine steps in each control step.
        run_in_steps: Control steps before x = 0.
        axles: Position of both axles at every fine instant (2, n + 1) [m].
        position: Of the front axle at the control instants that begin a step (steps,) [m].
        speed: Of the car then (steps,) [m/s].
        braking: Deceleration, held over each fine step (n,) [m/s^2].
        on_record: The fine samples on record, from x = 0 to the road's end.
        series: The record's signals that no road changes (catalogue.SIGNALS).
    """

    time: FloatArray
    fine: int
    run_in_steps: int
    axles: FloatArray
    position: FloatArray
    speed: FloatArray
    braking: FloatArray
    on_record: slice
    series: dict[str, FloatArray]

    @property
    def step(self) -> float:
        """Control step [s]."""
        return float(self.time[1] - self.time[0])

    @property
    def fine_step(self) -> float:
        """Fine step [s]."""
        return self.step / self.fine


@dataclass(frozen=True, slots=True, eq=False, kw_only=True)
class Excitation:
    """A sampled speed profile on its road.

    Attributes:
        grid: What follows from the speed profile alone.
        surface: The road.
        height: Of the road under both axles at every fine instant (2, n + 1) [m].
        series: The record's signals that no suspension changes (catalogue.SIGNALS).
    """

    grid: TimeGrid
    surface: RoadProfile
    height: FloatArray
    series: dict[str, FloatArray]


@dataclass(frozen=True, slots=True, kw_only=True)
class StepSizes:
    """How finely a run is stepped.

    Attributes:
        control: Control step [s].
        short: Short steps in a control step: 1 where commands take effect at once.
        fine: Fine steps in a control step, as many in each short one.
    """

    control: float
    short: int
    fine: int


def step_sizes(scenario: Scenario, controller: Controller, plan: SpeedPlan) -> StepSizes:
    """Return those of a controller's run at that speed plan."""
    control = scenario.mpc.sample_time if controller.actuated else SPEED_CONTROL_PERIOD
    short = ceil(control / SHORT_STEP - 1e-9) if controller.delayed else 1
    longest = longest_fine_step(scenario, plan, actuated=controller.actuated)
    return StepSizes(control=control, short=short, fine=short * ceil(control / short / longest - 1e-9))


def longest_fine_step(scenario: Scenario, plan: SpeedPlan, *, actuated: bool) -> float:
    """Return the longest fine step [s].

    60 over the bump (or its two ramps), 0.1 rad of the wheels, a grid step of the road, 1 ms; shorter for a car that
    rests on a stop. Between the ends of a fine step the road is taken as straight, by cars that are not linear as a
    polynomial, so its curvature and the sampling of peaks need it short; tests/validation holds metrics against steps
    of 0.02 ms. The bump counts at the initial speed, the rough road at the speed that is held for long, with lagging
    actuators at the initial speed too: without jumps of the force the peaks lie where the road's slope changes.
    """
    vehicle, bump, speed = scenario.real_vehicle, scenario.road.bump, scenario.speed
    stop = 0.0 if vehicle.bump_stop_clearance is None else vehicle.bump_stop_stiffness
    stiffest = max(
        (vehicle.front_tyre_stiffness + vehicle.front_spring + stop) / vehicle.front_wheel_mass,
        (vehicle.rear_tyre_stiffness + vehicle.rear_spring + stop) / vehicle.rear_wheel_mass,
    )
    over_bump = detail(bump) / (60 * speed.initial) if bump.height else COARSEST
    held = speed.initial
    lagging = actuated and scenario.actuator.bandwidth is not None
    if plan == "planned" and not lagging:
        held = min(held, speed.target)
    over_grid = COARSEST if scenario.road.is_smooth else GRID / held
    longest = ON_STOP if min(min(each) for each in vehicle.stop_clearances) < 0 else COARSEST
    return min(longest, max(FINEST, min(0.1 / float(np.sqrt(stiffest)), over_bump, over_grid)))


@cached
def excite(road: Road, rear_axle_offset: float, speed_profile: SpeedProfile, step: float, fine: int) -> Excitation:
    """Sample a speed profile and look its road up.

    Args:
        road: What is driven over.
        rear_axle_offset: How far behind the front axle the rear one meets it [m].
        speed_profile: How fast.
        step: Control step [s].
        fine: Fine steps in it.
    """
    grid = _sampled(speed_profile, road.length, rear_axle_offset, step, fine)
    surface = road_profile(road)
    height = surface.height(grid.axles)
    height.flags.writeable = False
    front, rear = height[:, grid.on_record]
    return Excitation(
        grid=grid,
        surface=surface,
        height=height,
        series=grid.series | {"front_road": front, "rear_road": rear},
    )


@cached
def above_chords(excitation: Excitation) -> FloatArray:
    """Return how far the road lies above its chord in each fine step on average, then its first moments (n, 4) [m]."""
    surface = excitation.surface
    return binding.above_chords(surface.roughness, surface.layout, excitation.grid.axles)


@cached
def _sampled(speed_profile: SpeedProfile, length: float, rear_axle_offset: float, step: float, fine: int) -> TimeGrid:
    """Return the part of `excite` that needs no height; length of the road in m."""
    run_in_steps, steps = speed_profile.control_steps(length, step)
    h = step / fine

    time = h * np.arange(-run_in_steps * fine, (steps - run_in_steps) * fine + 1, dtype=np.float64)
    position, speed = speed_profile.at(time)
    first = run_in_steps * fine
    record = slice(first, first + int(speed_profile.time_at(length) / h + 1e-6) + 1)
    series = {
        "time": time[record],
        "position": position[record],
        "speed": speed[record],
        "brake_pressure": _on_record(speed_profile, speed_profile.pressure, time[record]),
        "brake_deceleration": _on_record(speed_profile, speed_profile.braking, time[record]),
    }
    for values in series.values():
        values.flags.writeable = False
    return TimeGrid(
        time=step * np.arange(-run_in_steps, steps - run_in_steps + 1, dtype=np.float64),
        fine=fine,
        run_in_steps=run_in_steps,
        axles=np.stack([position, position - rear_axle_offset]),
        position=position[:-1:fine],
        speed=speed[:-1:fine],
        braking=speed_profile.sample(speed_profile.braking, time[:-1] + h / 2),
        on_record=record,
        series=series,
    )


def _on_record(speed_profile: SpeedProfile, values: FloatArray, time: FloatArray) -> FloatArray:
    """Return a sampled column of the speed profile; one that is zero throughout takes no memory."""
    return speed_profile.sample(values, time) if values.any() else np.broadcast_to(0.0, time.shape)
