"""ISO 2631-1 frequency weighting Wk of vertical acceleration, weighted RMS and vibration dose value."""

from math import pi, sqrt

import numpy as np

from sim_core.filters import Quadratic, Quotient, filtered
from sim_core.result import FloatArray

# ISO 2631-1:1997, table A.1, principal weighting Wk: frequencies [Hz] and quality factors.
F1, F2, F3, F4, Q4, F5, Q5, F6, Q6 = 0.4, 100.0, 12.5, 12.5, 0.63, 2.37, 0.91, 3.35, 0.91
_BUTTERWORTH = 1 / sqrt(2)


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


def weighted(acceleration: FloatArray, step: float) -> FloatArray:
    """Acceleration (n,) [m/s^2], sampled every `step` [s], through Wk."""
    for quotient in wk_quotients():
        acceleration = filtered(acceleration, quotient, step)
    return acceleration


def vibration_dose(weighted_acceleration: FloatArray, step: float) -> float:
    """VDV = (∫ a_w⁴ dt)^¼ [m/s^1.75] (ISO 2631-1, 6.3.2)."""
    square = weighted_acceleration**2
    return float((np.dot(square, square) * step) ** 0.25)
