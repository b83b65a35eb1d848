"""The C's functions, one in Python for each: what they do is said beside them in C.

Every array is checked, its type, order and shape as well as that it fits the others: C reads and writes nothing else.
Each function raises ValueError where sizes disagree, and ctypes.ArgumentError where an array is not C-contiguous
float64, or cannot be written into. Calls that are made at every step are in prepared.py.
"""

from collections.abc import Sequence
from functools import lru_cache

import numpy as np
from numpy.typing import NDArray

from sim_core.arrays import FloatArray
from sim_core.kernel.library import DOUBLE, INT, NAME, Array, Function, require

LAYOUT = 9  # numbers of `struct layout`
_MOST_FUZZY_SETS, _DISTURBANCES = 20, 3
_LINE, _TABLE, _LINES = Array(ndim=1), Array(ndim=2), Array(ndim=3)
_LINE_OUT, _TABLE_OUT, _LINES_OUT = (Array(ndim=ndim, written=True) for ndim in (1, 2, 3))
_ROAD = _LINE, INT, Array(LAYOUT)
_INTEGERS = Array(ndim=1, dtype=np.intc)

_recurrence = Function("recurrence", _TABLE, INT, INT, _TABLE_OUT)
_torque_shares = Function(
    "torque_shares", _LINE, _TABLE, INT, Array(ndim=2, dtype=np.intc), INT, _TABLE, INT, INT, _LINE_OUT
)
_roughness = Function("roughness", _LINE_OUT, INT, DOUBLE, DOUBLE, DOUBLE, result=DOUBLE)
_road_heights = Function("road_heights", *_ROAD, Array(), INT, Array(written=True))
_within_steps = Function("within_steps", *_ROAD, _TABLE, INT, _TABLE_OUT)
_disturbances = Function("disturbances", _TABLE, _LINE, INT, DOUBLE, _TABLE_OUT)
_sections = Function(
    "sections", _LINES, INT, _INTEGERS, INT, INT, _TABLE, INT, _TABLE_OUT, _TABLE_OUT, _LINE_OUT, _TABLE_OUT
)
_power = Function("power", _LINES, _LINES, INT, _LINES_OUT)
_kink_peaks = Function(
    "kink_peaks",
    *(*_ROAD, _TABLE, _TABLE, INT, _LINES, _TABLE, INT, INT),
    *(Array(2, 2), _LINE, _TABLE, _LINE, INT, _TABLE_OUT),
)
_shape_number = Function("shape_number", NAME, result=INT)
_integrand_number = Function("integrand_number", NAME, result=INT)


def bump_numbers(
    shape: str, count: int, start: float, height: float, width: float, spacing: float, until: float
) -> FloatArray:
    """`struct bump` of kernel/road.h; lengths in m."""
    number = _shape_number(shape.encode())
    require(number >= 0, f"C knows no bump of the shape {shape}")
    return np.array([number, count, start, height, width, spacing, until], dtype=np.float64)


def road_layout(first: float, grid: float, bump: FloatArray) -> FloatArray:
    """`struct layout` of kernel/road.h; lengths in m."""
    return np.array([first, grid, *bump])


@lru_cache(maxsize=64)
def integrand_numbers(names: tuple[str, ...]) -> NDArray[np.intc]:
    """The numbers of `enum integrand` in kernel/sections.c."""
    numbers = np.array([_integrand_number(name.encode()) for name in names], dtype=np.intc)
    require(bool((numbers >= 0).all()), f"C knows not every integrand of {names}")
    return numbers


def recurrence(matrix: FloatArray, states: FloatArray) -> None:
    """x[i + 1] = M x[i] + f[i] over many steps, in place.

    Args:
        matrix: M (n, n).
        states: x[0], then the inputs f[0], f[1], …, which become x[1], x[2], … (steps + 1, n).
    """
    steps, n = len(states) - 1, states.shape[-1]
    require(matrix.shape == (n, n) and steps >= 0, "A recurrence needs a square matrix as wide as its states")
    _recurrence(matrix, n, steps, states)


def torque_shares(
    distance: FloatArray, errors: FloatArray, rules: NDArray[np.intc], memberships: FloatArray, shares: FloatArray
) -> None:
    """Fill `shares` (n,) by rules (m, 3): the set of the distance and of the error, -1 for any, and of the torque.

    Args:
        distance: Memberships of one distance in its sets (sets,).
        errors: Of each error in its sets (sets, n).
        rules: As above.
        memberships: Of torque shares from 0 to 1 in their sets (sets, samples).
        shares: The torque's.
    """
    sets, samples = memberships.shape
    require(errors.shape[1] == len(shares) and samples > 1, "Every error has a share")
    require(rules.shape[1:] == (3,), "A rule has three sets")
    named = (rules >= (-1, -1, 0)).all() and (rules < (len(distance), len(errors), sets)).all()
    require(bool(named), "A rule asks for sets there are, and concludes one")
    require(sets <= _MOST_FUZZY_SETS, "The torque has at most twenty sets")
    _torque_shares(distance, errors, len(shares), rules, len(rules), memberships, sets, samples - 1, shares)


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


def within_steps(samples: FloatArray, layout: FloatArray, position: FloatArray, within: FloatArray) -> None:
    """Fill means and moments above chords (n, 4) [m] of the road between positions of both axles (2, n + 1) [m]."""
    _check_road(samples)
    steps = len(within)
    require(position.shape == (2, steps + 1) and within.shape == (steps, 4), "Two axles, one position more than steps")
    _within_steps(samples, len(samples), layout, position, steps, within)


def disturbances(height: FloatArray, braking: FloatArray, step: float, held: FloatArray) -> None:
    """Fill `held`, 3 n numbers in rows, from heights (2, n + 1) [m] and braking (n,) [m/s^2] in steps [s]."""
    steps = len(braking)
    require(height.shape == (2, steps + 1) and held.size == _DISTURBANCES * steps, "As many heights as steps, and one")
    _disturbances(height, braking, steps, step, held)


def _check_ends(ends: FloatArray, last: int) -> None:
    require(ends.shape[1:] == (2,), "A section has two ends")
    inside = all(0 <= begin <= end <= last for begin, end in ends.tolist())
    require(inside, "A section ends behind its beginning and within the record")


def sections(
    table: FloatArray, integrands: Sequence[str], ends: FloatArray, sums: FloatArray, peaks: FloatArray
) -> FloatArray:
    """Fill sums (signals, n) and peaks (n, signals) of a table (signals, fine + 1, commands) over sections (n, 2).

    Returns:
        Largest magnitude under each command (signals, commands).
    """
    signals, samples, commands = table.shape
    fine, count = samples - 1, len(ends)
    fits = sums.shape == (signals, count) and peaks.shape == (count, signals) and fine > 0
    require(fits and len(integrands) == signals, "Every signal has an integrand, and a sum and a peak in each section")
    _check_ends(ends, fine * commands)
    work, highest = np.empty(commands), np.empty((signals, commands))
    kinds = integrand_numbers(tuple(integrands))
    _sections(table, signals, kinds, fine, commands, ends, count, sums, peaks, work, highest)
    return highest


def power(force: FloatArray, speed: FloatArray, both: FloatArray) -> None:
    """Fill the power of both axles (1, …) [W] from their forces (2, …) [N] and speeds (2, …) [m/s]."""
    require(force.shape == speed.shape == (2, *both.shape[1:]) and len(both) == 1, "Two axles of one shape")
    _power(force, speed, both.size, both)


def kink_peaks(
    samples: FloatArray,
    layout: FloatArray,
    position: FloatArray,
    height: FloatArray,
    loads: FloatArray,
    highest: FloatArray,
    tyres: FloatArray,
    kinks: FloatArray,
    ends: FloatArray,
    rise: FloatArray,
    peaks: FloatArray,
) -> None:
    """Raise the peaks (2, sections) [N] of both axles' loads (2, fine + 1, commands) [N] at kinks of the road.

    Args:
        samples: Of the road's roughness (m,) [m].
        layout: Of the road (9,).
        position: Of both axles at every fine instant up to the record's end (2, n) [m].
        height: Of the road there [m].
        loads: On record.
        highest: Their largest magnitude under each command (2, commands) [N].
        tyres: Stiffness [N/m] and lowest load [N] of each (2, 2).
        kinks: Of the bumps, ascending to infinity [m].
        ends: Of the sections (sections, 2) [fine steps].
        rise: How far their road leaves a chord at most (sections,) [m].
        peaks: As above.
    """
    _check_road(samples)
    fine, commands, instants = loads.shape[1] - 1, loads.shape[2], position.shape[1]
    fits = position.shape == height.shape == (2, instants) and highest.shape == (2, commands) and len(loads) == 2
    require(fits and instants > fine * commands > 0, "A record has as many fine steps as its road")
    require(len(ends) == len(rise) and peaks.shape == (2, len(rise)), "Every section has a rise and a peak")
    require(bool(np.isfinite(position[:, [0, -1]]).all()) and kinks[-1] == np.inf, "An axle is somewhere, no kink last")
    _check_ends(ends, fine * commands)
    _kink_peaks(
        *(samples, len(samples), layout, position, height, instants, loads, highest, fine, commands),
        *(tyres, kinks, ends, rise, len(rise), peaks),
    )
