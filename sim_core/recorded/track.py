"""Distance and time of a recording, from whichever of time, position and speed it has."""

from collections.abc import Mapping
from dataclasses import dataclass

import numpy as np

from sim_core.arrays import FloatArray
from sim_core.errors import RefusedError
from sim_core.scenario.parts import KMH

SLOWEST = 0.1  # a recorded speed below counts as this where it gives the time [m/s]


@dataclass(frozen=True, slots=True, kw_only=True)
class Track:
    """Distance and time of a recording.

    Attributes:
        distance: Not descending (m,) [m].
        time: Not descending (m,) [s].
        clocked: The distance is of the recorder's clock: a scale of the one is a scale of the other.
        timed: The time, or the speed that gives it, was recorded.
        notes: What both come from, in words.
    """

    distance: FloatArray
    time: FloatArray
    clocked: bool
    timed: bool
    notes: tuple[str, ...] = ()


def track_of(signals: Mapping[str, FloatArray], initial: float) -> Track:
    """Derive distance and time from those of time, position and speed that there are.

    Args:
        signals: By the catalogue's names (m,) [SI units].
        initial: The scenario's initial speed [m/s].

    Raises:
        RefusedError: There is neither time nor position.
    """
    time, position, speed = (signals.get(key) for key in ("time", "position", "speed"))
    if time is not None and position is not None:
        return Track(distance=position, time=time, clocked=False, timed=True)
    speed = None if speed is None else _without_gaps(speed)
    note = f"It is taken as driven at the initial speed, {initial / KMH:g} km/h: it has no speed"
    if time is not None:
        distance = initial * time
        if speed is not None:
            distance = _integral(np.maximum(speed, 0.0), time)
            note = "The distance is integrated from the speed over time"
        return Track(distance=distance, time=time, clocked=True, timed=True, notes=(note,))
    if position is None:
        raise RefusedError("A recording has a time or a distance")
    time = position / initial
    if speed is not None:
        time = _integral(1 / np.maximum(speed, SLOWEST), position)
        note = "The time is integrated from the speed over distance"
    return Track(distance=position, time=time, clocked=True, timed=speed is not None, notes=(note,))


def _without_gaps(values: FloatArray) -> FloatArray | None:
    """Return values with the missing ones interpolated (n,); None where all are missing."""
    order, there = np.arange(len(values)), np.isfinite(values)
    return np.interp(order, order[there], values[there]) if there.any() else None


def _integral(values: FloatArray, over: FloatArray) -> FloatArray:
    """Return the trapezoidal integral (n,)."""
    return np.concatenate([[0.0], np.cumsum((values[1:] + values[:-1]) / 2 * np.diff(over))])
