"""Gravity, inverted signs and offsets in a recording's signals."""

from collections.abc import Mapping
from math import copysign

import numpy as np

from sim_core.arrays import FloatArray
from sim_core.catalogue import METRIC_SIGNALS, SIGNALS
from sim_core.comparison.numbers import pretty_unit, significant

GRAVITY = 9.80665  # [m/s^2]
NEAR_GRAVITY = 0.5  # a sensor's own offset and a mounting that is not quite upright, at most [m/s^2]
LEAST_OFFSET_SHARE = 0.1  # of a signal's standard deviation: this offset adds half a percent to its RMS
LARGEST_VELOCITY_CHANGE = 1.0  # the body's vertical speed [m/s] or pitch rate [rad/s] changes by no more over a drive

_VERTICAL = "body_acceleration"


def gravity_in(acceleration: FloatArray) -> float:
    """Return the gravity in a vertical acceleration [m/s^2]: positive as a sensor at rest has it whose z points up.

    0 where its mean is that of no sensor at rest, whichever way it points.
    """
    mean = float(np.nanmean(acceleration)) if np.isfinite(acceleration).any() else 0.0
    return copysign(GRAVITY, mean) if abs(abs(mean) - GRAVITY) <= NEAR_GRAVITY else 0.0


def without_gravity(signals: Mapping[str, FloatArray]) -> dict[str, FloatArray]:
    """Return the signals with the body's acceleration less gravity, and up positive where gravity shows the sign."""
    if _VERTICAL not in signals or not (gravity := gravity_in(signals[_VERTICAL])):
        return dict(signals)
    return {**signals, _VERTICAL: copysign(1.0, gravity) * (signals[_VERTICAL] - gravity)}


def describe_offsets(signals: Mapping[str, FloatArray], duration: float) -> list[str]:
    """Return notes on gravity and offsets in the signals, and on what is done with them.

    Args:
        signals: As they were recorded.
        duration: Of the drive [s].
    """
    notes = []
    for key, values in without_gravity(signals).items():
        if key not in METRIC_SIGNALS or not np.isfinite(values).any():
            continue
        mean, spread = float(np.nanmean(values)), float(np.nanstd(values))
        label, unit = SIGNALS[key].label.lower(), pretty_unit(SIGNALS[key].unit)
        if key == _VERTICAL and (gravity := gravity_in(signals[key])):
            about = f"{significant(float(np.nanmean(signals[key])), 2)} {unit}"
            inverted = "" if gravity > 0 else "; z points down, so its sign was inverted"
            notes.append(f"The mean of {label} is {about}: it contains gravity, which was subtracted{inverted}")
        if key.endswith("acceleration"):
            offset = abs(mean) > LEAST_OFFSET_SHARE * spread and abs(mean) * duration > LARGEST_VELOCITY_CHANGE
        else:
            offset = abs(mean) > max(spread, 1e-9)
        if offset:
            weighted = "; weighted values are without it" if key == _VERTICAL else ""
            about = f"{significant(mean)} {unit}"
            notes.append(f"The mean of {label} is {about}, not about 0: this offset was kept{weighted}")
    return notes
