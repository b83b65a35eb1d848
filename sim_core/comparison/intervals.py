"""Estimate means over roads and changes between them, with confidence intervals."""

from dataclasses import dataclass
from functools import lru_cache
from math import nan, sqrt

import numpy as np
from numpy.typing import ArrayLike, NDArray

CONFIDENCE = 0.95


@dataclass(frozen=True, slots=True, kw_only=True)
class Interval:
    """An estimate and the two ends of its confidence interval; NaN where there is none."""

    value: float
    low: float
    high: float


def mean_with_interval(values: ArrayLike) -> Interval:
    """Return the mean of independent values and its 95 % interval (Student's t); of one value the interval is NaN."""
    return means_with_intervals(np.reshape(values, (-1, 1)))[0]


def change_with_interval(values: ArrayLike, base: ArrayLike) -> Interval:
    """Return the change of the mean of `values` against that of `base` [%], paired by road, with its 95 % interval.

    The ratio of means by linearisation (Cochran 1977, Sampling Techniques, 6.4): with r = mean(values)/mean(base),
    its standard error is that of the mean of (values - r·base)/mean(base). NaN against a zero base.
    """
    return changes_with_intervals(np.reshape(values, (-1, 1)), np.reshape(base, (-1, 1)))[0]


def means_with_intervals(samples: ArrayLike) -> list[Interval]:
    """Return `mean_with_interval` for each column of `samples` (roads, metrics)."""
    sample = np.asarray(samples, dtype=np.float64)
    mean = sample.mean(axis=0)
    return _around(mean, _half_widths(sample))


def changes_with_intervals(samples: ArrayLike, bases: ArrayLike) -> list[Interval]:
    """Return `change_with_interval` for each column of `samples` against that of `bases` (roads, metrics).

    Raises:
        ValueError: They are not of one shape.
    """
    above, below = np.asarray(samples, dtype=np.float64), np.asarray(bases, dtype=np.float64)
    if above.shape != below.shape:
        raise ValueError("Paired values are as many as their base")
    mean = below.mean(axis=0)
    mean[mean == 0] = nan
    ratio = above.mean(axis=0) / mean
    return _around(100 * (ratio - 1), 100 * _half_widths((above - ratio * below) / mean))


def _half_widths(sample: NDArray[np.float64]) -> NDArray[np.float64]:
    """Return half the width of the interval of each column's mean; NaN for a single value."""
    count = len(sample)
    if count < 2:
        return np.full(sample.shape[1:], nan)
    half: NDArray[np.float64] = _quantile(count) * sample.std(axis=0, ddof=1) / sqrt(count)
    return half


def _around(values: NDArray[np.float64], halves: NDArray[np.float64]) -> list[Interval]:
    ends = zip(values.tolist(), (values - halves).tolist(), (values + halves).tolist(), strict=True)
    return [Interval(value=value, low=low, high=high) for value, low, high in ends]


@lru_cache
def _quantile(count: int) -> float:
    """Return Student's t for the two-sided interval of a mean of `count` values."""
    from scipy.special import stdtrit  # takes a tenth of a second: most processes never need it

    return float(stdtrit(count - 1, (1 + CONFIDENCE) / 2))
