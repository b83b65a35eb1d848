"""Pinned time histories: one strategy's, full resolution, float32, with the signals' names and units.

A pin is the line `ridelab pin 1`, a line of JSON (`units` by signal in the order of the rows, `strategy`,
`core_version`), and by zlib the samples row by row: of each row all first bytes, then the second, third and fourth.
A later catalogue of signals takes from an old pin what it still knows. Pins of versions until 0.3.0 are Parquet, which
needs the extra `parquet`. Runs in worker processes; why this format: docs/decisions/0063-the-client-makes-parquet.md.
"""

import zlib
from collections.abc import Mapping, Sequence
from importlib.util import find_spec
from types import ModuleType

import numpy as np
import orjson

from backend.cost.affordable import simulate
from backend.errors import ServiceError
from backend.runs.series import ROWS, SAMPLE_BYTES, SamplingHints, SeriesArray, decimate, most_samples, pack_all
from sim_core import __version__ as CORE_VERSION
from sim_core.catalogue import SIGNALS
from sim_core.scenario import Scenario

MOST_PINNED = 32 * 1024 * 1024  # of one run, before they are compressed: 75 strategies on the paper's road [bytes]
LEVEL = 1  # of zlib; 6 takes half as long again for 3 %
MAGIC, PARQUET = b"ridelab pin 1\n", b"PAR1"  # how pins begin
FLOAT = np.dtype("<f4")
NO_READER = (
    "The time histories of this link are stored as Parquet: whoever runs this service installs what reads them by "
    "pip install pyarrow"
)


class ParquetPinError(ServiceError):
    """An old link's time histories cannot be read here."""

    kind = "unavailable"


def make(scenario: Scenario, strategies: Sequence[str]) -> dict[str, bytes]:
    """Simulate each strategy and pin its time histories, by strategy; none where all are too long to be pinned."""
    if SAMPLE_BYTES * sum(most_samples(scenario, name, jumps=True) for name in strategies) > MOST_PINNED:
        return {}
    return {name: write(pack_all(simulate(scenario, name)), name) for name in strategies}


def write(series: SeriesArray, strategy: str, core_version: str = CORE_VERSION) -> bytes:
    """Return the pin of one strategy's time histories, shape (signals, samples)."""
    units = {key: SIGNALS[key].unit for key in ROWS}
    head = orjson.dumps({"units": units, "strategy": strategy, "core_version": core_version})
    samples = np.ascontiguousarray(series[list(ROWS.values())], dtype=FLOAT)
    # Split by byte, neighbouring samples share their sign and exponent bytes, which then compress to little.
    apart = samples.view(np.uint8).reshape(*samples.shape, FLOAT.itemsize).transpose(0, 2, 1)
    return MAGIC + head + b"\n" + zlib.compress(apart.tobytes(), LEVEL)


def signals(content: bytes) -> set[str]:
    """Return the pinned signals of the current catalogue with the same unit."""
    units = _parquet().pinned_units(content) if content.startswith(PARQUET) else _opened(content)[0]
    return {key for key, quantity in SIGNALS.items() if units.get(key) == quantity.unit}


def columns(content: bytes, stages: SamplingHints, points: int | None) -> dict[str, SeriesArray]:
    """Return by signal at most so many of its samples; `signals` in the catalogue's order."""
    present = signals(content)
    reads = _parquet().pinned_samples if content.startswith(PARQUET) else _samples
    samples: dict[str, SeriesArray] = reads(content, [key for key in SIGNALS if key in present])
    if points is None:
        return samples
    after_jumps = np.append(np.diff(samples["time"]) > 0, True)  # of two samples at one instant the later one
    table = np.stack([values[after_jumps] for values in samples.values()])
    return dict(zip(samples, decimate(table, points, stages), strict=True))


def _samples(content: bytes, wanted: Sequence[str]) -> dict[str, SeriesArray]:
    units, packed = _opened(content)
    apart = np.frombuffer(zlib.decompress(packed), np.uint8).reshape(len(units), FLOAT.itemsize, -1)
    samples = np.ascontiguousarray(apart.transpose(0, 2, 1)).view(FLOAT)[..., 0]
    rows = dict(zip(units, samples, strict=True))
    return {key: rows[key] for key in wanted}


def _opened(content: bytes) -> tuple[dict[str, str], bytes]:
    """Return the unit of each signal, and the packed samples."""
    head, _, packed = content.removeprefix(MAGIC).partition(b"\n")
    return orjson.loads(head)["units"], packed


def _parquet() -> ModuleType:
    """Return the module that reads the pins of versions until 0.3.0.

    Raises:
        ParquetPinError: It is not installed.
    """
    if find_spec("pyarrow") is None:
        raise ParquetPinError(NO_READER)
    from backend.runs import parquet

    return parquet


def opened(
    pinned: Mapping[str, bytes], stages: Mapping[str, SamplingHints], points: int | None
) -> dict[str, SeriesArray]:
    """Return series arrays of pinned time histories, by strategy; a signal that was not pinned is NaN throughout.

    Args:
        pinned: By strategy its file.
        stages: By strategy its driving stages, see `series.decimate`.
        points: At most how many samples; None is all.
    """
    return {name: _aligned(columns(content, stages[name], points)) for name, content in pinned.items()}


def _aligned(few: Mapping[str, SeriesArray]) -> SeriesArray:
    array = np.full((len(ROWS), len(few["time"])), np.nan, dtype=np.float32)
    for key, values in few.items():
        array[ROWS[key]] = values
    return array
