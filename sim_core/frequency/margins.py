"""How far a sampled loop is from instability: gain and phase margins loop at a time, and the disk margin of both.

The loop is broken where the command leaves the controller for the actuators. Disk margins: Seiler, Packard and Gahinet,
An Introduction to Disk Margins, IEEE Control Systems Magazine 40 (2020), with skew 0.

On the unit circle a loop's response is a rational function of z = exp(jθ). How fast it can change at θ is set by the
distance to its nearest pole, so an interval that is short beside that distance hides no peak: a maximum inside shows as
a sample that is no smaller than its neighbours, whatever the loop. Two zeros that are closer than the samples lie on
either side of such a maximum, which is therefore looked for first.

All curves are even in θ and in θ - π, so the samples go on mirrored beyond both ends.
"""

from collections.abc import Callable
from dataclasses import dataclass
from math import asin, atan, inf, pi

import numpy as np
from numpy.typing import NDArray

from sim_core.arrays import FloatArray
from sim_core.frequency.sampled_loop import ComplexArray, SampledLoop

Curves = Callable[[FloatArray], FloatArray]  # angles (n,) -> values (curves, n)
_CROSSED = 4  # curves whose zeros are looked for
NEAREST = 1e-9  # a pole that is nearer to the unit circle is resolved as if it were as far away as this
_EDGE = 1e-9  # the first angle and, from π, the last: an odd curve over sin θ is even, and not defined at the ends
_SHARE = 0.5  # of the distance to the nearest pole: the longest interval there
_FIRST = 16  # intervals that are divided from there on
_HALVINGS = 14  # of the interval around a maximum, whose error then is below 1e-8 of its height
_STEPS = 40  # at most, of the search for zeros


@dataclass(frozen=True, slots=True, kw_only=True)
class LoopMargin:
    """Margins of one axle's loop, the other one closed.

    Attributes:
        gain: The loop becomes unstable where its gain is multiplied by this, above 1 [1]; None: by no factor.
        gain_reduction: The same below 1 [1]; None: by no factor.
        phase: Phase that the loop can lose [rad]; None: its gain is nowhere 1.
        delay: The delay that makes of it, at the frequency where that is least [s].
    """

    gain: float | None
    gain_reduction: float | None
    phase: float | None
    delay: float | None


@dataclass(frozen=True, slots=True, kw_only=True)
class Margins:
    """Margins of a strategy's loop.

    Attributes:
        front: Of the front axle's loop.
        rear: Of the rear axle's.
        disk: α of both together, each perturbed on its own [1].
        disk_gain: Both gains may change at the same time by any factor between 1 / this and this [1].
        disk_phase: And both phases by this, either way [rad].
    """

    front: LoopMargin
    rear: LoopMargin
    disk: float
    disk_gain: float
    disk_phase: float


def margins(loop: SampledLoop) -> Margins:
    """Return the margins of a stable loop, each at the frequency where it is least, however narrow the peak there."""

    def curves(angle: FloatArray) -> FloatArray:
        return _curves(loop, angle)

    def both_signs(angle: FloatArray) -> FloatArray:
        values = curves(angle)
        return np.concatenate([values, -values[:_CROSSED]])

    poles = _poles(loop)
    grid = resolving_grid(poles)
    values = both_signs(grid)
    level = np.zeros(len(values))
    level[_CROSSED] = values[_CROSSED].max()
    grid = np.sort(np.append(grid, refined_maxima(both_signs, grid, values, level)))
    values = curves(grid)
    crossed, crossing = zeros(curves, grid, values[:_CROSSED])
    largest = max(values[_CROSSED].max(), curves(crossing)[_CROSSED].max(initial=0.0))
    disk = float(1 / largest)
    ends = np.array([0, pi])
    ends = ends[distance(ends, poles) > NEAREST]  # every response is real there
    front, rear = (
        _loop_margin(loop, axle, np.append(crossing[crossed == 2 * axle], ends), crossing[crossed == 2 * axle + 1])
        for axle in (0, 1)
    )
    return Margins(
        front=front,
        rear=rear,
        disk=disk,
        disk_gain=(2 + disk) / (2 - disk) if disk < 2 else inf,
        disk_phase=2 * atan(disk / 2),
    )


def transfer(loop: SampledLoop, angle: FloatArray) -> ComplexArray:
    """Return M, from the command at the actuators to that of the controller, at z = exp(j·angle) (angles, 2, 2).

    The critical point is 1.
    """
    inner = loop.A + loop.C @ loop.K
    resolvent = np.exp(1j * angle)[:, None, None] * np.eye(len(inner)) - inner
    return np.asarray(loop.K @ np.linalg.solve(resolvent, loop.B.astype(complex)))


def _poles(loop: SampledLoop) -> ComplexArray:
    """Return the poles of `transfer`, of either axle's loop gain and of the sensitivity (4 n,)."""
    front, rear = (np.outer(loop.B[:, axle], loop.K[axle]) for axle in (0, 1))
    opened = loop.A + loop.C @ loop.K
    return np.linalg.eigvals(np.stack([opened, opened + front, opened + rear, loop.closed])).astype(complex).ravel()


def _single(M: ComplexArray) -> ComplexArray:
    """Negative loop gain of each axle, the other one's loop closed (2, frequencies)."""
    around = M[:, 0, 1] * M[:, 1, 0]
    front, rear = M[:, 0, 0], M[:, 1, 1]
    return np.asarray([-(front + around / (1 - rear)), -(rear + around / (1 - front))])


def _loop_margin(loop: SampledLoop, axle: int, real: FloatArray, unit: FloatArray) -> LoopMargin:
    """Return an axle's margin by the angles [rad] where its gain is real (m,) and where that is 1 in magnitude (n,)."""
    at_real, at_unit = (_single(transfer(loop, each))[axle] for each in (real, unit))
    factors = -1 / at_real.real[at_real.real < 0]
    phases = [2 * asin(min(abs(1 + each) / 2, 1)) for each in at_unit]
    delays = np.mod(np.angle(at_unit) + pi, 2 * pi) / unit * loop.step
    return LoopMargin(
        gain=min(factors[factors > 1].tolist(), default=None),
        gain_reduction=max(factors[factors < 1].tolist(), default=None),
        phase=min(phases, default=None),
        delay=min(delays.tolist(), default=None),
    )


def _curves(loop: SampledLoop, angle: FloatArray) -> FloatArray:
    """Return what decides the margins, at each angle [rad] (5, angles).

    Of the front axle's loop gain, then of the rear one's: imaginary part over sin(angle), and magnitude - 1; then the
    disk's 1 / α. The first `_CROSSED` matter where they are zero, the last one where it is greatest.
    """
    M = transfer(loop, angle)
    disk = _structured(np.asarray(np.linalg.inv(np.eye(2) - M) - np.eye(2) / 2, dtype=np.complex128))
    return np.asarray([*(c for gain in _single(M) for c in (gain.imag / np.sin(angle), np.abs(gain) - 1)), disk])


def _structured(M: ComplexArray) -> FloatArray:
    """Return the structured singular value of each matrix (frequencies, 2, 2) for two complex factors on the diagonal.

    Scaled by diag(d, 1) a matrix keeps its determinant, so its largest singular value is least where its Frobenius norm
    is: |m12| d = |m21| / d. For two blocks that bound is the value itself (Packard and Doyle 1993).
    """
    norm = np.abs(M[:, 0, 0]) ** 2 + np.abs(M[:, 1, 1]) ** 2 + 2 * np.abs(M[:, 0, 1] * M[:, 1, 0])
    product = np.abs(np.linalg.det(M)) ** 2
    return np.asarray(np.sqrt((norm + np.sqrt(np.maximum(norm**2 - 4 * product, 0))) / 2))


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


def zeros(curves: Curves, grid: FloatArray, values: FloatArray) -> tuple[NDArray[np.intp], FloatArray]:
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
