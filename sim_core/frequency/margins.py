"""How far a sampled loop is from instability: gain and phase margins loop at a time, and the disk margin of both.

The loop is broken where the command leaves the controller for the actuators. Disk margins: Seiler, Packard and Gahinet,
An Introduction to Disk Margins, IEEE Control Systems Magazine 40 (2020), with skew 0.
"""

from dataclasses import dataclass
from math import asin, atan, inf, pi

import numpy as np
from numpy.typing import NDArray

from sim_core.arrays import FloatArray
from sim_core.frequency.sampled_loop import ComplexArray, SampledLoop

_POINTS = 240  # per loop; between them crossings are searched for
_LOWEST = 0.02  # [Hz]
_STEPS = 12  # of that search, which takes an interval of the grid to rounding


@dataclass(frozen=True, slots=True, kw_only=True)
class LoopMargin:
    """Of one axle's loop, the other one closed.

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
    """Of a strategy's loop.

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
    """Of a stable loop."""
    top = 0.5 / loop.step
    grid = 2 * pi * np.append(np.geomspace(_LOWEST, top, _POINTS)[:-1], top)
    M = transfer(loop, grid)
    sensitivity = np.asarray(np.linalg.inv(np.eye(2) - M), dtype=np.complex128)
    largest = float(_structured(sensitivity - np.eye(2) / 2).max())
    disk = 1 / largest
    curve, crossing = _crossings(loop, grid, M)
    ends = _single(np.concatenate([transfer(loop, np.zeros(1)), M[-1:]])).real  # real at both ends
    at_crossing = _single(transfer(loop, crossing))
    front, rear = (
        _margin(
            np.append(at_crossing[axle, curve == 2 * axle].real, ends[axle]),
            at_crossing[axle, curve == 2 * axle + 1],
            crossing[curve == 2 * axle + 1],
        )
        for axle in (0, 1)
    )
    return Margins(
        front=front,
        rear=rear,
        disk=disk,
        disk_gain=(2 + disk) / (2 - disk) if disk < 2 else inf,
        disk_phase=2 * atan(disk / 2),
    )


def transfer(loop: SampledLoop, omega: FloatArray) -> ComplexArray:
    """From the command at the actuators to that of the controller (frequencies, 2, 2); 1 is the critical point."""
    z = np.exp(1j * omega * loop.step)
    inner = loop.A + loop.C @ loop.K
    return np.asarray(loop.K @ np.linalg.solve(z[:, None, None] * np.eye(len(inner)) - inner, loop.B.astype(complex)))


def _single(M: ComplexArray) -> ComplexArray:
    """Negative loop gain of each axle, the other one's loop closed (2, frequencies)."""
    around = M[:, 0, 1] * M[:, 1, 0]
    front, rear = M[:, 0, 0], M[:, 1, 1]
    return np.asarray([-(front + around / (1 - rear)), -(rear + around / (1 - front))])


def _margin(at_real: FloatArray, at_unit: ComplexArray, unit: FloatArray) -> LoopMargin:
    """By a loop's gains where they are real (m,), and where their magnitude is 1 (n,), at those angular frequencies."""
    factors = -1 / at_real[at_real < 0]
    phases = 2 * np.abs(np.array([asin(min(abs(1 + each) / 2, 1)) for each in at_unit]))
    lags = np.mod(np.angle(at_unit) + pi, 2 * pi)
    return LoopMargin(
        gain=min(factors[factors > 1].tolist(), default=None),
        gain_reduction=max(factors[factors < 1].tolist(), default=None),
        phase=min(phases.tolist(), default=None),
        delay=min((lags / unit).tolist(), default=None),
    )


def _crossings(loop: SampledLoop, grid: FloatArray, M: ComplexArray) -> tuple[NDArray[np.intp], FloatArray]:
    """Where the curves of `_curves` change their signs: of which curve (n,), at which angular frequency (n,).

    All are searched for together by the Illinois method, regula falsi whose end that stays counts half (Dowell and
    Jarratt, BIT 11, 168-174, 1971).
    """
    values = _curves(M)
    curve, change = np.nonzero(np.sign(values[:, 1:]) * np.sign(values[:, :-1]) < 0)
    low, high, at_low, at_high = grid[change], grid[change + 1], values[curve, change], values[curve, change + 1]
    for _ in range(_STEPS if len(low) else 0):
        between = high - at_high * (high - low) / (at_high - at_low)
        value = _curves(transfer(loop, between))[curve, np.arange(len(curve))]
        stays = np.sign(value) == np.sign(at_high)
        low, at_low = np.where(stays, low, high), np.where(stays, at_low / 2, at_high)
        high, at_high = between, value
    return curve, high


def _curves(M: ComplexArray) -> FloatArray:
    """Imaginary part and magnitude - 1 of the front axle's loop gain, then of the rear one's (4, frequencies)."""
    return np.asarray([curve for gain in _single(M) for curve in (gain.imag, np.abs(gain) - 1)])


def _structured(M: ComplexArray) -> FloatArray:
    """The structured singular value of each matrix (frequencies, 2, 2) for two complex factors on the diagonal.

    Scaled by diag(d, 1) a matrix keeps its determinant, so its largest singular value is least where its Frobenius norm
    is: |m12| d = |m21| / d. For two blocks that bound is the value itself (Packard and Doyle 1993).
    """
    norm = np.abs(M[:, 0, 0]) ** 2 + np.abs(M[:, 1, 1]) ** 2 + 2 * np.abs(M[:, 0, 1] * M[:, 1, 0])
    product = np.abs(np.linalg.det(M)) ** 2
    return np.asarray(np.sqrt((norm + np.sqrt(np.maximum(norm**2 - 4 * product, 0))) / 2))
