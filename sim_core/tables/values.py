"""The numbers of the columns that are read, from the first row to the last."""

import re
from array import array
from collections.abc import Callable, Mapping, Sequence
from dataclasses import dataclass, field

import numpy as np

from sim_core.arrays import FloatArray
from sim_core.tables import text as texts
from sim_core.tables.columns import CLOCK_UNIT, DIGITS_UNIT, Column
from sim_core.tables.errors import TableError
from sim_core.tables.layout import Layout, values_share
from sim_core.tables.text import CLOCK, is_missing, number
from sim_core.tables.titles import MEANINGS, size_of

# How numbers are written that stand for no value: nines, the ends of integers, and what no sensor says.
_CODE = re.compile(r"9{3,}|9{2,}\.9+|3276[78]|65535|214748364[78]|\d{10,}|[\d.]+e\+(1\d|20)")
_LEAST_OTHERS = 10  # values, of which that is said
_AXES = ("time", "position", "distance")
ReadCell = Callable[[str], float]

MAX_NUMBER = 1e21  # in any unit
_HALF_A_DAY = 43_200.0  # [s]


@dataclass(slots=True, kw_only=True)
class Values:
    """Columns by meaning (rows,) in SI units, NaN where a cell is empty, and the line of each row."""

    lines: Sequence[int]
    signals: dict[str, FloatArray]
    notes: list[str] = field(default_factory=list)


def read(text: str, layout: Layout, decimal: str, columns: Sequence[Column]) -> Values:
    """Return the values of the columns that mean something.

    Raises:
        TableError: A line between others has no values, or a cell is no number.
    """
    used = [each for each in columns if each.means is not None]
    clocks = {CLOCK_UNIT: _clock_time, DIGITS_UNIT: _clock_digits}
    readers = [(clocks.get(each.unit) or _number(decimal), each.index) for each in used]
    stored = [array("d") for _ in used]
    lines = array("l")
    width, last = len(layout.titles), max(each.index for each in used)
    foreign: list[int] = []
    for line, cells in texts.rows(text, layout.separator, layout.first_row):
        if not any(cells) or texts.is_comment(cells):
            continue
        while len(cells) > width and not cells[-1]:
            cells.pop()
        row: list[float] = []
        try:
            if last < len(cells) <= width:
                for reading, place in readers:
                    row.append(reading(cells[place]))
        except ValueError:
            if values_share(cells) and not foreign and line == (lines[-1] + 1 if lines else line):
                raise TableError(f"A value of “{used[len(row)].title}” is not a number", line) from None
            row = []
        if not row:
            foreign.append(line)
            continue
        if foreign:
            raise TableError("This line, with values behind it, is not like the others", foreign[0])
        lines.append(line)
        for numbers, value in zip(stored, row, strict=True):
            numbers.append(value)
    notes = [f"Left out: {len(foreign)} lines behind the values, from line {foreign[0]} on"] if foreign else []
    signals = {str(each.means): np.array(column) for each, column in zip(used, stored, strict=True)}
    notes += [note for each in used if (note := _without_code(each, signals[str(each.means)], lines))]
    return Values(lines=lines, signals=_in_si(signals, used, lines), notes=notes)


def _without_code(column: Column, values: FloatArray, lines: Sequence[int]) -> str | None:
    """Put NaN in place of a number such as -9999 that lies far from all others, and return a note on it."""
    known = np.sort(values[np.isfinite(values)])
    for code in known[[0, -1]].tolist() if len(known) and column.means not in _AXES else ():
        others = known[known != code]
        is_code = _CODE.fullmatch(f"{abs(code):.12g}") is not None and len(others) >= _LEAST_OTHERS
        if is_code and np.abs(others - code).min() > np.ptp(others):
            at = np.flatnonzero(values == code)
            values[at] = np.nan
            return f"“{column.title}”: {code:.12g} stands for no value, {len(at)} times, first in line {lines[at[0]]}"
    return None


def _number(decimal: str) -> ReadCell:
    other = "," if decimal == "." else "."

    def read_number(cell: str) -> float:
        if other not in cell and "_" not in cell:
            try:
                return float(cell if decimal == "." else cell.replace(",", "."))
            except ValueError:
                pass
        if is_missing(cell):
            return np.nan
        value = number(cell, decimal)
        if value is None:
            raise ValueError
        return value

    return read_number


def _clock_time(cell: str) -> float:
    """Return the seconds since midnight of a clock's time."""
    if is_missing(cell):
        return np.nan
    match = CLOCK.search(cell)
    if match is None:
        raise ValueError
    hours, minutes, seconds, half = match.groups()
    hour = int(hours or 0) % 12 + (12 if half in ("P", "p") else 0) if half else int(hours or 0)
    return 3600.0 * hour + 60 * int(minutes) + float(seconds.replace(",", ".").replace(":", "."))


def _clock_digits(cell: str) -> float:
    """Return the seconds since midnight of 100000.50, half a second after ten."""
    value = float(cell)
    hours, rest = divmod(value, 10_000)
    minutes, seconds = divmod(rest, 100)
    return 3600 * hours + 60 * minutes + seconds


def _in_si(signals: Mapping[str, FloatArray], used: Sequence[Column], lines: Sequence[int]) -> dict[str, FloatArray]:
    converted = {}
    for column in used:
        means = str(column.means)
        values = signals[means]
        if (beyond := ~(np.abs(np.nan_to_num(values)) <= MAX_NUMBER)).any():
            raise TableError(f"A value of “{column.title}” is beyond any measurement", lines[int(beyond.argmax())])
        if column.unit in (CLOCK_UNIT, DIGITS_UNIT):
            jumps = np.round(np.diff(values, prepend=values[:1]) / (2 * _HALF_A_DAY))  # midnight, once or more
            converted[means] = values - 2 * _HALF_A_DAY * np.cumsum(np.nan_to_num(jumps))
            continue
        kind = next(each for each in MEANINGS.values() if means in each)
        size = size_of(column.unit, kind[means]) or 1.0
        converted[means] = (values - values[0] if size < 1e-3 and means == "time" else values) * size
        if column.direction == "down":
            converted[means] = -converted[means]
    return converted
