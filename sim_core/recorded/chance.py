"""How far a likeness of two drives is beyond what chance gives.

Roads that have nothing to do with each other are alike somewhere, the more so the shorter the overlap and the smoother
the signals. The correlation r of random signals has a variance of sum(autocorrelation * autocorrelation) / samples
(M. S. Bartlett, On the theoretical specification and sampling properties of autocorrelated time-series, 1946): as if
only each so many samples were independent. Fisher's artanh r is then about normal, with a variance of one over the
independent samples less three.

Both signals are divided by their own RMS nearby first, so that every metre of road says as much as another: else a
bump, which is the same on many roads, would say nearly all.
"""

from dataclasses import dataclass
from statistics import NormalDist

import numpy as np
from scipy.fft import irfft, next_fast_len, rfft
from scipy.ndimage import uniform_filter1d

from sim_core.arrays import FloatArray

FALSE_PLACES = 1e-4  # a recording of another road is placed so often
NEARBY = 10.0  # over which an RMS is that nearby [m]
LEAST_NEARBY = 0.1  # of the usual RMS nearby: a part that is stiller stays stiller
MEMORY = 20.0  # no signal is like itself over a longer distance [m]
LEAST_ON_SMOOTH = 0.7  # likeness of a place on a smooth road, where the bump is all there is


@dataclass(frozen=True, slots=True, kw_only=True)
class Chance:
    """Judges likeness of signals at even distances.

    Attributes:
        spacing: Between samples [m].
        smooth: The road is smooth but for its bumps: they are all there is to be found, and chance has no part in it.
    """

    spacing: float
    smooth: bool

    def telling(self, position: FloatArray, simulated: FloatArray) -> float:
        """Length of the road on which a simulated drive tells where it is [m]: of a smooth road from bump to bump."""
        if not self.smooth:
            return float(np.ptp(position))
        nearby = _nearby(simulated - np.median(simulated, axis=1, keepdims=True), self.spacing).sum(axis=0)
        moves = position[nearby >= LEAST_NEARBY**2 * nearby.max()]
        return float(np.ptp(moves)) if len(moves) else 0.0

    def equalised(self, rows: FloatArray) -> FloatArray:
        """Signals without their means, each divided by its RMS nearby (signals, n)."""
        rows = rows - rows.mean(axis=1, keepdims=True)
        if self.smooth:
            return rows
        nearby = _nearby(rows, self.spacing)
        least = LEAST_NEARBY**2 * np.median(nearby, axis=1, keepdims=True) + 1e-6 * nearby.mean(axis=1, keepdims=True)
        equalised: FloatArray = rows / np.sqrt(nearby + least + 1e-300)
        return equalised

    def memory(self, rows: FloatArray) -> FloatArray:
        """Correlation of each signal with each at distances up to `MEMORY` both ways (signals, signals, lags)."""
        lags = min(int(MEMORY / self.spacing), rows.shape[1] // 2)
        size = next_fast_len(rows.shape[1] + lags, real=True)
        spectrum, norm = rfft(rows, size), np.sqrt((rows**2).sum(axis=1)) + 1e-300
        both = irfft(spectrum[:, None] * np.conj(spectrum), size) / (norm[:, None, None] * norm[:, None])
        return np.concatenate([both[..., -lags:], both[..., : lags + 1]], axis=-1)

    def samples_apart(self, one: FloatArray, other: FloatArray) -> float:
        """Every how many samples of the mean correlation are independent, by the `memory` of both drives' signals."""
        lags = (min(one.shape[-1], other.shape[-1]) - 1) // 2
        one, other = (each[..., each.shape[-1] // 2 - lags : each.shape[-1] // 2 + lags + 1] for each in (one, other))
        fading = 1 - np.abs(np.arange(-lags, lags + 1)) / (lags + 1)
        return max(1.0, float((one * other * fading).sum()) / len(one) ** 2)

    def score(self, likeness: FloatArray, samples: FloatArray, apart: float) -> FloatArray:
        """How many standard deviations a mean correlation over so many samples lies beyond none (n,)."""
        fisher: FloatArray = np.arctanh(np.clip(likeness, 1e-6 - 1, 1 - 1e-6))
        return fisher if self.smooth else fisher * np.sqrt(np.maximum(samples / apart - 3, 0.0))

    def least_score(self, tried: float) -> float:
        """The score that the best of so many independent places reaches by chance so rarely as `FALSE_PLACES`."""
        return float(np.arctanh(LEAST_ON_SMOOTH)) if self.smooth else NormalDist().inv_cdf(1 - FALSE_PLACES / tried)


def _nearby(rows: FloatArray, spacing: float) -> FloatArray:
    """Return the mean square of each row nearby (signals, n)."""
    return np.maximum(uniform_filter1d(rows**2, int(NEARBY / spacing) | 1, axis=1, mode="nearest"), 0.0)
