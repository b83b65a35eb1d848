"""What the MPC knows of the road and the braking over its horizon (docs/physics.md, "Preview").

none: the road ahead is taken as level. wheelbase: the rear axle will meet what the front has already driven.
lookahead: the sensors that find the bump give the road for the whole horizon, and the speed plan is known.
"""

import numpy as np
from numpy.lib.stride_tricks import sliding_window_view

from sim_core.arrays import FloatArray
from sim_core.caching import cached_up_to
from sim_core.car.half_car import DISTURBANCES
from sim_core.car.road import profile
from sim_core.drive.sampling import RoadInput
from sim_core.drive.speed_profile import Drive
from sim_core.scenario import Mismatch, Preview, Road

EXACT = Mismatch()
_NOISE_STREAM = 2  # a generator of its own beside the road's


def preview_windows(
    mode: Preview,
    road: Road,
    drive: Drive,
    road_input: RoadInput,
    horizon: int,
    wheelbase: float,
    mismatch: Mismatch = EXACT,
) -> FloatArray:
    """`preview`, flattened: (steps, 3 · horizon)."""
    windows = preview(mode, road, drive, road_input, horizon, wheelbase, mismatch)
    return flattened(windows)


def flattened(windows: FloatArray) -> FloatArray:
    """Windows (3, steps, horizon), or some steps of them, as rows (steps, 3 · horizon)."""
    return windows.transpose(1, 0, 2).reshape(windows.shape[1], -1)


def preview(
    mode: Preview,
    road: Road,
    drive: Drive,
    road_input: RoadInput,
    horizon: int,
    wheelbase: float,
    mismatch: Mismatch = EXACT,
) -> FloatArray:
    """Disturbances over the horizon as expected at each control step (3, steps, horizon); perhaps a view.

    Mean velocity of the front axle's road in each interval, the rear's [m/s], and the braking deceleration [m/s^2].

    Args:
        mode: none, wheelbase or lookahead.
        road: The road.
        drive: How it is driven.
        road_input: The same, sampled.
        horizon: Prediction horizon.
        wheelbase: L [m].
        mismatch: How the sensors that look ahead err.
    """
    if mode == "lookahead":
        ahead = _ahead(road, drive, road_input, horizon, wheelbase, mismatch)
        return sliding_window_view(ahead, horizon, axis=1)  # a window is the one before, moved on
    return _behind(mode, road, drive, road_input, horizon, wheelbase)


@cached_up_to(16)
def _ahead(
    road: Road, drive: Drive, road_input: RoadInput, horizon: int, wheelbase: float, mismatch: Mismatch
) -> FloatArray:
    """What sensors and speed plan tell of every interval to come (3, steps + horizon - 1)."""
    surface, time, h = profile(road), road_input.time, road_input.step
    further = np.concatenate([time, time[-1] + h * np.arange(1, horizon)])
    position, _ = drive.at(further - mismatch.preview_delay)
    position = position - mismatch.preview_offset
    noise = np.random.default_rng((road.seed, _NOISE_STREAM)) if mismatch.preview_noise else None
    ahead = np.empty((DISTURBANCES, len(further) - 1))
    for axle, behind in enumerate((0.0, wheelbase)):
        height = mismatch.preview_gain * surface.height(position - behind)
        if noise is not None:
            height = height + mismatch.preview_noise * noise.standard_normal(len(height))
        ahead[axle] = np.diff(height) / h
    ahead[2] = drive.sample(drive.braking, further[:-1] + h / 2)
    return ahead


@cached_up_to(48)
def _behind(
    mode: Preview, road: Road, drive: Drive, road_input: RoadInput, horizon: int, wheelbase: float
) -> FloatArray:
    """Windows without sensors ahead: what the front axle has driven, or nothing; braking stays what it is."""
    surface, time, h = profile(road), road_input.time, road_input.step
    windows = np.zeros((DISTURBANCES, len(time) - 1, horizon))
    position, speed = drive.at(time[:-1])
    windows[2] = drive.sample(drive.braking, time[:-1])[:, None]
    if mode == "wheelbase":
        ahead = speed[:, None] * h * np.arange(horizon + 1)
        driven = ahead[:, 1:] <= wheelbase
        heights = surface.height(position[:, None] - wheelbase + np.minimum(ahead, wheelbase))
        windows[1] = np.where(driven, np.diff(heights, axis=1) / h, 0.0)
    return windows
