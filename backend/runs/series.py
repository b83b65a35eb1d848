"""Time histories: packed into one array, decimated, and in JSON.

A series array has shape (signals, samples), float32, rows in the catalogue's order (`sim_core.catalogue.SIGNALS`).
"""

import base64
import itertools
from collections.abc import Iterable, Sequence

import numpy as np
from numpy.typing import NDArray

from backend.json_types import JsonObject
from sim_core.catalogue import SIGNALS
from sim_core.result import StrategyResult

SeriesArray = NDArray[np.float32]
ROWS = {key: row for row, key in enumerate(SIGNALS)}
ALWAYS = ("time", "position")


def ordered_signals(signals: Iterable[str] | None) -> list[str]:
    """The signals asked for in the catalogue's order, always with time and position; None is all."""
    keys = set(SIGNALS if signals is None else signals) | set(ALWAYS)
    return [key for key in SIGNALS if key in keys]


def pack(result: StrategyResult, points: int | None = None) -> SeriesArray:
    """A result's time histories as one array; about `points` samples, or all."""
    array = np.empty((len(SIGNALS), len(result.series["time"])), dtype=np.float32)
    for key, row in ROWS.items():
        array[row] = result.series[key]
    return decimate(array, points, [span.start_time for span in result.stages[1:]])


def decimate(series: SeriesArray, points: int | None, breaks: Sequence[float] = ()) -> SeriesArray:
    """About `points` samples of a series, the same ones for all signals, with every peak kept.

    Half of the samples lie evenly. The other half are those that straight lines between these miss most (relative
    to the signal's range), at most one in each half of a gap, so that a spike gets its flanks. Added is each
    signal's largest and smallest value between two `breaks`.

    Args:
        series: Shape (signals, samples), its first row the time [s].
        points: How many samples, or None for all.
        breaks: Times [s] at which a window begins or ends whose own extremes have to survive.
    """
    count = series.shape[1]
    if points is None or points >= count:
        return series
    half = -(-count // points)
    stride, gaps = 2 * half, (count - 1) // (2 * half)
    nodes = np.arange(gaps + 1) * stride
    fraction = np.arange(stride, dtype=np.float32) / np.float32(stride)
    missed = np.zeros((gaps, stride), dtype=np.float32)
    for row in series:  # one at a time: all at once would take several times the series' own memory
        start, step = row[nodes[:-1], None], np.diff(row[nodes])[:, None]
        away = np.abs(row[: gaps * stride].reshape(gaps, stride) - (start + step * fraction))
        np.maximum(missed, away / (np.ptp(row) or 1), out=missed)
    halves = missed.reshape(2 * gaps, half)
    worst = np.arange(2 * gaps) * half + halves.argmax(axis=1)
    most_missed = worst[np.argsort(halves.max(axis=1))[gaps:]]
    keep = np.concatenate([nodes, most_missed, [count - 1], _extremes(series, breaks)])
    return np.take(series, np.unique(keep), axis=1)


def _extremes(series: SeriesArray, breaks: Sequence[float]) -> NDArray[np.int64]:
    """Indices of each signal's extremes in each window between the breaks."""
    cuts = np.searchsorted(series[0], np.asarray(breaks, dtype=np.float32))
    edges = np.unique(np.concatenate([[0], cuts, [series.shape[1]]]))
    extremes = [
        start + extreme(series[:, start:end], axis=1)
        for start, end in itertools.pairwise(edges)
        for extreme in (np.argmin, np.argmax)
    ]
    return np.concatenate(extremes)


def packed(values: NDArray[np.float32]) -> dict[str, str]:
    """One signal in plotly's typed-array form: little-endian float32 in base64."""
    data = np.ascontiguousarray(values, dtype="<f4")
    return {"dtype": "f4", "bdata": base64.b64encode(data.data).decode("ascii")}


def as_json(series: SeriesArray, signals: Iterable[str], encoding: str) -> JsonObject:
    """By signal its values, as lists (`list`) or typed arrays (`base64`)."""
    if encoding == "base64":
        return {key: packed(series[ROWS[key]]) for key in signals}
    return {key: series[ROWS[key]] for key in signals}
