"""Pinned time histories: one strategy's, full resolution, float32, as a self-describing Parquet file.

Columns are named after their signals, their units and the core's version are metadata: a later catalogue of signals
takes from an old file what it still knows, and any Parquet reader the rest. Runs in worker processes; why this format:
docs/decisions/0007-links-pin-series.md.
"""

import io
from collections.abc import Mapping, Sequence

import numpy as np
import pyarrow as pa
from pyarrow import parquet

from backend.cost.affordable import simulate
from backend.runs.series import ROWS, SamplingHints, SeriesArray, decimate, pack
from sim_core import __version__ as CORE_VERSION
from sim_core.catalogue import SIGNALS
from sim_core.scenario import Scenario

LEVEL = 1  # of zstd; 9 takes three times as long for 2 % (docs/decisions/0007)


def make(scenario: Scenario, strategies: Sequence[str]) -> dict[str, bytes]:
    """Simulate each strategy and pin its time histories, by strategy."""
    return {name: write(pack(simulate(scenario, name)), name) for name in strategies}


def write(series: SeriesArray, strategy: str, core_version: str = CORE_VERSION) -> bytes:
    """The file of one strategy's time histories, shape (signals, samples)."""
    schema = pa.schema(
        [pa.field(key, pa.float32(), False, {"unit": SIGNALS[key].unit}) for key in ROWS],
        metadata={"ridelab.core_version": core_version, "ridelab.strategy": strategy},
    )
    table = pa.table([pa.array(series[row]) for row in ROWS.values()], schema=schema)
    sink = io.BytesIO()
    # Split by byte, neighbouring samples share their sign and exponent bytes, which then compress to little.
    parquet.write_table(
        table,
        sink,
        compression="zstd",
        compression_level=LEVEL,
        use_byte_stream_split=True,
        use_dictionary=False,
        write_statistics=False,
    )
    return sink.getvalue()


def signals(content: bytes) -> set[str]:
    """The pinned signals of the current catalogue with the same unit."""
    schema = parquet.read_schema(pa.BufferReader(content))
    units = {field.name: (field.metadata or {}).get(b"unit", b"").decode() for field in schema}
    return {key for key, quantity in SIGNALS.items() if units.get(key) == quantity.unit}


def columns(content: bytes, stages: SamplingHints, points: int | None) -> dict[str, SeriesArray]:
    """By signal about so many of its samples; `signals` in the catalogue's order."""
    present = signals(content)
    table = parquet.read_table(pa.BufferReader(content), columns=[key for key in SIGNALS if key in present])
    samples = {key: column.to_numpy() for key, column in zip(table.column_names, table.columns, strict=True)}
    if points is None:
        return samples
    return dict(zip(samples, decimate(np.stack(list(samples.values())), points, stages), strict=True))


def opened(
    pinned: Mapping[str, bytes], stages: Mapping[str, SamplingHints], points: int | None
) -> dict[str, SeriesArray]:
    """Series arrays of pinned time histories, by strategy; a signal that was not pinned is NaN throughout.

    Args:
        pinned: By strategy its file.
        stages: By strategy its driving stages, see `series.decimate`.
        points: About how many samples; None is all.
    """
    return {name: _aligned(columns(content, stages[name], points)) for name, content in pinned.items()}


def _aligned(few: Mapping[str, SeriesArray]) -> SeriesArray:
    array = np.full((len(ROWS), len(few["time"])), np.nan, dtype=np.float32)
    for key, values in few.items():
        array[ROWS[key]] = values
    return array
