"""Time histories over several roads: at each sample the mean, the smallest and the largest value of all roads.

Roads differ in their seed alone and share the speed plan: sample k lies at the same time and position on each.
The functions run in worker processes.
"""

import time
from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from typing import Self

import numpy as np
import orjson
from numpy.typing import NDArray

from backend.ecu.drive import simulate
from backend.json_types import JsonObject
from backend.runs.series import ROWS, SeriesArray, Stages, decimate, pack, packed
from sim_core import __version__ as CORE_VERSION
from sim_core.catalogue import SIGNALS
from sim_core.drive.sampling import fine_step
from sim_core.scenario import Scenario
from sim_core.strategies import driven, strategy_named
from sim_core.workload import duration

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
        """Of one road."""
        return cls(roads=1, total=series.astype(np.float64), minimum=series, maximum=series)

    def with_road(self, series: SeriesArray) -> "Band":
        """With one road more."""
        return Band(
            roads=self.roads + 1,
            total=self.total + series,
            minimum=np.minimum(self.minimum, series),
            maximum=np.maximum(self.maximum, series),
        )

    @staticmethod
    def most_nbytes(scenario: Scenario, strategy: str) -> int:
        """About the most memory that the arrays of a band of this scenario take."""
        driving = driven(strategy_named(strategy), scenario.speed.policy)
        samples = duration(scenario, strategy) / fine_step(scenario, driving)
        return round(samples * len(SIGNALS) * (np.dtype(np.float64).itemsize + 2 * np.dtype(np.float32).itemsize))

    @property
    def nbytes(self) -> int:
        """Memory its arrays take."""
        return self.total.nbytes + self.minimum.nbytes + self.maximum.nbytes

    @property
    def mean(self) -> SeriesArray:
        """The mean over the roads."""
        return (self.total / self.roads).astype(np.float32)


def drive(roads: Sequence[Scenario], strategy: str, band: Band | None) -> Band:
    """Drive those of the roads that the band does not hold yet, as many as fit into `LONGEST_TASK`, at least one.

    Raises:
        RidelabError: As `simulate` raises.
    """
    end = time.perf_counter() + LONGEST_TASK
    for road in roads[band.roads if band else 0 :]:
        series = pack(simulate(road, strategy))
        band = Band.of(series) if band is None else band.with_road(series)
        if time.perf_counter() > end:
            break
    if band is None:
        raise ValueError("No roads")
    return band


def render(
    bands: Mapping[str, Band], stages: Mapping[str, Stages], signals: Sequence[str], points: int | None, encoding: str
) -> bytes:
    """JSON of `backend.runs.roads_models.Bands`.

    Args:
        bands: By strategy, all over the same roads.
        stages: By strategy its driving stages, see `series.decimate`.
        signals: Keys in the catalogue's order, time the first.
        points: About how many samples, the same ones of mean, minimum and maximum; None is all.
        encoding: How JSON holds numbers: `list` or `base64`.
    """
    (roads,) = {band.roads for band in bands.values()}
    content = {
        "core_version": CORE_VERSION,
        "roads": roads,
        "units": {key: SIGNALS[key].unit for key in signals},
        "strategies": {name: _decimated(band, signals, points, stages[name], encoding) for name, band in bands.items()},
    }
    return orjson.dumps(content, option=orjson.OPT_SERIALIZE_NUMPY)


def _decimated(band: Band, signals: Sequence[str], points: int | None, stages: Stages, encoding: str) -> JsonObject:
    spread = [key for key in signals if key not in SAME_ON_EVERY_ROAD]
    parts = [(band.mean, signals), (band.minimum, spread), (band.maximum, spread)]
    few = decimate(np.vstack([array[[ROWS[key] for key in keys]] for array, keys in parts]), points, stages)
    rows = iter(packed(row) if encoding == "base64" else row for row in few)
    return {
        name: {key: next(rows) for key in keys}
        for name, (_, keys) in zip(("mean", "minimum", "maximum"), parts, strict=True)
    }
