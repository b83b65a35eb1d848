"""Time histories: packed into one array, decimated, and in JSON.

A series array has shape (signals, samples), float32, rows in the catalogue's order (`sim_core.catalogue.SIGNALS`).
"""

import base64
from collections.abc import Callable, Iterable, Mapping, Sequence
from dataclasses import dataclass
from functools import partial
from itertools import pairwise
from math import ceil
from typing import Self

import numpy as np
from numpy.typing import NDArray

from backend.cost.estimate import duration, samples
from backend.json_types import JsonObject
from backend.outcome import Sampling
from sim_core import Scenario, StrategyResult
from sim_core.catalogue import BUMP, SIGNALS
from sim_core.result import Series
from sim_core.scenario.recorded import recording_id
from sim_core.strategies import strategies, strategy_named
from sim_core.tables.drives import MOST_SAMPLES

SeriesArray = NDArray[np.float32]
ROWS = {key: row for row, key in enumerate(SIGNALS)}
SAMPLE_BYTES = 4 * len(SIGNALS)  # of a series array
ALWAYS = ("time", "position")
BEFORE, AFTER = 0.6, 0.9  # parts of the bump's length that are shown around it, as the page does


def ordered_signals(signals: Iterable[str] | None) -> list[str]:
    """Return the signals asked for in the catalogue's order, always with time and position; None is all."""
    keys = set(SIGNALS if signals is None else signals) | set(ALWAYS)
    return [key for key in SIGNALS if key in keys]


def pack(result: StrategyResult, sampling: Sampling | None = None) -> SeriesArray:
    """Return a result's time histories as one array; those samples, or all."""
    series = result.series if sampling is None or sampling.part is None else _on_bump(result)
    count = len(series["time"])
    if sampling is None or sampling.points >= count:
        array = np.empty((len(SIGNALS), count), dtype=np.float32)
        for number, key in enumerate(SIGNALS):
            array[number] = series.between(key, 0, count)
        return array
    stages = SamplingHints.of((span.stage, span.start_time, span.end_time) for span in result.stages)
    one_by_one = (series.between(key, 0, count, np.float32) for key in SIGNALS)  # all of a long run take 130 MB
    time = series.between("time", 0, count, np.float32)
    shown = shown_samples(time, one_by_one, len(SIGNALS), sampling.points, stages)
    return np.array([series.at(key, shown) for key in SIGNALS], dtype=np.float32)


def pack_all(result: StrategyResult) -> SeriesArray:
    """Return a result's time histories as one array, with two samples at each instant at which a held force jumps."""
    series = result.series
    count = len(series["time"]) + len(series.jumps)
    array = np.empty((len(SIGNALS), count), dtype=np.float32)
    for number, key in enumerate(SIGNALS):
        array[number] = series.with_jumps(key, 0, count, np.float32)
    return array


def _on_bump(result: StrategyResult) -> Series:
    """Return the time histories around the bump, if there is one; lines lead to a sample more on either side."""
    for span in result.stages:
        if span.stage == BUMP:
            position = result.series["position"]
            first, last = np.searchsorted(position, around(span.start_position, span.end_position)).tolist()
            return result.series.of_commands(max(0, first - 1), min(len(position), last + 1))
    return result.series


def around(start: float, end: float) -> tuple[float, float]:
    """Return the bump with some road around it, of its two ends in time or on the road."""
    return start - BEFORE * (end - start), end + AFTER * (end - start)


@dataclass(frozen=True, slots=True)
class SamplingHints:
    """Places at which a run's samples matter most.

    Attributes:
        breaks: Times [s] at which a window begins or ends whose own extremes have to survive.
        bump: First and last time [s] of the bump with some road around it, which gets half of the samples.
    """

    breaks: tuple[float, ...] = ()
    bump: tuple[float, float] | None = None

    @classmethod
    def of(cls, spans: Iterable[tuple[str, float, float]]) -> Self:
        """Make them from each stage's name, start and end [s], in their order."""
        _, *later = listed = list(spans)
        bumps = [around(start, end) for stage, start, end in listed if stage == BUMP]
        return cls(tuple(start for _, start, _ in later), bumps[0] if bumps else None)


def decimate(series: SeriesArray, points: int | None, stages: SamplingHints) -> SeriesArray:
    """Return at most `points` samples of a series whose first signal is the time, or all: those of `shown_samples`."""
    if points is None or points >= series.shape[1]:
        return series
    shown = shown_samples(series[0], series, len(series), points, stages)
    return series.take(shown, axis=1)  # row by row, as JSON is written


def shown_samples(
    time: SeriesArray, signals: Iterable[SeriesArray], signal_count: int, points: int, stages: SamplingHints
) -> NDArray[np.intp]:
    """Return which samples to show, at most `points`, the same ones for all signals.

    Up to half of them are the first, the last, and peaks: each signal's largest and smallest value of the run, then
    those that it has in each stage, on the bump before others. Every one is among them where `points` is four times
    the signals for each stage, and four. A quarter lie evenly, half of these on the bump, where there is one. The
    others are those that straight lines between these miss most (relative to the signal's span), at most one in each
    half of a gap, so that a spike gets its flanks.

    Args:
        time: Of each sample (samples,) [s].
        signals: Each (samples,).
        signal_count: How many signals there are.
        points: At least 2, and fewer than there are samples.
        stages: Of the run.

    Returns:
        Their places in ascending order.
    """
    count = len(time)
    cuts = np.searchsorted(time, np.asarray(stages.breaks, dtype=np.float32)).tolist()
    windows = np.array(sorted({0, *cuts, count}), dtype=np.intc)
    bump = np.searchsorted(time, stages.bump or ()).tolist() or (0, count)
    most_peaks = max(2, min(points // 2, 2 * signal_count * (len(windows) - 1) + 2))
    gaps = _gaps(count, bump, (points - most_peaks) // 2)
    missed = [np.zeros(stride * number, dtype=np.float32) for _, stride, number in gaps]
    extremes, shown = np.zeros(count, dtype=np.uint8), np.zeros(count, dtype=bool)

    def mark(values: SeriesArray) -> None:
        _mark_extremes(values, windows, extremes)
        _raise_missed(values, gaps, missed)

    shown[_peaks(signals, mark, extremes, bump)[:most_peaks]] = True
    places, away = [np.zeros(0, dtype=np.intp)], [np.zeros(0, dtype=np.float32)]
    for (start, stride, number), misses in zip(gaps, missed, strict=True):
        shown[start + np.arange(number + 1) * stride] = True
        halves = misses.reshape(2 * number, stride // 2)
        places.append(start + np.arange(2 * number) * (stride // 2) + halves.argmax(axis=1))
        away.append(halves.max(axis=1))
    best = np.concatenate(places)[np.argsort(-np.concatenate(away), kind="stable")]
    best = best[~shown[best]]
    shown[best[: points - np.count_nonzero(shown)]] = True
    return np.flatnonzero(shown)


def _gaps(count: int, bump: tuple[int, int], points: int) -> list[tuple[int, int, int]]:
    """Return equal gaps between samples that lie evenly, of which there are at most so many, half of them on the bump.

    Returns:
        Of each part of the run its first sample, the even number of samples from one to the next, and how many gaps.
    """
    first, last = bump
    around = count - (last - first)
    parts = [(0, count, points)]
    if around > last - first:
        outside = (points - points // 2) / around
        after = int(outside * (count - last))
        parts = [(0, first, int(outside * first)), (first, last, points // 2), (last, count, after)]
    gaps = []
    for start, end, few in parts:
        stride = 2 * ceil((end - start) / (2 * few)) if few else count
        if (number := (end - start - 1) // max(stride, 2)) > 0:
            gaps.append((start, max(stride, 2), number))
    return gaps


def _peaks(
    signals: Iterable[SeriesArray],
    mark: Callable[[SeriesArray], None],
    extremes: NDArray[np.uint8],
    bump: tuple[int, int],
) -> list[int]:
    """Return the ends and every signal's largest and smallest values, those that have to be shown most first.

    Args:
        signals: Each (samples,).
        mark: Marks a signal's extremes of each stage in `extremes`.
        extremes: Of each sample whether it is one; none is yet.
        bump: First sample of the bump, and the first one after it.
    """
    of_run: list[int] = [0, len(extremes) - 1]
    for signal in signals:
        mark(signal)
        places = np.flatnonzero(extremes)
        values = signal[places]
        if not np.isnan(values).all():
            of_run += [int(places[np.nanargmax(values)]), int(places[np.nanargmin(values)])]
    of_stages = np.flatnonzero(extremes)
    on_bump = (of_stages >= bump[0]) & (of_stages < bump[1])
    return list(dict.fromkeys([*of_run, *of_stages[on_bump].tolist(), *of_stages[~on_bump].tolist()]))


def _mark_extremes(values: SeriesArray, windows: NDArray[np.intc], extremes: NDArray[np.uint8]) -> None:
    """Mark the smallest and the largest sample of each window of one signal; NaN are passed over.

    Args:
        values: (samples,).
        windows: First sample of each, and one after the last of all.
        extremes: 1 where a sample is one (samples,).
    """
    for first, last in pairwise(windows.tolist()):
        window = values[first:last]
        places = window.argmin(), window.argmax()  # of the first NaN where there is one
        if np.isnan(window[places[0]]) and not np.isnan(window).all():
            places = np.nanargmin(window), np.nanargmax(window)
        extremes[first + np.array(places)] = 1


def _raise_missed(
    values: SeriesArray, gaps: Sequence[tuple[int, int, int]], missed: Sequence[NDArray[np.float32]]
) -> None:
    """Raise each sample's miss to that of one signal: by how much of its span the line across its gap misses it.

    Args:
        values: (samples,).
        gaps: As `_gaps` returns them.
        missed: Of each part of the run, of each sample of each gap; NaN are passed over.
    """
    span = np.fmax.reduce(values) - np.fmin.reduce(values)
    for (start, stride, number), misses in zip(gaps, missed, strict=True):
        ends = values[start : start + stride * number + 1 : stride]
        share = np.arange(stride, dtype=np.float32) / np.float32(stride)
        away = (ends[:-1, None] + np.diff(ends)[:, None] * share).ravel()
        np.abs(np.subtract(values[start : start + len(away)], away, out=away), out=away)
        away /= span if span > 0 else 1
        np.fmax(misses, away, out=misses)


def packed(values: NDArray[np.float32]) -> dict[str, str]:
    """Return one signal in plotly's typed-array form: little-endian float32 in base64."""
    data = np.ascontiguousarray(values, dtype="<f4")
    return {"dtype": "f4", "bdata": base64.b64encode(data.data).decode("ascii")}


def unpacked(values: Mapping[str, str]) -> NDArray[np.float32]:
    """Return the values of a typed array."""
    return np.frombuffer(base64.b64decode(values["bdata"]), dtype="<f4")


def as_json(values: Callable[[str], SeriesArray], signals: Iterable[str], encoding: str) -> JsonObject:
    """Return by signal its `values` for `pieces.write_json`, as lists (`list`) or typed arrays (`base64`)."""

    def typed(key: str) -> JsonObject:
        return {**packed(values(key))}

    return {key: partial(typed if encoding == "base64" else values, key) for key in signals}


def most_samples(scenario: Scenario, strategy: str, *, jumps: bool = False) -> int:
    """Return about the most samples that the strategy's time histories have, with those before `jumps` or without."""
    if recording_id(strategy) is not None:
        return MOST_SAMPLES
    name = strategy if strategy in strategies() else "lv"  # none has more than it: one that is gone may be pinned
    steps, fine = samples(scenario, strategy_named(name), duration(scenario, name))
    return ceil(steps) * (fine + jumps)
