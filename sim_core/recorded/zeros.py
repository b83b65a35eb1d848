"""What lies in a recording's signals beside motion: gravity, sensors that point down, and offsets."""

from collections.abc import Mapping
from math import copysign

import numpy as np

from sim_core.arrays import FloatArray
from sim_core.catalogue import METRIC_SIGNALS, SIGNALS

GRAVITY = 9.80665  # [m/s^2]
NEAR_GRAVITY = 0.5  # a sensor's own offset and a mounting that is not quite upright, at most [m/s^2]
NOTABLE = 0.1  # of a signal's standard deviation: so much offset adds half a percent to its RMS
TURNED = 1.0  # the body's vertical speed [m/s] or pitch rate [rad/s] changes by no more over a drive

_VERTICAL = "body_acceleration"


def gravity_in(acceleration: FloatArray) -> float:
    """Return the gravity in a vertical acceleration [m/s^2]: positive as a sensor at rest has it whose z points up.

    0 where its mean is that of no sensor at rest, whichever way it points.
    """
    mean = float(np.nanmean(acceleration)) if np.isfinite(acceleration).any() else 0.0
    return copysign(GRAVITY, mean) if abs(abs(mean) - GRAVITY) <= NEAR_GRAVITY else 0.0


def without_gravity(signals: Mapping[str, FloatArray]) -> dict[str, FloatArray]:
    """Return the signals with gravity taken off the body's acceleration, and up positive, as far as gravity says it."""
    if _VERTICAL not in signals or not (gravity := gravity_in(signals[_VERTICAL])):
        return dict(signals)
    return {**signals, _VERTICAL: copysign(1.0, gravity) * (signals[_VERTICAL] - gravity)}


def notes_on_zeros(signals: Mapping[str, FloatArray], duration: float) -> list[str]:
    """Say what lies in the signals beside motion, and what is done with it.

    Args:
        signals: As they were recorded.
        duration: Of the drive [s].
    """
    notes = []
    for key, values in without_gravity(signals).items():
        if key not in METRIC_SIGNALS or not np.isfinite(values).any():
            continue
        entry, mean, spread = SIGNALS[key], float(np.nanmean(values)), float(np.nanstd(values))
        if key == _VERTICAL and (gravity := gravity_in(signals[key])):
            where = "it is taken off" if gravity > 0 else "z points down: it is taken off and the sign turned"
            about = f"{np.nanmean(signals[key]):.3g} {entry.unit}"
            notes.append(f"{entry.label} lies about {about}: gravity is in it; {where}")
        if key.endswith("acceleration"):
            offset = abs(mean) > NOTABLE * spread and abs(mean) * duration > TURNED
        else:
            offset = abs(mean) > max(spread, 1e-9)
        if offset:
            taken = "it is taken as it is, but for the weighted values" if key == _VERTICAL else "it is taken as it is"
            notes.append(f"{entry.label} lies about {mean:.3g} {entry.unit}, not about 0: {taken}")
    return notes
