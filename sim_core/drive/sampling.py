"""A drive over a road, sampled: everything about a run that no suspension changes.

What follows from the drive alone is kept apart from the road's heights: another road of the same length, or another
bump in the same place, only looks its heights up.
"""

from dataclasses import dataclass
from math import ceil

import numpy as np
from numpy.typing import NDArray

from sim_core.arrays import FloatArray
from sim_core.caching import cached
from sim_core.car.half_car import DISTURBANCES
from sim_core.car.road import (
    GRID,
    GridPlace,
    RoadProfile,
    detail,
    grid_between,
    grid_place,
    grid_samples,
    kinks,
    profile,
)
from sim_core.drive.speed_profile import KMH, Drive, run_in_steps
from sim_core.scenario import Road, Scenario
from sim_core.strategies import SpeedPolicy, Strategy, SuspensionPolicy

FINEST, COARSEST = 5e-5, 1e-3  # bounds of the fine step [s]


@dataclass(frozen=True, slots=True, eq=False, kw_only=True)
class Kinks:
    """Where both axles meet the kinks of the road, from x = 0 to its end: the roughness' samples and the bump's own.

    Attributes:
        position: Of the kinks (k,) [m], the front axle's, then the rear's, each in the order they are met.
        step: The fine step from x = 0 in which each is met (k,).
        share: Of that step, after which it is met (k,).
        rear: Index of the rear axle's first.
    """

    position: FloatArray
    step: NDArray[np.intp]
    share: FloatArray
    rear: int

    def axle(self, indices: NDArray[np.intp]) -> NDArray[np.intp]:
        """0 for those of these kinks that the front axle meets, 1 for the rear's."""
        return (indices >= self.rear).astype(np.intp)


@dataclass(frozen=True, slots=True, eq=False, kw_only=True)
class SampledDrive:
    """A drive in control steps from the run-in to the road's end, and in fine ones.

    Attributes:
        time: Control instants (steps + 1,) [s], 0 when the front axle is at x = 0.
        fine: Fine steps in each control step.
        before: Control steps before x = 0.
        position: Of the front and the rear axle at every fine instant (2, n + 1) [m].
        place: The same on the road's grid.
        kinks: Where they meet kinks of the road.
        braking: Deceleration, held over a fine step (n,) [m/s^2].
        on_record: The fine samples on record, from x = 0 to the road's end.
        series: The record's signals that no road changes (catalogue.SIGNALS).
    """

    time: FloatArray
    fine: int
    before: int
    position: FloatArray
    place: GridPlace
    kinks: Kinks
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
class RoadInput:
    """A sampled drive on its road.

    Attributes:
        drive: What follows from the drive alone.
        position: Of the front axle at the control instants that begin a step (steps,) [m].
        disturbance: Road velocities front and rear [m/s], braking deceleration [m/s^2], each held over a fine step;
            (steps, 3 · fine), fine step after fine step.
        surface: The road.
        height: Of the road under both axles at every fine instant (2, n + 1) [m].
        series: The record's signals that no suspension changes (catalogue.SIGNALS).
    """

    drive: SampledDrive
    position: FloatArray
    disturbance: FloatArray
    surface: RoadProfile
    height: FloatArray
    series: dict[str, FloatArray]

    @property
    def time(self) -> FloatArray:
        """Control instants (steps + 1,) [s]."""
        return self.drive.time

    @property
    def fine(self) -> int:
        """Fine steps in each control step."""
        return self.drive.fine

    @property
    def on_record(self) -> slice:
        """The fine samples on record."""
        return self.drive.on_record

    @property
    def step(self) -> float:
        """Control step [s]."""
        return self.drive.step

    @property
    def fine_step(self) -> float:
        """Fine step [s]."""
        return self.drive.fine_step

    def above_chord(self, indices: NDArray[np.intp]) -> FloatArray:
        """Height of these kinks above the chord of the fine step in which they are met [m]."""
        kinks, heights = self.drive.kinks, self.height
        sample = kinks.axle(indices) * heights.shape[1] + self.on_record.start + kinks.step[indices]
        low, high = heights.take(sample), heights.take(sample + 1)
        chord: FloatArray = low + kinks.share[indices] * (high - low)
        return self.surface.height(kinks.position[indices]) - chord


def fine_step(scenario: Scenario, strategy: Strategy) -> float:
    """Longest fine step [s]: 60 over the bump (or its two ramps), 0.1 rad of the wheels, a grid step of the road, 1 ms.

    Between the ends of a fine step the road is taken as linear and the car exact, so the road's curvature and the
    sampling of peaks need it short; tests/validation holds metrics against steps of 0.02 ms. The bump counts at the
    initial speed, the rough road at the speed that is held for long, with lagging actuators at the initial speed too:
    without jumps of the force the peaks lie where the road's slope changes.
    """
    vehicle, bump, speed = scenario.real_vehicle, scenario.road.bump, scenario.speed
    stop = 0.0 if vehicle.bump_stop_clearance is None else vehicle.bump_stop_stiffness
    stiffest = max(
        (vehicle.front_tyre_stiffness + vehicle.front_spring + stop) / vehicle.front_wheel_mass,
        (vehicle.rear_tyre_stiffness + vehicle.rear_spring + stop) / vehicle.rear_wheel_mass,
    )
    over_bump = detail(bump) / (60 * speed.initial_speed_kmh * KMH) if bump.height else COARSEST
    held = speed.initial_speed_kmh
    lagging = strategy.suspension is not SuspensionPolicy.PASSIVE and scenario.actuator.bandwidth is not None
    if strategy.speed is SpeedPolicy.PLANNED and not lagging:
        held = min(held, speed.target_speed_kmh)
    over_grid = COARSEST if scenario.road.is_smooth else GRID / (held * KMH)
    return min(COARSEST, max(FINEST, min(0.1 / float(np.sqrt(stiffest)), over_bump, over_grid)))


@cached
def sample_road(
    road: Road, wheelbase: float, drive: Drive, step: float, longest_fine_step: float, multiple: int = 1
) -> RoadInput:
    """Sample a drive and look its road up.

    Args:
        road: What it drives over.
        wheelbase: L [m].
        drive: Its speed plan.
        step: Control step [s].
        longest_fine_step: See `fine_step` [s].
        multiple: A control step has a whole multiple of so many fine steps.
    """
    fine = multiple * ceil(step / multiple / longest_fine_step - 1e-9)
    sampled = _sampled(drive, road.length, wheelbase, step, fine, kinks(road.bump))
    surface = profile(road)
    height = surface.height_along(sampled.position, sampled.place)
    held = np.empty((len(sampled.braking), DISTURBANCES))
    velocity = np.subtract(height[:, 1:], height[:, :-1], out=held.T[:2])
    velocity *= 1 / sampled.fine_step
    held[:, 2] = sampled.braking
    height.flags.writeable = False
    front, rear = height[:, sampled.on_record]
    return RoadInput(
        drive=sampled,
        position=sampled.position[0, : -1 : sampled.fine],
        disturbance=held.reshape(len(sampled.time) - 1, sampled.fine * DISTURBANCES),
        surface=surface,
        height=height,
        series=sampled.series | {"front_road": front, "rear_road": rear},
    )


@cached
def _sampled(
    drive: Drive, length: float, wheelbase: float, step: float, fine: int, bump_kinks: tuple[float, ...]
) -> SampledDrive:
    """The part of `sample_road` that needs no height; length of the road and the bump's kinks in m."""
    duration = drive.time_at(length)
    before = run_in_steps(drive.initial_speed, step)
    steps = before + int(duration / step + 1e-6) + 1  # the last one begins at the road's end or before it
    h = step / fine

    time = h * np.arange(-before * fine, (steps - before) * fine + 1, dtype=np.float64)
    position, speed = drive.at(time)
    first = before * fine
    record = slice(first, first + int(duration / h + 1e-6) + 1)
    series = {
        "time": time[record],
        "position": position[record],
        "speed": speed[record],
        "brake_pressure": drive.sample(drive.pressure, time[record]),
        "brake_deceleration": drive.sample(drive.braking, time[record]),
    }
    for values in series.values():
        values.flags.writeable = False
    axles = np.stack([position, position - wheelbase])
    return SampledDrive(
        time=step * np.arange(-before, steps - before + 1, dtype=np.float64),
        fine=fine,
        before=before,
        position=axles,
        place=grid_place(axles, grid_samples(length)),
        kinks=_kinks(axles[:, first:], bump_kinks),
        braking=drive.sample(drive.braking, time[:-1] + h / 2),
        on_record=record,
        series=series,
    )


def _kinks(position: FloatArray, bump_kinks: tuple[float, ...]) -> Kinks:
    """Of axles at those positions from x = 0 on (2, n + 1) [m]."""
    positions, steps, shares = [], [], []
    for driven in position:
        begin, end = float(driven[0]), float(driven[-1])
        met = np.sort(np.concatenate([grid_between(begin, end), bump_kinks]))
        met = met[(met > begin) & (met < end)]
        step = driven.searchsorted(met) - 1
        positions.append(met)
        steps.append(step)
        shares.append((met - driven[step]) / (driven[step + 1] - driven[step]))
    return Kinks(
        position=np.concatenate(positions),
        step=np.concatenate(steps),
        share=np.concatenate(shares),
        rear=len(positions[0]),
    )
