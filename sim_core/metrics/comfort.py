"""ISO 2631-1 frequency weighting Wk of vertical acceleration."""

from math import factorial, pi, sqrt

import numpy as np

from sim_core.arrays import FloatArray
from sim_core.caching import small_cached

Quadratic = tuple[float, float, float]  # coefficients, highest power first
Quotient = tuple[Quadratic, Quadratic]  # numerator and denominator

# ISO 2631-1:1997, table A.1, principal weighting Wk: frequencies [Hz] and quality factors.
F1, F2, F3, F4, Q4, F5, Q5, F6, Q6 = 0.4, 100.0, 12.5, 12.5, 0.63, 2.37, 0.91, 3.35, 0.91
_BUTTERWORTH = 1 / sqrt(2)
_TERMS = 25  # of a series in z: the fastest pole turns by 0.6 rad in a step of 1 ms


def _resonance(frequency: float, quality: float) -> Quadratic:
    """s² + ω/Q s + ω²."""
    omega = 2 * pi * frequency
    return 1.0, omega / quality, omega**2


def wk_quotients() -> tuple[Quotient, ...]:
    """Wk(s) as quotients: both band limits, acceleration-velocity transition, upward step (ISO 2631-1, annex A)."""
    w2, w3, w4 = 2 * pi * F2, 2 * pi * F3, 2 * pi * F4
    return (
        ((1.0, 0.0, 0.0), _resonance(F1, _BUTTERWORTH)),
        ((0.0, 0.0, w2**2), _resonance(F2, _BUTTERWORTH)),
        ((0.0, w4**2 / w3, w4**2), _resonance(F4, Q4)),
        (_resonance(F5, Q5), _resonance(F6, Q6)),
    )


def wk_gain(frequency: FloatArray) -> FloatArray:
    """|Wk| at frequencies [Hz]."""
    s = 2j * pi * np.asarray(frequency)
    return np.asarray(np.abs(np.prod([np.polyval(b, s) / np.polyval(a, s) for b, a in wk_quotients()], axis=0)))


@small_cached(128)
def weighting(step: float) -> FloatArray:
    """Wk over steps [s] between samples that are straight in between (24,), as `struct weighting` of kernel/record.c.

    In partial fractions: each pole p has the residue r and is half of a pair q' = p q + r a, which a step from sample a
    to b takes to e^z q + r h (φ1(z) a + φ2(z) (b - a)), z = p h, φ1(z) = (e^z - 1) / z, φ2(z) = (φ1(z) - 1) / z.
    """
    quotients = wk_quotients()
    pole = np.array([(-a1 + 1j * sqrt(4 * a0 - a1**2)) / 2 for _, (_, a1, a0) in quotients])
    residue = 1 / (2j * pole.imag)
    for i, (b, a) in enumerate(quotients):
        residue = residue * np.polyval(b, pole) / np.where(np.arange(len(pole)) == i, 1.0, np.polyval(a, pole))
    z = pole * step
    second = sum(z**k / factorial(k + 2) for k in range(_TERMS))
    first = 1 + z * second
    modes = np.array([1 + z * first, residue * step * (first - second), residue * step * second])
    return np.concatenate([part for mode in modes for part in (mode.real, mode.imag)])
