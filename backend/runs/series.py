"""Time histories: packed into one array, decimated, and in JSON.

A series array has shape (signals, samples), float32, rows in the catalogue's order (`sim_core.catalogue.SIGNALS`).
"""

import base64
from collections.abc import Callable, Iterable, Mapping
from dataclasses import dataclass
from functools import partial
from math import ceil
from typing import Self

import numpy as np
from numpy.typing import NDArray

from backend.cost.estimate import duration, samples
from backend.csv_lines import MAX_LINES
from backend.json_types import JsonObject
from backend.outcome import Sampling
from sim_core import Scenario, StrategyResult
from sim_core.catalogue import BUMP, SIGNALS
from sim_core.kernel.binding import sample_marker
from sim_core.result import Series
from sim_core.scenario.recorded import recording_id
from sim_core.strategies import strategies, strategy_named

SeriesArray = NDArray[np.float32]
ROWS = {key: row for row, key in enumerate(SIGNALS)}
SAMPLE_BYTES = 4 * len(SIGNALS)  # of a series array
ALWAYS = ("time", "position")
BEFORE, AFTER = 0.6, 0.9  # parts of the bump's length that are shown around it, as the page does


def ordered_signals(signals: Iterable[str] | None) -> list[str]:
    """The signals asked for in the catalogue's order, always with time and position; None is all."""
    keys = set(SIGNALS if signals is None else signals) | set(ALWAYS)
    return [key for key in SIGNALS if key in keys]


def pack(result: StrategyResult, sampling: Sampling | None = None) -> SeriesArray:
    """A result's time histories as one array; those samples, or all."""
    series = result.series if sampling is None or sampling.part is None else _on_bump(result)
    count = len(series["time"])
    if sampling is None or sampling.points >= count:
        array = np.empty((len(SIGNALS), count), dtype=np.float32)
        for number, key in enumerate(SIGNALS):
            array[number] = series.between(key, 0, count)
        return array
    stages = SamplingHints.of((span.stage, span.start_time, span.end_time) for span in result.stages)
    one_by_one = (series.between(key, 0, count, np.float32) for key in SIGNALS)  # all of a long run take 130 MB
    shown = shown_samples(series.between("time", 0, count, np.float32), one_by_one, sampling.points, stages)
    return np.array([series.at(key, shown) for key in SIGNALS], dtype=np.float32)


def pack_all(result: StrategyResult) -> SeriesArray:
    """A result's time histories as one array, with two samples at each instant at which a held force jumps."""
    series = result.series
    count = len(series["time"]) + len(series.jumps)
    array = np.empty((len(SIGNALS), count), dtype=np.float32)
    for number, key in enumerate(SIGNALS):
        array[number] = series.with_jumps(key, 0, count, np.float32)
    return array


def _on_bump(result: StrategyResult) -> Series:
    """The time histories around the bump, if there is one; lines lead to a sample more on either side."""
    for span in result.stages:
        if span.stage == BUMP:
            position = result.series["position"]
            first, last = np.searchsorted(position, around(span.start_position, span.end_position)).tolist()
            return result.series.of_commands(max(0, first - 1), min(len(position), last + 1))
    return result.series


def around(start: float, end: float) -> tuple[float, float]:
    """The bump with some road around it, of its two ends in time or on the road."""
    return start - BEFORE * (end - start), end + AFTER * (end - start)


@dataclass(frozen=True, slots=True)
class SamplingHints:
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
        bumps = [around(start, end) for stage, start, end in listed if stage == BUMP]
        return cls(tuple(start for _, start, _ in later), bumps[0] if bumps else None)


def decimate(series: SeriesArray, points: int | None, stages: SamplingHints) -> SeriesArray:
    """About `points` samples of a series whose first signal is the time, or all: those of `shown_samples`."""
    if points is None or points >= series.shape[1]:
        return series
    return series.take(shown_samples(series[0], series, points, stages), axis=1)  # row by row, as JSON is written


def shown_samples(
    time: SeriesArray, signals: Iterable[SeriesArray], points: int, stages: SamplingHints
) -> NDArray[np.intp]:
    """About `points` of all samples, the same ones for all signals, every peak among them.

    Half of them are spent on the bump, where there is one. Half of each part's lie evenly. The others are those that
    straight lines between these miss most (relative to the signal's span), at most one in each half of a gap, so that a
    spike gets its flanks. Added is each signal's largest and smallest value in each stage.

    Args:
        time: Of each sample (samples,) [s].
        signals: Each (samples,).
        points: How many samples; fewer than there are.
        stages: Of the run.

    Returns:
        Their places in ascending order.
    """
    count = len(time)
    first, last = np.searchsorted(time, stages.bump or ()).tolist() or (0, count)
    around = count - (last - first)
    parts = [(0, count, points)]
    if around > last - first:
        parts = [
            (0, first, max(2, points * first // (2 * around))),
            (first, last, max(2, points // 2)),
            (last, count, max(2, points * (count - last) // (2 * around))),
        ]
    shown = np.zeros(count, dtype=np.uint8)
    shown[[0, -1]] = 1
    gaps = []
    for start, end, few in parts:
        half = -(-(end - start) // few)
        if half > 1:
            gaps.append((start, 2 * half, (end - start - 1) // (2 * half)))
        else:
            shown[start:end] = 1
    table = np.array(gaps, dtype=np.intc).reshape(-1, 3)
    missed = np.zeros(table[:, 1] @ table[:, 2], dtype=np.float32)
    cuts = np.searchsorted(time, np.asarray(stages.breaks, dtype=np.float32)).tolist()
    windows = np.array(sorted({0, *cuts, count}), dtype=np.intc)
    mark = sample_marker(windows, table, shown, missed)
    for signal in signals:
        mark(signal)
    for start, stride, number in gaps:
        halves, missed = np.split(missed, [stride * number])
        halves = halves.reshape(2 * number, stride // 2)
        worst = np.arange(2 * number) * (stride // 2) + halves.argmax(axis=1)
        shown[start + np.arange(number + 1) * stride] = 1
        shown[start + worst[np.argsort(halves.max(axis=1))[number:]]] = 1
    return np.flatnonzero(shown)


def packed(values: NDArray[np.float32]) -> dict[str, str]:
    """One signal in plotly's typed-array form: little-endian float32 in base64."""
    data = np.ascontiguousarray(values, dtype="<f4")
    return {"dtype": "f4", "bdata": base64.b64encode(data.data).decode("ascii")}


def unpacked(values: Mapping[str, str]) -> NDArray[np.float32]:
    """The values of a typed array."""
    return np.frombuffer(base64.b64decode(values["bdata"]), dtype="<f4")


def as_json(values: Callable[[str], SeriesArray], signals: Iterable[str], encoding: str) -> JsonObject:
    """By signal its `values` for `pieces.write_json`, as lists (`list`) or typed arrays (`base64`)."""

    def typed(key: str) -> JsonObject:
        return {**packed(values(key))}

    return {key: partial(typed if encoding == "base64" else values, key) for key in signals}


def most_samples(scenario: Scenario, strategy: str, *, jumps: bool = False) -> int:
    """About the most samples that the strategy's time histories have, with those before `jumps` or without."""
    if recording_id(strategy) is not None:
        return MAX_LINES
    name = strategy if strategy in strategies() else "lv"  # none has more than it: one that is gone may be pinned
    steps, fine = samples(scenario, strategy_named(name), duration(scenario, name))
    return ceil(steps) * (fine + jumps)
