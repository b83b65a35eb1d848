"""Roughness, waviness and class of a measured road (ISO 8608): the line through its smoothed displacement PSD.

docs/explanation/road.md has the steps and the formulas.
"""

from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np

from sim_core.arrays import FloatArray
from sim_core.road.profile import REFERENCE_FREQUENCY
from sim_core.scenario.road import CLASS_MEANS

LOWEST, HIGHEST = 0.011, 2.83  # of the line's frequencies [1/m], ISO 8608
OCTAVES, THIRDS = 0.0312 * 2**0.5, 0.0312 * 2 ** (1 / 2 + 8 / 3)  # bands are an octave up to here, a third up to there
SHORTEST = 20.0  # of a road whose PSD reaches the reference frequency [m]
_UNALIASED = 0.125  # of the sampling frequency: up to there a fold of the PSD adds 5 % at most where waviness is 2
_NEXT, _SECOND = 4 / 9, 1 / 36  # correlation of a Hann-tapered periodogram's ordinates with the next and the second
_FEWEST_BANDS = 4
WIDEST = 16.0
"""Of the interval of a road with a class, end over end [1]: two classes.

Generated roads from 50 m on stay below it; from 100 m on also with a bump of 0.1 m, a washboard, or slabs.
"""


@dataclass(frozen=True, slots=True, kw_only=True)
class Estimate:
    """A value with its 95 % interval."""

    value: float
    low: float
    high: float

    @property
    def span(self) -> float:
        """How many times the interval's lower end the upper one is [1]."""
        return self.high / self.low


@dataclass(frozen=True, slots=True, kw_only=True)
class Classification:
    """The line Gd(n) = Gd(n0) (n/n0)^-w through a road's smoothed PSD.

    Attributes:
        iso_class: By Gd(n0), A to H; None where its interval spans more than a factor of 16.
        roughness: Gd(n0) [m³].
        waviness: w [1].
        frequency: Centres of the bands (bands,) [1/m].
        density: Mean PSD in each (bands,) [m³].
    """

    iso_class: str | None
    roughness: Estimate
    waviness: Estimate
    frequency: FloatArray
    density: FloatArray


def road_class(roughness: float) -> str:
    """Return the class of Gd(n0) [m³]: each ends at twice its mean, H never."""
    return next((name for name, mean in CLASS_MEANS.items() if roughness < 2 * mean), "H")


def smoothed_psd(tracks: Sequence[FloatArray], spacing: float) -> tuple[FloatArray, FloatArray, FloatArray]:
    """Centres [1/m] and mean one-sided PSD [m³] of the bands, and how many independent ordinates are in each.

    Each track (n,) [m] loses its best-fitting line and is tapered (Hann); the PSDs of several are averaged. Bands are
    an octave wide up to 0.0312 1/m, a third up to 0.25 1/m, a twelfth beyond (ISO 8608).
    """
    samples = len(tracks[0])
    x = np.linspace(-1, 1, samples)
    taper = np.sin(np.pi * np.arange(samples) / samples) ** 2
    levelled = [track - np.polyval(np.polyfit(x, track, 1), x) for track in tracks]
    scale = 2 * spacing / (taper @ taper)
    density = np.mean([np.abs(np.fft.rfft(taper * track)) ** 2 for track in levelled], axis=0) * scale
    frequency = np.fft.rfftfreq(samples, spacing)
    highest = min(HIGHEST, _UNALIASED / spacing)
    used = slice(2, int(np.searchsorted(frequency, highest, side="right")))  # the line took the longest wave with it
    frequency, density = frequency[used], density[used]
    thirds, twelfths = OCTAVES * 2 ** (np.arange(9) / 3), THIRDS * 2 ** (np.arange(1, 41) / 12)
    edges = np.concatenate([[LOWEST, OCTAVES / 2], thirds, twelfths])
    band = np.searchsorted(edges, frequency, side="right")
    counts = np.bincount(band, minlength=len(edges) + 1)[1:-1]
    sums = np.bincount(band, density, minlength=len(edges) + 1)[1:-1]
    filled, centres = counts > 0, np.sqrt(edges[1:] * edges[:-1])
    inside = counts[filled].astype(float)
    independent = inside**2 / (inside + 2 * _NEXT * (inside - 1) + 2 * _SECOND * np.maximum(0, inside - 2))
    return centres[filled], sums[filled] / inside, independent


def classified(tracks: Sequence[FloatArray], spacing: float) -> Classification | None:
    """The line through the smoothed PSD of tracks (n,) [m] so far apart [m]; None where the road has too few waves.

    Weighted least squares of log PSD over log frequency. The mean of K independent ordinates, each of chi-square with
    two degrees of freedom, has a log of known bias ψ(K) - log K and variance ψ'(K); where bands scatter by more, the
    intervals grow with them.
    """
    if spacing * (len(tracks[0]) - 1) < SHORTEST - 1e-6:
        return None
    frequency, density, independent = smoothed_psd(tracks, spacing)
    if len(frequency) < _FEWEST_BANDS or not (density > 0).all():
        return None
    from scipy.special import digamma, polygamma, stdtrit  # takes a tenth of a second: most processes never need it

    log_density = np.log(density) - digamma(independent) + np.log(independent)
    weight = 1 / polygamma(1, independent)
    basis = np.column_stack([np.ones_like(frequency), -np.log(frequency / REFERENCE_FREQUENCY)])
    covariance = np.linalg.inv(basis.T @ (weight[:, None] * basis))
    level, waviness = covariance @ (basis.T @ (weight * log_density))
    freedom = len(frequency) - 2
    scatter = float(weight @ (log_density - basis @ [level, waviness]) ** 2) / freedom
    half = stdtrit(freedom, 0.975) * np.sqrt(np.diag(covariance) * max(1.0, scatter))
    roughness = [float(np.exp(level + side * half[0])) for side in (0, -1, 1)]
    wavinesses = [float(waviness + side * half[1]) for side in (0, -1, 1)]
    fitted = Estimate(value=roughness[0], low=roughness[1], high=roughness[2])
    return Classification(
        iso_class=road_class(fitted.value) if fitted.span <= WIDEST else None,
        roughness=fitted,
        waviness=Estimate(value=wavinesses[0], low=wavinesses[1], high=wavinesses[2]),
        frequency=frequency,
        density=density,
    )
