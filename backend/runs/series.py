"""Time histories: packed into one array, decimated, and in JSON.

A series array has shape (signals, samples), float32, rows in the catalogue's order (`sim_core.catalogue.SIGNALS`).
"""

import base64
import itertools
from collections.abc import Iterable, Mapping, Sequence
from dataclasses import dataclass
from functools import partial
from math import ceil
from typing import Self

import numpy as np
from numpy.typing import NDArray

from backend.json_types import JsonObject
from sim_core.catalogue import BUMP, SIGNALS
from sim_core.result import StrategyResult
from sim_core.scenario import Scenario
from sim_core.strategies import driven, strategy_named
from sim_core.workload import duration, samples

SeriesArray = NDArray[np.float32]
ROWS = {key: row for row, key in enumerate(SIGNALS)}
ALWAYS = ("time", "position")
BEFORE, BEHIND = 0.6, 0.9  # parts of the bump's length that are shown around it, as the page does


def ordered_signals(signals: Iterable[str] | None) -> list[str]:
    """The signals asked for in the catalogue's order, always with time and position; None is all."""
    keys = set(SIGNALS if signals is None else signals) | set(ALWAYS)
    return [key for key in SIGNALS if key in keys]


def pack(result: StrategyResult, points: int | None = None) -> SeriesArray:
    """A result's time histories as one array; about `points` samples, or all."""
    array = np.empty((len(SIGNALS), len(result.series["time"])), dtype=np.float32)
    for key, row in ROWS.items():
        array[row] = result.series[key]
    return decimate(array, points, Stages.of((span.stage, span.start_time, span.end_time) for span in result.stages))


@dataclass(frozen=True, slots=True)
class Stages:
    """Where a run's samples matter most.

    Attributes:
        breaks: Times [s] at which a window begins or ends whose own extremes have to survive.
        bump: First and last time [s] of the bump with some road around it, which gets half of the samples.
    """

    breaks: tuple[float, ...] = ()
    bump: tuple[float, float] | None = None

    @classmethod
    def of(cls, spans: Iterable[tuple[str, float, float]]) -> Self:
        """From each stage's name, start and end [s], in their order."""
        _, *later = listed = list(spans)
        bumps = [
            (start - BEFORE * (end - start), end + BEHIND * (end - start))
            for stage, start, end in listed
            if stage == BUMP
        ]
        return cls(tuple(start for _, start, _ in later), bumps[0] if bumps else None)


def decimate(series: SeriesArray, points: int | None, stages: Stages | None = None) -> SeriesArray:
    """About `points` samples of a series, the same ones for all signals, every peak among them.

    Half of them are spent on the bump, where there is one. Added is each signal's largest and smallest value in each
    stage.

    Args:
        series: Shape (signals, samples), its first row the time [s].
        points: How many samples, or None for all.
        stages: Of the run.
    """
    count, stages = series.shape[1], stages or Stages()
    if points is None or points >= count:
        return series
    spans = np.ptp(series, axis=1)
    first, last = np.searchsorted(series[0], stages.bump or ()).tolist() or (0, count)
    if stages.bump is None or 2 * (last - first) >= count:
        keep = [_most_telling(series, spans, points)]
    else:
        around = count - (last - first)
        keep = [
            start + _most_telling(series[:, start:end], spans, max(2, share))
            for start, end, share in (
                (0, first, points * first // (2 * around)),
                (first, last, points // 2),
                (last, count, points * (count - last) // (2 * around)),
            )
        ]
    return np.take(series, np.unique(np.concatenate([*keep, [0, count - 1], _extremes(series, stages.breaks)])), axis=1)


def _most_telling(series: SeriesArray, spans: NDArray[np.float32], points: int) -> NDArray[np.int64]:
    """Indices of about `points` samples.

    Half of them lie evenly. The other half are those that straight lines between these miss most (relative to the
    signal's span), at most one in each half of a gap, so that a spike gets its flanks.
    """
    count = series.shape[1]
    if points >= count:
        return np.arange(count)
    half = -(-count // points)
    stride, gaps = 2 * half, (count - 1) // (2 * half)
    nodes = np.arange(gaps + 1) * stride
    fraction = np.arange(stride, dtype=np.float32) / np.float32(stride)
    missed = np.zeros((gaps, stride), dtype=np.float32)
    for row, span in zip(series, spans, strict=True):  # one at a time: all at once would take several times the memory
        start, step = row[nodes[:-1], None], np.diff(row[nodes])[:, None]
        away = np.abs(row[: gaps * stride].reshape(gaps, stride) - (start + step * fraction))
        np.maximum(missed, away / (span or 1), out=missed)
    halves = missed.reshape(2 * gaps, half)
    worst = np.arange(2 * gaps) * half + halves.argmax(axis=1)
    most_missed = worst[np.argsort(halves.max(axis=1))[gaps:]]
    return np.concatenate([nodes, most_missed])


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


def unpacked(values: Mapping[str, str]) -> NDArray[np.float32]:
    """The values of a typed array."""
    return np.frombuffer(base64.b64decode(values["bdata"]), dtype="<f4")


def as_json(series: Mapping[str, SeriesArray], signals: Iterable[str], encoding: str) -> JsonObject:
    """By signal its values for `pieces.write_json`, as lists (`list`) or typed arrays (`base64`)."""
    if encoding == "base64":
        return {key: partial(packed, series[key]) for key in signals}
    return {key: series[key] for key in signals}


def by_signal(series: SeriesArray) -> dict[str, SeriesArray]:
    """The rows of a series array by their signals."""
    return dict(zip(SIGNALS, series, strict=True))


def most_samples(scenario: Scenario, strategy: str) -> int:
    """About the most samples that the strategy's time histories have."""
    driving = driven(strategy_named(strategy), scenario.speed.policy)
    steps, fine = samples(scenario, driving, duration(scenario, strategy))
    return ceil(steps) * fine
