"""Whether the correlation of two drives is significant.

Signals of unrelated roads correlate somewhere, the more so the shorter the overlap and the smoother the signals. The
correlation r of random signals has a variance of sum(autocorrelation * autocorrelation) / samples (M. S. Bartlett, On
the theoretical specification and sampling properties of autocorrelated time-series, 1946): as if only one of several
samples were independent. Fisher's artanh r is then about normal, with a variance of one over the independent samples
less three.

Both signals are divided by their local RMS first, so that every metre of road counts alike: otherwise a bump, which is
the same on many roads, would decide nearly alone.
"""

from dataclasses import dataclass
from statistics import NormalDist

import numpy as np
from scipy.fft import irfft, next_fast_len, rfft
from scipy.ndimage import uniform_filter1d

from sim_core.arrays import FloatArray

FALSE_ALARM_RATE = 1e-4  # share of recordings of other roads that are placed
WINDOW_LENGTH = 10.0  # of the RMS that signals are divided by [m]
LEAST_RMS_SHARE = 0.1  # of the median RMS is added to it, so that a part with little motion keeps little
LONGEST_LAG = 20.0  # of an autocorrelation: beyond, signals are uncorrelated [m]
LEAST_ON_SMOOTH = 0.7  # likeness of a position on a smooth road, where only the bump can match


@dataclass(frozen=True, slots=True, kw_only=True)
class SignificanceTest:
    """A test whether signals at even distances correlate beyond chance.

    Attributes:
        spacing: Between samples [m].
        smooth: The road is smooth but for its bumps: only they can match, by LEAST_ON_SMOOTH.
    """

    spacing: float
    smooth: bool

    def informative_length(self, position: FloatArray, simulated: FloatArray) -> float:
        """Return the length of road that shows the position [m]: of a smooth one, from its first bump to its last."""
        if not self.smooth:
            return float(np.ptp(position))
        local = _local_mean_square(simulated - np.median(simulated, axis=1, keepdims=True), self.spacing).sum(axis=0)
        moves = position[local >= LEAST_RMS_SHARE**2 * local.max()]
        return float(np.ptp(moves)) if len(moves) else 0.0

    def normalise_locally(self, rows: FloatArray) -> FloatArray:
        """Return signals without their means, each divided by its RMS over WINDOW_LENGTH (signals, n)."""
        rows = rows - rows.mean(axis=1, keepdims=True)
        if self.smooth:
            return rows
        local = _local_mean_square(rows, self.spacing)
        least = LEAST_RMS_SHARE**2 * np.median(local, axis=1, keepdims=True) + 1e-6 * local.mean(axis=1, keepdims=True)
        normalised: FloatArray = rows / np.sqrt(local + least + 1e-300)
        return normalised

    def autocorrelations(self, rows: FloatArray) -> FloatArray:
        """Return auto- and cross-correlations at lags up to LONGEST_LAG both ways (signals, signals, lags)."""
        lags = min(int(LONGEST_LAG / self.spacing), rows.shape[1] // 2)
        size = next_fast_len(rows.shape[1] + lags, real=True)
        spectrum, norm = rfft(rows, size), np.sqrt((rows**2).sum(axis=1)) + 1e-300
        both = irfft(spectrum[:, None] * np.conj(spectrum), size) / (norm[:, None, None] * norm[:, None])
        return np.concatenate([both[..., -lags:], both[..., : lags + 1]], axis=-1)

    def samples_per_independent_one(self, one: FloatArray, other: FloatArray) -> float:
        """Return the number of samples per independent sample, by the `autocorrelations` of both drives."""
        lags = (min(one.shape[-1], other.shape[-1]) - 1) // 2
        one, other = (each[..., each.shape[-1] // 2 - lags : each.shape[-1] // 2 + lags + 1] for each in (one, other))
        fading = 1 - np.abs(np.arange(-lags, lags + 1)) / (lags + 1)
        return max(1.0, float((one * other * fading).sum()) / len(one) ** 2)

    def score(self, likeness: FloatArray, samples: FloatArray, per_independent: float) -> FloatArray:
        """Return the score in standard deviations (n,).

        Args:
            likeness: Mean correlations (n,).
            samples: That each was formed over (n,).
            per_independent: Samples per independent one.
        """
        fisher: FloatArray = np.arctanh(np.clip(likeness, 1e-6 - 1, 1 - 1e-6))
        return fisher if self.smooth else fisher * np.sqrt(np.maximum(samples / per_independent - 3, 0.0))

    def threshold(self, tried: float) -> float:
        """Return the score that the best of `tried` places exceeds by chance with FALSE_ALARM_RATE."""
        return float(np.arctanh(LEAST_ON_SMOOTH)) if self.smooth else NormalDist().inv_cdf(1 - FALSE_ALARM_RATE / tried)


def _local_mean_square(rows: FloatArray, spacing: float) -> FloatArray:
    """Return the mean square of each row over WINDOW_LENGTH (signals, n)."""
    return np.maximum(uniform_filter1d(rows**2, int(WINDOW_LENGTH / spacing) | 1, axis=1, mode="nearest"), 0.0)
