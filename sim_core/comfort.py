"""ISO 2631-1 frequency weighting Wk of vertical acceleration, weighted RMS and vibration dose value."""

from functools import lru_cache
from math import pi, sqrt

import numpy as np
from scipy.signal import bilinear_zpk, sosfilt, zpk2sos

from sim_core.result import FloatArray

# ISO 2631-1:1997, table A.1, principal weighting Wk: frequencies [Hz] and quality factors.
F1, F2, F3, F4, Q4, F5, Q5, F6, Q6 = 0.4, 100.0, 12.5, 12.5, 0.63, 2.37, 0.91, 3.35, 0.91
_BUTTERWORTH = 1 / sqrt(2)


def _pair(frequency: float, quality: float) -> list[complex]:
    """Roots of s² + ω/Q s + ω²."""
    omega = 2 * pi * frequency
    return [complex(root) for root in np.roots([1.0, omega / quality, omega**2])]


def wk_zpk() -> tuple[list[complex], list[complex], float]:
    """Zeros, poles and gain of Wk(s): band limits, acceleration-velocity transition, upward step."""
    zeros = [0j, 0j, complex(-2 * pi * F3), *_pair(F5, Q5)]
    poles = [*_pair(F1, _BUTTERWORTH), *_pair(F2, _BUTTERWORTH), *_pair(F4, Q4), *_pair(F6, Q6)]
    w2, w3, w4 = 2 * pi * F2, 2 * pi * F3, 2 * pi * F4
    # Low-pass w2², transition (1 + s/w3)·w4², step with unit gain well above F6 scaled as the standard has it.
    return zeros, poles, w2**2 * w4**2 / w3


def wk_gain(frequency: FloatArray) -> FloatArray:
    """|Wk| at frequencies [Hz]."""
    zeros, poles, gain = wk_zpk()
    s = 2j * pi * np.asarray(frequency)[..., None]
    return np.asarray(gain * np.abs(np.prod(s - zeros, axis=-1) / np.prod(s - poles, axis=-1)))


@lru_cache(maxsize=32)
def _sections(step: float) -> FloatArray:
    zeros, poles, gain = wk_zpk()
    z, p, k = bilinear_zpk(zeros, poles, gain, 1 / step)
    return np.asarray(zpk2sos(z, p, float(k)))  # type: ignore[arg-type]  # the stubs know no complex roots


def weighted(acceleration: FloatArray, step: float) -> FloatArray:
    """Acceleration (n,) [m/s^2], sampled every `step` [s], through Wk."""
    return np.asarray(sosfilt(_sections(step), acceleration))


def vibration_dose(weighted_acceleration: FloatArray, step: float) -> float:
    """VDV = (∫ a_w⁴ dt)^¼ [m/s^1.75] (ISO 2631-1, 6.3.2)."""
    square = weighted_acceleration**2
    return float((np.dot(square, square) * step) ** 0.25)
