"""What the MPC knows of the road and the braking over its horizon (docs/physics.md, "Preview").

none: the road ahead is taken as level. wheelbase: the rear axle will meet what the front has already driven.
lookahead: the sensors that find the bump give the road for the whole horizon, and the speed plan is known.
"""

import numpy as np
from numpy.lib.stride_tricks import sliding_window_view

from sim_core.caching import kept
from sim_core.half_car import DISTURBANCES
from sim_core.longitudinal import Drive
from sim_core.result import FloatArray
from sim_core.road import profile
from sim_core.scenario import Mismatch, Preview, Road
from sim_core.track import Track

EXACT = Mismatch()
_NOISE_STREAM = 2  # a generator of its own beside the road's


@kept(48)
def preview_windows(
    mode: Preview,
    road: Road,
    drive: Drive,
    track: Track,
    horizon: int,
    wheelbase: float,
    mismatch: Mismatch = EXACT,
) -> FloatArray:
    """Disturbances over the horizon as expected at each control step, shape (steps, 3 · horizon).

    Columns: mean velocity of the front axle's road in each interval, then of the rear's [m/s], then the braking
    deceleration [m/s^2].

    Args:
        mode: none, wheelbase or lookahead.
        road: The road.
        drive: How it is driven.
        track: The same, sampled.
        horizon: Prediction horizon.
        wheelbase: L [m].
        mismatch: How the sensors that look ahead err.
    """
    surface, time, h = profile(road), track.time, track.step
    steps = len(time) - 1
    windows = np.zeros((steps, DISTURBANCES, horizon))
    if mode == "lookahead":
        further = np.concatenate([time, time[-1] + h * np.arange(1, horizon)])
        position, _ = drive.at(further - mismatch.preview_delay)
        position = position - mismatch.preview_offset
        noise = np.random.default_rng((road.seed, _NOISE_STREAM))
        for axle, behind in enumerate((0.0, wheelbase)):
            height = mismatch.preview_gain * surface.height(position - behind)
            if mismatch.preview_noise:
                height = height + mismatch.preview_noise * noise.standard_normal(len(height))
            velocity = np.diff(height) / h
            windows[:, axle] = sliding_window_view(velocity, horizon)[:steps]
        braking = drive.sample(drive.braking, further[:-1] + h / 2)
        windows[:, 2] = sliding_window_view(braking, horizon)[:steps]
    else:
        position, speed = drive.at(time[:-1])
        windows[:, 2] = drive.sample(drive.braking, time[:-1])[:, None]
        if mode == "wheelbase":
            ahead = speed[:, None] * h * np.arange(horizon + 1)
            driven = ahead[:, 1:] <= wheelbase
            heights = surface.height(position[:, None] - wheelbase + np.minimum(ahead, wheelbase))
            windows[:, 1] = np.where(driven, np.diff(heights, axis=1) / h, 0.0)
    return windows.reshape(steps, DISTURBANCES * horizon)
