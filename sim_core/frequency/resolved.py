"""Angles that resolve a sampled loop's curves, and the search for their maxima and zeros between them.

On the unit circle a loop's response is a rational function of z = exp(jθ). How fast it can change at θ is set by the
distance to its nearest pole, so an interval that is short beside that distance hides no peak: a maximum inside shows as
a sample that is no smaller than its neighbours, whatever the loop. Two zeros that are closer than the samples lie on
either side of such a maximum, which is therefore looked for first.

All curves are even in θ and in θ - π, so the samples go on mirrored beyond both ends.
"""

from collections.abc import Callable

import numpy as np
from numpy.typing import NDArray

from sim_core.arrays import FloatArray

ComplexArray = NDArray[np.complex128]
IntArray = NDArray[np.intp]
Curves = Callable[[FloatArray], FloatArray]  # angles (n,) -> values (curves, n)

NEAREST = 1e-9  # a pole that is nearer to the unit circle is resolved as if it were as far away as this
_EDGE = 1e-9  # the first angle and, from π, the last: an odd curve over sin θ is even, and not defined at the ends
_SHARE = 0.5  # of the distance to the nearest pole: the longest interval there
_FIRST = 16  # intervals that are divided from there on
_HALVINGS = 14  # of the interval around a maximum, whose error then is below 1e-8 of its height
_STEPS = 40  # at most, of the search for zeros


def distance(angle: FloatArray, poles: ComplexArray) -> FloatArray:
    """Return how far exp(jθ) is from the nearest of the poles (m,), at each angle θ (n,) [rad]."""
    return np.asarray(np.abs(np.exp(1j * angle)[:, None] - poles).min(axis=1, initial=2.0))


def resolving_grid(poles: ComplexArray) -> FloatArray:
    """Return angles between 0 and π [rad] whose intervals are short beside the distance to the nearest pole (m,)."""
    even = np.linspace(_EDGE, np.pi - _EDGE, _FIRST + 1)
    return divided(even, lambda angle: _SHARE * np.maximum(distance(angle, poles), NEAREST))


def divided(edges: FloatArray, longest: Callable[[FloatArray], FloatArray]) -> FloatArray:
    """Return the ascending edges of intervals, halved until none is longer than what `longest` says of its middle."""
    while True:
        middle = (edges[1:] + edges[:-1]) / 2
        long = np.diff(edges) > longest(middle)
        if not long.any():
            return edges
        edges = np.sort(np.concatenate([edges, middle[long]]))


def refined_maxima(curves: Curves, grid: FloatArray, values: FloatArray, level: FloatArray) -> FloatArray:
    """Return the angles (m,) [rad] of maxima that reach a level between samples which stay below it.

    Args:
        curves: Gives the values of all curves.
        grid: Angles that resolve them (n,) [rad].
        values: Their values there (curves, n).
        level: Of each curve (curves,).
    """
    grid = np.concatenate([[-grid[1]], grid, [2 * np.pi - grid[-2]]])
    before, behind = np.roll(values, 1, axis=1), np.roll(values, -1, axis=1)
    before[:, 0], behind[:, -1] = values[:, 1], values[:, -2]
    highest = 2 * values - np.minimum(before, behind)  # a parabola rises by at most a quarter of that above its samples
    reaches = (values <= level[:, None]) & (highest >= level[:, None])
    curve, index = np.nonzero((values >= before) & (values >= behind) & reaches)
    own = np.arange(len(curve))
    low, middle, high, value = grid[index], grid[index + 1], grid[index + 2], values[curve, index]
    for _ in range(_HALVINGS if len(curve) else 0):
        left, right = (low + middle) / 2, (middle + high) / 2
        at_both = curves(np.concatenate([left, right]))
        at_left, at_right = at_both[curve, own], at_both[curve, len(curve) + own]
        cases = [(at_left > value) & (at_left >= at_right), (at_right > value) & (at_right > at_left)]
        value = np.select(cases, [at_left, at_right], value)
        low, middle, high = (
            np.select(cases, [low, middle], left),
            np.select(cases, [left, right], middle),
            np.select(cases, [middle, high], right),
        )
    return np.clip(np.minimum(np.abs(middle), 2 * np.pi - np.abs(middle)), grid[1], grid[-2])


def zeros(curves: Curves, grid: FloatArray, values: FloatArray) -> tuple[IntArray, FloatArray]:
    """Find where sampled curves (curves, n) change their signs: of which curve (m,), at which angle (m,) [rad].

    All are searched for together by the Illinois method, regula falsi whose end that stays counts half (Dowell and
    Jarratt, BIT 11, 168-174, 1971).
    """
    above = values >= 0
    curve, change = np.nonzero(above[:, 1:] != above[:, :-1])
    own = np.arange(len(curve))
    low, high, at_low, at_high = grid[change], grid[change + 1], values[curve, change], values[curve, change + 1]
    for _ in range(_STEPS if len(curve) else 0):
        between = high - at_high * (high - low) / (at_high - at_low)
        if np.array_equal(between, high):
            break
        value = curves(between)[curve, own]
        stays = (value >= 0) == (at_high >= 0)
        low, at_low = np.where(stays, low, high), np.where(stays, at_low / 2, at_high)
        high, at_high = between, value
    return curve, high
