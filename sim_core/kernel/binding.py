"""The C's functions, one in Python for each: what they do is said beside them in C.

Every array is checked, its type, order and shape as well as that it fits the others: C reads and writes nothing else.
Each function raises ValueError where sizes disagree, and ctypes.ArgumentError where an array is not C-contiguous
float64, or cannot be written into. Calls that are made at every step are in prepared.py.
"""

from collections.abc import Sequence

import numpy as np
from numpy.typing import NDArray

from sim_core.arrays import FloatArray
from sim_core.kernel.library import DOUBLE, INT, NAME, Array, CStruct, Function, require, size_of
from sim_core.kernel.record import LAYOUT

_MOST_FUZZY_SETS, _DISTURBANCES = size_of("fuzzy_sets"), size_of("disturbances")
_PLAN, _PLANNED_AT_ONCE = Array(size_of("plan")), 2048  # steps, of which most drives have fewer
_LINE, _TABLE = Array(ndim=1), Array(ndim=2)
_LINE_OUT, _TABLE_OUT = (Array(ndim=ndim, written=True) for ndim in (1, 2))
_ROAD = _LINE, INT, Array(LAYOUT)

_VARIABLE = _TABLE, INT, INT, DOUBLE
_prepare_rules = Function(
    "prepare_rules",
    *(*_VARIABLE, *_VARIABLE, Array(ndim=2, dtype=np.intc), INT, _TABLE, INT, INT, _TABLE_OUT, INT),
)
_torque_share = Function("torque_share", CStruct, DOUBLE, DOUBLE, result=DOUBLE)
_plan_speed = Function("plan_speed", CStruct, _PLAN, Array(3, written=True), _TABLE_OUT, INT, result=INT)
_roughness = Function("roughness", _LINE_OUT, INT, DOUBLE, DOUBLE, DOUBLE, result=DOUBLE)
_road_heights = Function("road_heights", *_ROAD, Array(), INT, Array(written=True))
_above_chords = Function("above_chords", *_ROAD, _TABLE, INT, _TABLE_OUT)
_window_sizes = Function("window_sizes", _TABLE, INT, INT, _TABLE_OUT)
_shape_number = Function("shape_number", NAME, result=INT)


def road_layout(first: float, grid: float, shape: str, bumps: Sequence[float]) -> FloatArray:
    """`struct layout` of kernel/road.h (9,), with what `struct bump` has behind the shape; lengths in m."""
    number = _shape_number(shape.encode())
    require(number >= 0, f"C knows no bump of the shape {shape}")
    return np.array([first, grid, number, *bumps], dtype=np.float64)


def fuzzy_rules(
    errors: FloatArray,
    error_end: float,
    distances: FloatArray,
    distance_end: float,
    rules: NDArray[np.intc],
    torques: FloatArray,
    *,
    interpolates: bool,
) -> CStruct:
    """Rules (m, 3): the set of the distance and of the error, -1 for any, and of the torque.

    Args:
        errors: Memberships of even samples of the error, from 0 to its end, in its sets (samples, sets).
        error_end: [km/h].
        distances: Likewise.
        distance_end: [m].
        rules: As above.
        torques: Memberships of torque shares from 0 to 1 in their sets (sets, samples).
        interpolates: Whether shares lie between those at the samples of error and distance.
    """
    sets, samples = torques.shape
    (error_samples, error_sets), (distance_samples, distance_sets) = errors.shape, distances.shape
    require(min(samples, error_samples, distance_samples) > 1 and min(error_end, distance_end) > 0, "Universes")
    require(rules.shape[1:] == (3,), "A rule has three sets")
    named = (rules >= (-1, -1, 0)).all() and (rules < (distance_sets, error_sets, sets)).all()
    require(bool(named), "A rule asks for sets there are, and concludes one")
    require(max(sets, error_sets, distance_sets) <= _MOST_FUZZY_SETS, "A variable has at most twenty sets")
    surface = np.full((distance_samples, error_samples) if interpolates else (0, 0), np.nan)
    return _prepare_rules.prepare(
        *(errors, error_samples, error_sets, error_end, distances, distance_samples, distance_sets, distance_end),
        *(rules, len(rules), torques, sets, samples - 1, surface, int(interpolates)),
    )


def torque_share(rules: CStruct, error: float, distance: float) -> float:
    """Torque share 0 to 1 at a speed error [km/h] and distance [m], both clipped to their universes."""
    share: float = _torque_share(rules, error, distance)
    return share


def plan_speed(rules: CStruct, plan: FloatArray, position: float, speed: float) -> FloatArray:
    """Position [m], speed [m/s], line pressure [Pa] and deceleration by the brakes [m/s^2] at each step (n, 4).

    Args:
        rules: Of `fuzzy_rules`.
        plan: `struct plan` of kernel/speed.c (20,).
        position: At the first step [m].
        speed: Likewise [m/s].
    """
    now, pieces = np.array([position, speed, 0.0]), []
    while np.isfinite(now[0]):
        rows = np.empty((_PLANNED_AT_ONCE, 4))
        pieces.append(rows[: _plan_speed(rules, plan, now, rows, len(rows))])
    return np.concatenate(pieces)


def roughness(samples: FloatArray, deviation: float, keep: float, grid: float) -> float:
    """Turn normal numbers (n,) into a road's roughness in place [m]; between its steepest slopes up and down [1]."""
    require(len(samples) > 0, "A road has samples")
    slopes: float = _roughness(samples, len(samples), deviation, keep, grid)
    return slopes


def _check_road(samples: FloatArray) -> None:
    require(len(samples) > 1, "A road has two samples at least")


def road_heights(samples: FloatArray, layout: FloatArray, position: FloatArray, height: FloatArray) -> None:
    """Fill the heights of a road at positions of the same shape [m]."""
    _check_road(samples)
    require(position.shape == height.shape, "Every position has a height")
    _road_heights(samples, len(samples), layout, position, position.size, height)


def above_chords(samples: FloatArray, layout: FloatArray, position: FloatArray) -> FloatArray:
    """Return how far a road lies above its chords on average, front and rear, then its first moments (n, 4) [m].

    Args:
        samples: Of the road's roughness.
        layout: Of the road.
        position: Of both axles at the chords' ends (2, n + 1) [m].
    """
    _check_road(samples)
    require(len(position) == 2 and position.shape[1] > 0, "Two axles")
    above = np.empty((position.shape[1] - 1, 4))
    _above_chords(samples, len(samples), layout, position, len(above), above)
    return above


def window_sizes(previewed: FloatArray, horizon: int, sizes: FloatArray) -> None:
    """Fill `Forecast.preview_norms` (4, windows) of what is previewed (3, windows + horizon - 1)."""
    kinds, count = previewed.shape
    require(kinds == _DISTURBANCES and 0 < horizon <= count, "A window of both roads and braking")
    require(sizes.shape == (1 + _DISTURBANCES, count - horizon + 1), "Four sizes of each window")
    _window_sizes(previewed, count, horizon, sizes)
