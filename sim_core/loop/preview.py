"""What a controller knows of the road and the braking ahead (docs/explanation/preview.md).

none: the road ahead is taken as level. wheelbase: the rear axle will meet what the front has already driven; nothing
where both meet the road together.
lookahead: the sensors that find the bump give the road for the whole horizon, and the speed plan is known.
obstacle: those sensors give the bump alone, without the roughness.

Sensors see as far ahead of the front axle as they detect the bump, `speed.detection_distance`; behind that the road is
taken as level.
"""

from dataclasses import dataclass

import numpy as np

from sim_core.arrays import FloatArray
from sim_core.caching import cached
from sim_core.kernel import binding
from sim_core.loop.excitation import Excitation, TimeGrid
from sim_core.road.profile import RoadProfile
from sim_core.road.sensed import ExpectedErrors, expected_errors, sensed_road
from sim_core.scenario import Mismatch, Preview, Scenario
from sim_core.speed.profile import POSITION_TOLERANCE, SpeedProfile
from sim_core.vehicle.half_car import DISTURBANCES


@dataclass(frozen=True, slots=True, eq=False, kw_only=True)
class Forecast:
    """What is expected over the horizon at each control step.

    Attributes:
        disturbances: Mean velocity of the front axle's road in each interval, the rear's [m/s], and the braking
            deceleration [m/s^2] (3, steps, horizon); perhaps a view.
        source: A C-contiguous array that begins with the first step's, and of which `disturbances` may be a view.
        preview_norms: Of each step's the mean deceleration's magnitude [m/s^2], then the norms of both velocities and
            of the deceleration's difference from its mean (4, steps).
        height_now: Of the road under both axles, as it is previewed (2, steps) [m].
    """

    disturbances: FloatArray
    source: FloatArray
    preview_norms: FloatArray
    height_now: FloatArray


def preview(
    mode: Preview, scenario: Scenario, speed_profile: SpeedProfile, excitation: Excitation, horizon: int
) -> Forecast:
    """Return the disturbances over the horizon as expected at each control step.

    Args:
        mode: none, wheelbase, lookahead or obstacle.
        scenario: Whose road, sensors and expected errors.
        speed_profile: How the road is driven.
        excitation: The same, grid.
        horizon: Prediction horizon; of 0 steps nothing is expected.
    """
    mismatch, rear_axle_offset = scenario.mismatch, scenario.rear_axle_offset
    if mode in ("lookahead", "obstacle") and horizon:
        surface = excitation.surface
        expected = expected_errors(scenario.mpc) if mode == "lookahead" else ExpectedErrors()
        if mode == "obstacle" or mismatch.preview_noise or mismatch.preview_resolution or expected != ExpectedErrors():
            surface = sensed_road(surface, scenario.road, mismatch, expected, obstacle_alone=mode == "obstacle")
        distance = scenario.speed.detection_distance
        return _by_sensors(surface, speed_profile, excitation.grid, horizon, rear_axle_offset, mismatch, distance)
    if mode == "wheelbase":
        disturbances, preview_norms = _behind_the_front(excitation, speed_profile, horizon, rear_axle_offset)
    else:
        disturbances, preview_norms = _level(excitation.grid, speed_profile, horizon)
    height_now = excitation.height[:, : -1 : excitation.grid.fine]
    return Forecast(disturbances=disturbances, source=disturbances, preview_norms=preview_norms, height_now=height_now)


def sliding_forecast(disturbances: FloatArray, horizon: int, height_now: FloatArray) -> Forecast:
    """Return the horizon slides over the disturbances of every interval to come (3, steps + horizon - 1).

    Args:
        disturbances: Of every interval.
        horizon: Intervals in it.
        height_now: As `Forecast`'s.
    """
    windows, (kind, step) = disturbances.shape[1] - horizon + 1, disturbances.strides
    preview_norms = np.empty((1 + DISTURBANCES, windows))
    binding.window_sizes(disturbances, horizon, preview_norms)
    return Forecast(
        disturbances=np.ndarray((DISTURBANCES, windows, horizon), buffer=disturbances, strides=(kind, step, step)),
        source=disturbances,
        preview_norms=preview_norms,
        height_now=height_now,
    )


@cached
def _by_sensors(
    surface: RoadProfile,
    speed_profile: SpeedProfile,
    grid: TimeGrid,
    horizon: int,
    rear_axle_offset: float,
    mismatch: Mismatch,
    detection_distance: float,
) -> Forecast:
    """Return what sensors and speed plan predict for every interval to come."""
    axles, braking = _sensed_places(
        speed_profile, grid, horizon, rear_axle_offset, mismatch.preview_offset, mismatch.preview_delay
    )
    height = mismatch.preview_gain * surface.height(axles)
    disturbances = np.empty((DISTURBANCES, len(braking)))
    np.subtract(height[:, 1:], height[:, :-1], out=disturbances[:2])
    disturbances[:2] /= grid.step
    disturbances[2] = braking
    forecast = sliding_forecast(disturbances, horizon, height[:, : len(grid.time) - 1])
    seen_until = axles[0, : disturbances.shape[1] - horizon + 1] + detection_distance + POSITION_TOLERANCE
    if (axles[0, horizon:] <= seen_until).all():
        return forecast
    return _within_sight(forecast, axles, seen_until)


def _within_sight(forecast: Forecast, axles: FloatArray, seen_until: FloatArray) -> Forecast:
    """Return the forecast with level road in intervals that do not lie within sight as a whole.

    Args:
        forecast: What sensors without a limit give.
        axles: Where they take both axles to be at every control instant to come (2, n + 1) [m].
        seen_until: The furthest place that they see at each control step (steps,) [m].
    """
    horizon, preview_norms = forecast.disturbances.shape[2], forecast.preview_norms.copy()
    ends = np.lib.stride_tricks.sliding_window_view(axles[:, 1:], horizon, axis=1)
    disturbances = np.array(forecast.disturbances)
    disturbances[:2] *= ends <= seen_until[:, None]
    preview_norms[1:3] = np.linalg.norm(disturbances[:2], axis=2)
    return Forecast(
        disturbances=disturbances, source=disturbances, preview_norms=preview_norms, height_now=forecast.height_now
    )


@cached
def _sensed_places(
    speed_profile: SpeedProfile, grid: TimeGrid, horizon: int, rear_axle_offset: float, offset: float, delay: float
) -> tuple[FloatArray, FloatArray]:
    """Where sensors take the axles to be at every control instant to come (2, n + 1) [m]; the braking in between."""
    time, h = grid.time, grid.step
    further = np.concatenate([time, time[-1] + h * np.arange(1, horizon)])
    position = speed_profile.at(further - delay)[0] - offset
    axles = np.stack([position, position - rear_axle_offset])
    return axles, speed_profile.sample(speed_profile.braking, further[:-1] + h / 2)


@cached
def _level(grid: TimeGrid, speed_profile: SpeedProfile, horizon: int) -> tuple[FloatArray, FloatArray]:
    """`Forecast.disturbances` and `preview_norms` of a level road; braking stays as it is."""
    braking = speed_profile.sample(speed_profile.braking, grid.time[:-1])
    disturbances = np.zeros((DISTURBANCES, len(braking), horizon))
    disturbances[2] = braking[:, None]
    none = np.zeros(len(braking))
    return disturbances, np.stack([np.abs(braking), none, none, none])


@cached
def _behind_the_front(
    excitation: Excitation, speed_profile: SpeedProfile, horizon: int, rear_axle_offset: float
) -> tuple[FloatArray, FloatArray]:
    """`Forecast.disturbances` and `preview_norms` where the rear axle meets the road that the front one has passed."""
    grid, surface = excitation.grid, excitation.surface
    level, level_norms = _level(grid, speed_profile, horizon)
    disturbances, preview_norms = level.copy(), level_norms.copy()
    further = grid.speed[:, None] * grid.step * np.arange(horizon + 1)
    driven = further[:, 1:] <= rear_axle_offset
    heights = surface.height(grid.position[:, None] - rear_axle_offset + np.minimum(further, rear_axle_offset))
    disturbances[1] = np.where(driven, np.diff(heights, axis=1) / grid.step, 0.0)
    preview_norms[2] = np.linalg.norm(disturbances[1], axis=1)
    return disturbances, preview_norms
