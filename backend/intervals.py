"""Means over seeds and how sure they are."""

from dataclasses import dataclass
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
    """Mean of independent values and its 95 % interval (Student's t); needs two values for an interval."""
    return means_with_intervals(np.reshape(values, (-1, 1)))[0]


def change_with_interval(values: ArrayLike, base: ArrayLike) -> Interval:
    """Change of the mean of `values` against the mean of `base` [%], paired (the same seeds), with its 95 % interval.

    The ratio of means by linearisation (Cochran 1977, Sampling Techniques, 6.4): with r = mean(values)/mean(base),
    its standard error is that of the mean of (values - r·base)/mean(base). NaN against a zero base.
    """
    return changes_with_intervals(np.reshape(values, (-1, 1)), np.reshape(base, (-1, 1)))[0]


def means_with_intervals(samples: ArrayLike) -> list[Interval]:
    """`mean_with_interval` of each column of `samples`, shape (values, quantities)."""
    sample = np.asarray(samples, dtype=np.float64)
    mean = sample.mean(axis=0)
    return _around(mean, _half_widths(sample))


def changes_with_intervals(samples: ArrayLike, bases: ArrayLike) -> list[Interval]:
    """`change_with_interval` of each column of `samples` against that of `bases` (values, quantities)."""
    above, below = np.asarray(samples, dtype=np.float64), np.asarray(bases, dtype=np.float64)
    if above.shape != below.shape:
        raise ValueError("Paired values are as many as their base")
    mean = below.mean(axis=0)
    mean[mean == 0] = nan
    ratio = above.mean(axis=0) / mean
    return _around(100 * (ratio - 1), 100 * _half_widths((above - ratio * below) / mean))


def _half_widths(sample: NDArray[np.float64]) -> NDArray[np.float64]:
    """Half the width of the interval of each column's mean; NaN for a single value."""
    count = len(sample)
    if count < 2:
        return np.full(sample.shape[1:], nan)
    half: NDArray[np.float64] = _quantile(count) * sample.std(axis=0, ddof=1) / sqrt(count)
    return half


def _around(values: NDArray[np.float64], halves: NDArray[np.float64]) -> list[Interval]:
    ends = zip(values.tolist(), (values - halves).tolist(), (values + halves).tolist(), strict=True)
    return [Interval(value=value, low=low, high=high) for value, low, high in ends]


def _quantile(count: int) -> float:
    """Student's t for the two-sided interval of a mean of `count` values."""
    from scipy.special import stdtrit  # takes a tenth of a second: most processes never need it

    return float(stdtrit(count - 1, (1 + CONFIDENCE) / 2))
