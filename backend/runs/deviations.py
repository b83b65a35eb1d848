"""Deviations between the curves of a run's strategies, aligned by position. Runs in a worker: no web here."""

from collections.abc import Mapping
from math import sqrt

import numpy as np
from pydantic import Field

from backend.models import Answer, by_strategy, keys_of
from backend.runs.series import ROWS, SeriesArray
from sim_core.arrays import FloatArray
from sim_core.catalogue import METRIC_SIGNALS, SIGNALS

POINTS = 20_000  # of each strategy: every sample of a usual run
COMPARED = ("speed", *METRIC_SIGNALS)


class Deviation(Answer):
    """One signal of a strategy against the baseline's, where both have it; null where no place has both."""

    rms: float | None = Field(description="Of the difference, over the road [the signal's unit]")
    peak: float | None = Field(description="Largest magnitude of the difference")
    baseline_rms: float | None = Field(description="Of the baseline's signal there")
    correlation: float | None = Field(description="Coefficient of both; null where one stands still")


class Deviations(Answer):
    """Curves against those of one strategy, at the same positions."""

    baseline: str = Field(description="The strategy that differences are against")
    units: dict[str, str] = keys_of(SIGNALS, "Of each signal")
    strategies: dict[str, dict[str, Deviation]] = by_strategy()


def deviations(series: Mapping[str, SeriesArray], baseline: str) -> dict[str, dict[str, Deviation]]:
    """By strategy and signal; the baseline itself is left out."""
    base = series[baseline].astype(np.float64)
    return {
        name: {key: _deviation(base, each.astype(np.float64), ROWS[key]) for key in COMPARED}
        for name, each in series.items()
        if name != baseline
    }


def _deviation(base: FloatArray, other: FloatArray, row: int) -> Deviation:
    """RMS over distance, by trapezoids between the other's samples."""
    position, at = base[ROWS["position"]], other[ROWS["position"]]
    inside = (at >= position[0]) & (at <= position[-1]) & np.isfinite(other[row])
    there, ours = at[inside], np.interp(at[inside], position, base[row])
    weight = np.gradient(there) if len(there) > 1 else np.zeros(len(there))
    if not weight.sum() > 0 or not np.isfinite(ours).all():
        return Deviation(rms=None, peak=None, baseline_rms=None, correlation=None)
    weight = weight / weight.sum()
    theirs = other[row][inside]
    a, b = ours - weight @ ours, theirs - weight @ theirs
    size = sqrt((weight @ (a * a)) * (weight @ (b * b)))
    return Deviation(
        rms=sqrt(weight @ (theirs - ours) ** 2),
        peak=float(np.abs(theirs - ours).max()),
        baseline_rms=sqrt(weight @ ours**2),
        correlation=float(weight @ (a * b)) / size if size else None,
    )
