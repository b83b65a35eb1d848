"""Time histories: packed into one array, decimated, and in JSON.

A series array has shape (signals, samples), float32, rows in the catalogue's order (`sim_core.catalogue.SIGNALS`).
"""

import base64
import itertools
from collections.abc import Callable, Iterable, Mapping, Sequence
from dataclasses import dataclass
from functools import partial
from math import ceil
from typing import Any, Self

import numpy as np
from numpy.typing import NDArray

from backend.cost.estimate import duration, samples
from backend.csv_lines import MAX_LINES
from backend.json_types import JsonObject
from sim_core.catalogue import BUMP, SIGNALS
from sim_core.result import StrategyResult
from sim_core.scenario import Scenario
from sim_core.scenario.recorded import recording_id
from sim_core.strategies import strategies, strategy_named

SeriesArray = NDArray[np.float32]
ROWS = {key: row for row, key in enumerate(SIGNALS)}
MAX_COPIED_SAMPLES = 200_000  # a longer run is decimated signal by signal, without a copy of all its samples
SAMPLE_BYTES = 4 * len(SIGNALS)  # of a series array
ALWAYS = ("time", "position")
BEFORE, AFTER = 0.6, 0.9  # parts of the bump's length that are shown around it, as the page does


def ordered_signals(signals: Iterable[str] | None) -> list[str]:
    """The signals asked for in the catalogue's order, always with time and position; None is all."""
    keys = set(SIGNALS if signals is None else signals) | set(ALWAYS)
    return [key for key in SIGNALS if key in keys]


def pack(result: StrategyResult, points: int | None = None) -> SeriesArray:
    """A result's time histories as one array; about `points` samples, or all."""
    rows = _Rows(result)
    stages = SamplingHints.of((span.stage, span.start_time, span.end_time) for span in result.stages)
    if points is not None and len(rows[0]) > MAX_COPIED_SAMPLES:
        return decimate(rows, points, stages)
    array = np.empty((len(rows), len(rows[0])), dtype=np.float32)
    for number, row in enumerate(rows):
        array[number] = row
    return decimate(array, points, stages)


class _Rows(Sequence[SeriesArray]):
    """A result's time histories in the catalogue's order, one at a time: all of a long run take 130 MB."""

    def __init__(self, result: StrategyResult) -> None:
        self._series = result.series
        self._keys = list(SIGNALS)

    def __len__(self) -> int:
        return len(self._keys)

    def __getitem__(self, row: Any) -> Any:
        return self._series[self._keys[row]].astype(np.float32)


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
        bumps = [
            (start - BEFORE * (end - start), end + AFTER * (end - start))
            for stage, start, end in listed
            if stage == BUMP
        ]
        return cls(tuple(start for _, start, _ in later), bumps[0] if bumps else None)


def decimate(series: Sequence[SeriesArray] | SeriesArray, points: int | None, stages: SamplingHints) -> SeriesArray:
    """About `points` samples of a series, the same ones for all signals, every peak among them.

    Half of them are spent on the bump, where there is one. Added is each signal's largest and smallest value in each
    stage.

    Args:
        series: Signals (samples,), the first of them the time [s].
        points: How many samples, or None for all.
        stages: Of the run.
    """
    time = series[0]
    count = len(time)
    if points is None or points >= count:
        return np.asarray(series)
    first, last = np.searchsorted(time, stages.bump or ()).tolist() or (0, count)
    if stages.bump is None or 2 * (last - first) >= count:
        parts = [_ChordErrors(0, count, points)]
    else:
        around = count - (last - first)
        parts = [
            _ChordErrors(0, first, max(2, points * first // (2 * around))),
            _ChordErrors(first, last, max(2, points // 2)),
            _ChordErrors(last, count, max(2, points * (count - last) // (2 * around))),
        ]
    cuts = np.searchsorted(time, np.asarray(stages.breaks, dtype=np.float32)).tolist()
    windows = list(itertools.pairwise(sorted({0, *cuts, count})))
    keep = {0, count - 1}
    for signal in series:
        row, span = signal, np.ptp(signal)
        if np.isnan(span):
            row = np.nan_to_num(signal)
            span = np.ptp(row)
        for start, end in windows:
            window = row[start:end]
            keep.update((start + int(window.argmin()), start + int(window.argmax())))
        for part in parts:
            part.add(row, span or np.float32(1))
    indices = np.unique(np.concatenate([np.array(sorted(keep)), *(part.indices() for part in parts)]))
    return np.stack([row[indices] for row in series])


class _ChordErrors:
    """How far straight lines between even samples miss the others, of signals one after the other.

    Half of about `points` indices lie evenly. The other half are those that the lines miss most (relative to the
    signal's span), at most one in each half of a gap, so that a spike gets its flanks.

    Args:
        start: First sample.
        end: One after the last.
        points: About how many indices.
    """

    def __init__(self, start: int, end: int, points: int) -> None:
        self._start, self._count = start, end - start
        self._every = points >= self._count
        self._half = max(1, -(-self._count // points))
        self._gaps = (self._count - 1) // (2 * self._half)
        self._fraction = np.arange(2 * self._half, dtype=np.float32) / np.float32(2 * self._half)
        self._largest = np.zeros((0 if self._every else self._gaps, 2 * self._half), dtype=np.float32)

    def add(self, row: SeriesArray, span: np.float32) -> None:
        """Add a signal (samples,) of that span."""
        if self._every:
            return
        stride, part = 2 * self._half, row[self._start : self._start + self._count]
        nodes = part[: self._gaps * stride + 1 : stride, None]
        away = (nodes[1:] - nodes[:-1]) * self._fraction  # the one array, in place: it is as large as the signal
        away += nodes[:-1]
        np.subtract(part[: self._gaps * stride].reshape(self._gaps, stride), away, out=away)
        np.abs(away, out=away)
        away /= span
        np.maximum(self._largest, away, out=self._largest)

    def indices(self) -> NDArray[np.int64]:
        """Indices into the whole series, once every signal was added."""
        if self._every:
            return self._start + np.arange(self._count)
        halves = self._largest.reshape(2 * self._gaps, self._half)
        worst = np.arange(2 * self._gaps) * self._half + halves.argmax(axis=1)
        most_missed = worst[np.argsort(halves.max(axis=1))[self._gaps :]]
        return self._start + np.concatenate([np.arange(self._gaps + 1) * 2 * self._half, most_missed])


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


def most_samples(scenario: Scenario, strategy: str) -> int:
    """About the most samples that the strategy's time histories have."""
    if recording_id(strategy) is not None:
        return MAX_LINES
    name = strategy if strategy in strategies() else "lv"  # none has more than it: one that is gone may be pinned
    steps, fine = samples(scenario, strategy_named(name), duration(scenario, name))
    return ceil(steps) * fine
