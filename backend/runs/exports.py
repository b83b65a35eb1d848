"""Time histories of a run as a file, JSON or CSV; pinned, or simulated again; in a worker.

Strategy after strategy is driven and written, some samples at a time: the text never stands in memory as a whole.
"""

import re
from collections.abc import Callable, Iterable, Iterator, Mapping, Sequence
from dataclasses import dataclass, replace
from functools import partial
from pathlib import Path
from typing import IO, Literal

import numpy as np
import orjson

from backend.cost.affordable import simulate
from backend.file_formats import FormatName
from backend.json_types import JsonObject
from backend.outcome import Sampling
from backend.pieces import render_to, write_json
from backend.runs import pins
from backend.runs.series import ROWS, SamplingHints, SeriesArray, as_json, pack
from sim_core.catalogue import SIGNALS
from sim_core.scenario import Scenario

AT_ONCE = 10_000  # samples of a table
# Of one value, about [bytes]; text of float32.
VALUE_BYTES = 12.0
BASE64_BYTES = 16 / 3  # four bytes become 16/3 characters (RFC 4648, section 4)
NAME_BYTES = 16  # of a strategy in each row of CSV [bytes]
BYTE_COST = 2e-8  # of one byte [s of one core]
_WHOLE = re.compile(rb"\.0(?=[],])")  # the end of a whole number in JSON


@dataclass(frozen=True, slots=True)
class Columns:
    """One strategy's time histories: how many samples, and a signal's samples from one up to before another."""

    count: int
    values: Callable[[str, int, int], SeriesArray]

    def whole(self, key: str) -> SeriesArray:
        """Return all samples of a signal."""
        return self.values(key, 0, self.count)


Members = Mapping[str, Callable[[], Columns]]  # by strategy what makes them: those of one at a time are there


@dataclass(frozen=True, slots=True, kw_only=True)
class Export:
    """The time histories to export, and their format.

    Attributes:
        strategies: Ids, in the order they come out.
        signals: Keys, in the catalogue's order.
        points: At most how many samples of each strategy, None for all.
        core_version: Of the core that made them, kept in JSON.
        sources: The file and digest of each custom controller by its id, kept likewise.
    """

    strategies: Sequence[str]
    signals: Sequence[str]
    points: int | None
    file_format: FormatName
    encoding: Literal["list", "base64"]
    core_version: str
    sources: Mapping[str, JsonObject]

    def size(self, samples: Iterable[int]) -> float:
        """Return about how long the file will be [bytes], from how many samples each strategy has."""
        each = len(self.signals) * value_bytes(self.file_format, self.encoding)
        if self.file_format == "csv" and len(self.strategies) > 1:
            each += NAME_BYTES
        return each * rows(samples, self.points)


def value_bytes(file_format: str, encoding: str) -> float:
    """Return about how long one value is in a file of that format [bytes]."""
    return BASE64_BYTES if (file_format, encoding) == ("json", "base64") else VALUE_BYTES


def rows(samples: Iterable[int], points: int | None) -> int:
    """Return about how many samples come out of strategies with so many, at most `points` of each (None is all)."""
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
        count = len(series["time"]) + len(series.jumps)
        return Columns(count, lambda key, start, end: series.with_jumps(key, start, end, np.float32))
    array = pack(result, Sampling(points))
    return Columns(array.shape[1], lambda key, start, end: array[ROWS[key], start:end])


def _pinned(content: bytes, stages: SamplingHints, points: int | None) -> Columns:
    columns = pins.columns(content, stages, points)
    return Columns(len(columns["time"]), lambda key, start, end: columns[key][start:end])


def _write(members: Members, export: Export, file: IO[bytes]) -> None:
    {"json": _write_json, "csv": _write_csv}[export.file_format](members, export, file)


def _write_json(members: Members, export: Export, file: IO[bytes]) -> None:
    """Write `{strategy, series}` of one strategy, `{strategies}` of several, with the units beside."""

    def series(columns: Callable[[], Columns]) -> JsonObject:
        return as_json(columns().whole, export.signals, export.encoding)

    bodies: JsonObject = {name: partial(series, columns) for name, columns in members.items()}
    if len(bodies) == 1:
        ((name, body),) = bodies.items()
        content: JsonObject = {"strategy": name, "series": body}
    else:
        content = {"strategies": bodies}
    units = {key: SIGNALS[key].unit for key in export.signals}
    head = {"core_version": export.core_version, "sources": export.sources, "units": units}
    write_json({**head, **content}, file)


def _write_csv(members: Members, export: Export, file: IO[bytes]) -> None:
    """Write a table with units in its header and nothing else, as spreadsheets read it."""
    several = len(export.strategies) > 1
    header = (["strategy"] if several else []) + [column_name(key) for key in export.signals]
    file.write(",".join(header).encode() + b"\n")
    for name, samples in _tables(members, export):
        begin = f"{name},".encode() if several else b""
        # A list of rows as JSON has the same numbers; what is none is null there, and an empty cell here, and 5 is 5.0.
        text = _WHOLE.sub(b"", orjson.dumps(np.column_stack(samples), option=orjson.OPT_SERIALIZE_NUMPY))[2:-2]
        file.write(begin + text.replace(b"null", b"").replace(b"],[", b"\n" + begin) + b"\n")


def column_name(key: str) -> str:
    """Return the name of a signal's column: `body_acceleration [m/s^2]`."""
    return f"{key} [{SIGNALS[key].unit}]"


def _tables(members: Members, export: Export) -> Iterator[tuple[str, list[SeriesArray]]]:
    """Yield strategy after strategy some samples of each signal."""
    for name, make in members.items():
        for samples in _pieces(make(), export.signals):
            yield name, samples


def _pieces(columns: Columns, signals: Sequence[str]) -> Iterator[list[SeriesArray]]:
    """Yield some samples of each signal at a time; at the end nothing keeps the strategy's any more."""
    for start in range(0, columns.count, AT_ONCE):
        end = min(columns.count, start + AT_ONCE)
        yield [columns.values(key, start, end) for key in signals]
