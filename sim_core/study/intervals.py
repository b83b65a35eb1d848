"""Means over seeds and how sure they are."""

from dataclasses import dataclass
from math import nan, sqrt

import numpy as np
from numpy.typing import ArrayLike

CONFIDENCE = 0.95


@dataclass(frozen=True, slots=True, kw_only=True)
class Interval:
    """An estimate and the two ends of its confidence interval; NaN where there is none."""

    value: float
    low: float
    high: float


def mean_with_interval(values: ArrayLike) -> Interval:
    """Mean of independent values and its 95 % interval (Student's t); needs two values for an interval."""
    sample = np.asarray(values, dtype=np.float64)
    mean = float(sample.mean())
    half = _quantile(len(sample)) * float(sample.std(ddof=1)) / sqrt(len(sample)) if len(sample) > 1 else nan
    return Interval(value=mean, low=mean - half, high=mean + half)


def change_with_interval(values: ArrayLike, base: ArrayLike) -> Interval:
    """Change of the mean of `values` against the mean of `base` [%], paired (the same seeds), with its 95 % interval.

    The ratio of means by linearisation (Cochran 1977, Sampling Techniques, 6.4): with r = mean(values)/mean(base),
    its standard error is that of the mean of (values - r·base)/mean(base). NaN against a zero base.
    """
    above, below = np.asarray(values, dtype=np.float64), np.asarray(base, dtype=np.float64)
    if len(above) != len(below):
        raise ValueError("Paired values are as many as their base")
    mean = float(below.mean())
    if mean == 0:
        return Interval(value=nan, low=nan, high=nan)
    ratio = float(above.mean()) / mean
    spread = mean_with_interval((above - ratio * below) / mean)
    half = spread.high - spread.value
    return Interval(value=100 * (ratio - 1), low=100 * (ratio - half - 1), high=100 * (ratio + half - 1))


def _quantile(count: int) -> float:
    """Student's t for the two-sided interval of a mean of `count` values."""
    from scipy.special import stdtrit  # takes a tenth of a second: most processes never need it

    return float(stdtrit(count - 1, (1 + CONFIDENCE) / 2))
