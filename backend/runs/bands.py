"""Time histories over several roads: at each sample the mean, the smallest and the largest value of all roads.

Roads differ in their seed alone and share the speed plan: sample k lies at the same time and position on each.
The functions run in worker processes.
"""

import time
from collections.abc import Iterable, Mapping, Sequence
from dataclasses import dataclass, replace
from functools import partial
from pathlib import Path
from typing import Self

import numpy as np
from numpy.typing import NDArray

from backend.cost.affordable import simulate
from backend.json_types import JsonObject
from backend.pieces import render_to, write_json
from backend.runs import exports
from backend.runs.series import ROWS, SamplingHints, SeriesArray, as_json, decimate, most_samples, pack
from sim_core import __version__ as CORE_VERSION
from sim_core.catalogue import SIGNALS
from sim_core.scenario import Scenario

MAX_BYTES = 128 * 1024 * 1024  # of the bands of one request
LONGEST_TASK = 0.2  # a worker is free again for others after about so long [s]
SAME_ON_EVERY_ROAD = ("time", "position", "speed", "brake_pressure", "brake_deceleration")  # on every road


@dataclass(frozen=True, slots=True, kw_only=True)
class Band:
    """One strategy's time histories over the roads driven so far; arrays of shape (signals, samples).

    Attributes:
        roads: How many.
        total: The sum over them.
        minimum: The smallest value of each sample.
        maximum: The largest.
    """

    roads: int
    total: NDArray[np.float64]
    minimum: SeriesArray
    maximum: SeriesArray

    @classmethod
    def of(cls, series: SeriesArray) -> Self:
        """Return the band of one road."""
        return cls(roads=1, total=series.astype(np.float64), minimum=series, maximum=series.copy())

    def with_road(self, series: SeriesArray) -> "Band":
        """With one road more, in the same arrays."""
        np.add(self.total, series, out=self.total)
        np.minimum(self.minimum, series, out=self.minimum)
        np.maximum(self.maximum, series, out=self.maximum)
        return replace(self, roads=self.roads + 1)

    @classmethod
    def load(cls, path: Path, roads: int) -> Self:
        """The band of so many roads that `save` wrote."""
        with path.open("rb") as file:
            total, minimum, maximum = (np.load(file) for _ in range(3))
        return cls(roads=roads, total=total, minimum=minimum, maximum=maximum)

    def save(self, path: Path) -> None:
        """Write it over a file that is there."""
        with path.open("r+b") as file:
            for array in (self.total, self.minimum, self.maximum):
                np.save(file, array)

    @staticmethod
    def most_nbytes(scenario: Scenario, strategy: str) -> int:
        """About the most memory that the arrays of a band of this scenario take."""
        samples = most_samples(scenario, strategy)
        return samples * len(SIGNALS) * (np.dtype(np.float64).itemsize + 2 * np.dtype(np.float32).itemsize)

    @property
    def mean(self) -> SeriesArray:
        """The mean over the roads."""
        return (self.total / self.roads).astype(np.float32)


def text_size(samples: Iterable[int], signals: Sequence[str], points: int | None, encoding: str) -> float:
    """About how long the JSON of those signals is [bytes], from how many samples each strategy has; see `render`."""
    columns = len(signals) + 2 * len(_spread(signals))
    return columns * exports.value_bytes("json", encoding) * exports.rows(samples, points)


def drive(roads: Sequence[Scenario], strategy: str, before: tuple[Path, int], after: Path) -> int:
    """Drive those of the roads that the band does not hold yet, as many as fit into `LONGEST_TASK`, at least one.

    Args:
        roads: All of them.
        strategy: Its id.
        before: The band's file, and how many roads it holds, perhaps none.
        after: The file that will hold the band with these roads; another one, so that a task can be tried again.

    Returns:
        How many roads that one holds.

    Raises:
        RidelabError: As `simulate` raises.
    """
    end = time.perf_counter() + LONGEST_TASK
    path, done = before
    band: Band | None = None
    for road in roads[done:]:
        series = pack(simulate(road, strategy))
        if band is None and done:
            band = Band.load(path, done)
        band = Band.of(series) if band is None else band.with_road(series)
        if time.perf_counter() > end:
            break
    if band is None:
        raise ValueError("No roads")
    band.save(after)
    return band.roads


def render(
    files: Mapping[str, Path],
    roads: int,
    stages: Mapping[str, SamplingHints],
    signals: Sequence[str],
    points: int | None,
    encoding: str,
    path: Path | None,
) -> bytes:
    """JSON of `backend.runs.models.Bands`.

    Args:
        files: By strategy its band's.
        roads: How many each holds.
        stages: By strategy its driving stages, see `series.decimate`.
        signals: Keys in the catalogue's order, time the first.
        points: At most how many samples, the same ones of mean, minimum and maximum; None is all.
        encoding: How JSON holds numbers: `list` or `base64`.
        path: Where to, see `pieces.render_to`.
    """
    content = {
        "core_version": CORE_VERSION,
        "roads": roads,
        "units": {key: SIGNALS[key].unit for key in signals},
        "strategies": {
            name: partial(_decimated, file, roads, signals, points, stages[name], encoding)
            for name, file in files.items()
        },
    }
    return render_to(partial(write_json, content), path)


def _spread(signals: Sequence[str]) -> list[str]:
    """Return the signals that differ from road to road: the others have neither minimum nor maximum."""
    return [key for key in signals if key not in SAME_ON_EVERY_ROAD]


def _decimated(
    file: Path, roads: int, signals: Sequence[str], points: int | None, stages: SamplingHints, encoding: str
) -> JsonObject:
    band = Band.load(file, roads)
    spread = _spread(signals)
    parts = {"mean": (band.mean, signals), "minimum": (band.minimum, spread), "maximum": (band.maximum, spread)}
    few = decimate(np.vstack([array[[ROWS[key] for key in keys]] for array, keys in parts.values()]), points, stages)
    rows = iter(few)
    by_part: dict[str, dict[str, SeriesArray]] = {
        name: {key: next(rows) for key in keys} for name, (_, keys) in parts.items()
    }
    return {name: as_json(each.__getitem__, each, encoding) for name, each in by_part.items()}
