"""The weighting Wk of ISO 2631-1 in the frequency domain."""

from typing import Any

import numpy as np
from numpy.typing import NDArray
from scipy.fft import next_fast_len

Array = NDArray[np.floating[Any]]


def wk(frequency: Array) -> Array:
    """Complex Wk(f) of ISO 2631-1: two-pole high and low pass, acceleration-velocity transition, upward step."""
    s = 2j * np.pi * np.asarray(frequency, dtype=float)
    w1, w2, w3, w4, w5, w6 = (2 * np.pi * f for f in (0.4, 100, 12.5, 12.5, 2.37, 3.35))
    high = s**2 / (s**2 + np.sqrt(2) * w1 * s + w1**2)
    low = w2**2 / (s**2 + np.sqrt(2) * w2 * s + w2**2)
    transition = (1 + s / w3) / (1 + s / (0.63 * w4) + (s / w4) ** 2)
    step = (1 + s / (0.91 * w5) + (s / w5) ** 2) / (1 + s / (0.91 * w6) + (s / w6) ** 2) * (w5 / w6) ** 2
    response: Array = high * low * transition * step
    return response


def weighted(acceleration: Array, step: float) -> Array:
    """Acceleration through Wk from rest: spectrum of the record, padded with 20 s so that its start stays clean.

    And somewhat more, up to a number of samples without large prime factors: others take ten times as long.
    """
    n = len(acceleration)
    padded = next_fast_len(n + int(20 / step), real=True)
    spectrum = np.fft.rfft(acceleration, padded)
    return np.fft.irfft(spectrum * wk(np.fft.rfftfreq(padded, step)), padded)[:n]
