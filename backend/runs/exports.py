"""Time histories of a run as a file: JSON, CSV or Parquet; pinned, or simulated again; in a worker.

Strategy after strategy is driven and written, some samples at a time: the text never stands in memory as a whole.
"""

from collections.abc import Callable, Iterable, Iterator, Mapping, Sequence
from dataclasses import dataclass, replace
from functools import partial
from pathlib import Path
from typing import IO, Literal

import numpy as np
import pyarrow as pa
from pyarrow import csv, parquet

from backend.cost.affordable import simulate
from backend.json_types import JsonObject
from backend.pieces import render_to, write_json
from backend.runs import pins
from backend.runs.series import ROWS, SamplingHints, SeriesArray, as_json, pack
from sim_core.catalogue import SIGNALS
from sim_core.scenario import Scenario

AT_ONCE = 10_000  # samples of a table
# Of one value, about [bytes]; text of float32.
VALUE_BYTES = {"csv": 12.0, "json": 12.0, "parquet": 5.0}
BASE64_BYTES = 16 / 3  # four bytes become 16/3 characters (RFC 4648, section 4)
NAME_BYTES = 16  # of a strategy in each row of CSV [bytes]
BYTE_COST = 2e-8  # of one byte [s of one core]
pa.set_memory_pool(pa.system_memory_pool())  # the C library's: `make_room` gives back what it keeps


@dataclass(frozen=True, slots=True)
class Columns:
    """One strategy's time histories: how many samples, and a signal's samples from one up to before another."""

    count: int
    values: Callable[[str, int, int], SeriesArray]

    def whole(self, key: str) -> SeriesArray:
        """All samples of a signal."""
        return self.values(key, 0, self.count)


Members = Mapping[str, Callable[[], Columns]]  # by strategy what makes them: those of one at a time are there


@dataclass(frozen=True, slots=True, kw_only=True)
class Export:
    """Which time histories to export, and in which format.

    Attributes:
        strategies: Ids, in the order they come out.
        signals: Keys, in the catalogue's order.
        points: About how many samples of each strategy, None for all.
        provenance: Where they come from, kept in the file where its format has a place for it.
    """

    strategies: Sequence[str]
    signals: Sequence[str]
    points: int | None
    file_format: Literal["json", "csv", "parquet"]
    encoding: Literal["list", "base64"]
    provenance: Mapping[str, str]

    def size(self, samples: Iterable[int]) -> float:
        """About how long the file will be [bytes], from how many samples each strategy has."""
        each = len(self.signals) * value_bytes(self.file_format, self.encoding)
        if self.file_format == "csv" and len(self.strategies) > 1:
            each += NAME_BYTES
        return each * rows(samples, self.points)


def value_bytes(file_format: str, encoding: str) -> float:
    """About how long one value is in a file of that format [bytes]."""
    return BASE64_BYTES if (file_format, encoding) == ("json", "base64") else VALUE_BYTES[file_format]


def rows(samples: Iterable[int], points: int | None) -> int:
    """About how many samples come out of strategies with so many, at about `points` of each (None is all)."""
    return sum(count if points is None else min(count, points) for count in samples)


def render(scenario: Scenario, export: Export, path: Path | None) -> bytes:
    """Simulate and render; arguments and result as of `pieces.render_to`."""
    members = {name: partial(_driven, scenario, name, export.points) for name in export.strategies}
    return render_to(partial(_write, members, export), path)


def render_pinned(
    pinned: Mapping[str, bytes], stages: Mapping[str, SamplingHints], export: Export, path: Path | None
) -> bytes:
    """Render pinned time histories (arguments as for `pins.opened`); signals that were not pinned are left out."""
    present = set.intersection(*(pins.signals(content) for content in pinned.values()))
    export = replace(export, signals=[key for key in export.signals if key in present])
    members = {name: partial(_pinned, pinned[name], stages[name], export.points) for name in pinned}
    return render_to(partial(_write, members, export), path)


def _driven(scenario: Scenario, name: str, points: int | None) -> Columns:
    result = simulate(scenario, name)
    if points is None:
        series = result.series
        return Columns(len(series["time"]), lambda key, *ends: series.between(key, *ends).astype(np.float32))
    array = pack(result, points)
    return Columns(array.shape[1], lambda key, start, end: array[ROWS[key], start:end])


def _pinned(content: bytes, stages: SamplingHints, points: int | None) -> Columns:
    columns = pins.columns(content, stages, points)
    return Columns(len(columns["time"]), lambda key, start, end: columns[key][start:end])


def _write(members: Members, export: Export, file: IO[bytes]) -> None:
    {"json": _write_json, "csv": _write_csv, "parquet": _write_parquet}[export.file_format](members, export, file)


def _write_json(members: Members, export: Export, file: IO[bytes]) -> None:
    """`{strategy, series}` of one strategy, `{strategies}` of several, with the units beside."""

    def series(columns: Callable[[], Columns]) -> JsonObject:
        return as_json(columns().whole, export.signals, export.encoding)

    bodies: JsonObject = {name: partial(series, columns) for name, columns in members.items()}
    if len(bodies) == 1:
        ((name, body),) = bodies.items()
        content: JsonObject = {"strategy": name, "series": body}
    else:
        content = {"strategies": bodies}
    units = {key: SIGNALS[key].unit for key in export.signals}
    write_json({"core_version": export.provenance["core_version"], "units": units, **content}, file)


def _write_csv(members: Members, export: Export, file: IO[bytes]) -> None:
    """A table with units in its header and nothing else, as spreadsheets read it."""
    with csv.CSVWriter(file, _schema(export), write_options=csv.WriteOptions(quoting_header="none")) as writer:
        for table in _tables(members, export):
            writer.write_table(table)


def _write_parquet(members: Members, export: Export, file: IO[bytes]) -> None:
    """The table as Parquet; units are field metadata, the provenance is the file's."""
    # Of numbers that hardly repeat dictionaries take more than they save.
    with parquet.ParquetWriter(file, _schema(export), compression="zstd", use_dictionary=["strategy"]) as writer:
        for table in _tables(members, export):
            writer.write_table(table)


def column_name(key: str) -> str:
    """The name of a signal's column: `body_acceleration [m/s^2]`."""
    return f"{key} [{SIGNALS[key].unit}]"


def _schema(export: Export) -> pa.Schema:
    """A column for each signal; a first one names the strategy where there are several."""
    named = [pa.field("strategy", pa.string())] if len(export.strategies) > 1 else []
    fields = [
        pa.field(column_name(key), pa.float32(), metadata={"signal": key, "unit": SIGNALS[key].unit})
        for key in export.signals
    ]
    provenance = {f"ridelab.{key}": value for key, value in export.provenance.items()}
    return pa.schema(named + fields, metadata=provenance)


def _tables(members: Members, export: Export) -> Iterator[pa.Table]:
    """Tables of that schema with a row for each sample."""
    for name, columns in members.items():
        yield from _tables_of(name, columns(), export)


def _tables_of(name: str, columns: Columns, export: Export) -> Iterator[pa.Table]:
    schema = _schema(export)
    for start in range(0, columns.count, AT_ONCE):
        end = min(columns.count, start + AT_ONCE)
        named = [pa.repeat(name, end - start)] if len(export.strategies) > 1 else []
        values = [_arrow(columns.values(key, start, end)) for key in export.signals]
        yield pa.Table.from_arrays(named + values, schema=schema)


def _arrow(values: SeriesArray) -> pa.Array:
    """The same numbers; `pa.array` would import pandas, where it is installed, for 30 MB of each worker."""
    return pa.Array.from_buffers(pa.float32(), len(values), [None, pa.py_buffer(np.ascontiguousarray(values))])
