"""A recorded drive as CSV: columns mapped to the catalogue's signals, checked, converted. Runs in a worker: no web."""

import re
from collections.abc import Mapping, Sequence
from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from backend import csv_lines
from backend.csv_lines import CsvError
from sim_core.arrays import FloatArray
from sim_core.catalogue import METRIC_SIGNALS, SIGNALS
from sim_core.recorded.offsets import describe_offsets
from sim_core.scenario.recorded import LONGEST, RecordedDrive
from sim_core.units import factor

MAX_LINE, MAX_COLUMNS = 4000, 200
LEAST_SAMPLES = 10
LONGEST_TIME = 3600.0  # [s]
# A step of so many usual ones, and so long, is a gap: nothing is known in it [s], [m].
GAP_STEPS, GAP_TIME, GAP_DISTANCE = 10.0, 0.1, 1.0
FILLED_STEPS = 3.0  # a signal of a slower rate is straight between values at most so many of its own steps apart
# Values beyond are hardly a car's, by SI unit.
LARGEST = {"m/s^2": 200.0, "rad/s^2": 300.0, "N": 1e5, "m": 1.0, "m/s": 100.0, "Pa": 1e8}
ALIASES = {"distance": "position", "t": "time", "v": "speed", "velocity": "speed", "vehicle_speed": "speed"}


@dataclass(frozen=True, slots=True, kw_only=True)
class Column:
    """One column of a file: its place and name there, the signal it is read as and that one's unit in the file."""

    index: int
    name: str
    signal: str | None
    unit: str
    scale: float = 1.0


@dataclass(frozen=True, slots=True, kw_only=True)
class Reading:
    """The result of reading a file: the recording, its columns, and warnings."""

    drive: RecordedDrive
    columns: Sequence[Column]
    warnings: Sequence[str]


def read(content: bytes, mapping: Mapping[str, str]) -> Reading:
    """Return the recording of a CSV file.

    Args:
        content: The file.
        mapping: By name of a column its `signal [unit]`, or nothing where it is left out; other columns are read by
            their own names.

    Raises:
        CsvError: It is none; `line` is where.
    """
    number, lines, between, names = _opened(content)
    columns = _columns(names, mapping, number)
    used = [column for column in columns if column.signal is not None]
    _check_signals(used, number)
    labels = {column.index: column.name for column in used}
    rows = list(csv_lines.numbers(lines, between, len(names), wanted=labels, empty=np.nan))
    if len(rows) < LEAST_SAMPLES:
        raise CsvError(f"A recording has {LEAST_SAMPLES} samples at least", rows[-1][0] if rows else number)
    numbers, table = [line for line, _ in rows], np.array([row for _, row in rows]).T
    signals = {str(each.signal): row * each.scale for each, row in zip(used, table, strict=True)}
    _check(signals, numbers)
    left_out = [column.name or f"column {column.index + 1}" for column in columns if column.signal is None]
    warnings = [f"Left out: {', '.join(left_out[:20])}"] if left_out else []
    clock = signals["time"] if "time" in signals else signals["position"]
    if jumps := _count(np.diff(clock) == 0):
        warnings.append(f"Instants with two samples: {jumps}, taken as the values before and after a jump")
    signals = _apart_at_gaps(signals, numbers, warnings)
    signals = _filled(signals, warnings)
    return Reading(drive=RecordedDrive.of(signals), columns=columns, warnings=[*warnings, *_doubts(signals)])


def _opened(content: bytes) -> tuple[int, csv_lines.Lines, str, list[str]]:
    """Return the line of the header, what follows it, the separator, and the names of the columns."""
    lines = csv_lines.lines(csv_lines.decoded(content), MAX_LINE)
    number, head = next(lines, (1, ""))
    between = csv_lines.separator(head)
    names = [name.strip().strip('"').strip() for name in head.split(between)]
    if len(names) > MAX_COLUMNS:
        raise CsvError(f"A recording may have {MAX_COLUMNS} columns", number)
    if not any(re.search(r"[^\W\d]", name) for name in names):
        raise CsvError("The first line names the columns with their units: time [s], body_acceleration [m/s^2]", number)
    return number, lines, between, names


def _columns(names: Sequence[str], mapping: Mapping[str, str], line: int) -> list[Column]:
    if unknown := [name for name in mapping if name not in names]:
        raise CsvError(f"columns: there is no column {unknown[0]}", line)
    return [_column(index, name, mapping.get(name), line) for index, name in enumerate(names)]


def _column(index: int, name: str, mapped: str | None, line: int) -> Column:
    title, unit = csv_lines.title_and_unit(name if mapped is None else mapped)
    signal = _signal(title)
    if signal is None:
        if mapped:
            raise CsvError(f"Column {index + 1}, {name}: there is no signal {title}; {_known()}", line)
        return Column(index=index, name=name, signal=None, unit=unit)
    expected = SIGNALS[signal].unit
    try:
        if not unit:
            raise ValueError(f"its unit is missing, as in {signal} [{expected}]")
        scale = factor(unit, expected)
    except ValueError as error:
        raise CsvError(f"Column {index + 1}, {name}: {error}", line) from None
    return Column(index=index, name=name, signal=signal, unit=unit, scale=scale)


def _signal(title: str) -> str | None:
    key = re.sub(r"[\s\-]+", "_", title.lower())
    by_label = {re.sub(r"\W+", "_", entry.label.lower()): key for key, entry in SIGNALS.items()}
    return key if key in SIGNALS else ALIASES.get(key, by_label.get(key))


def _known() -> str:
    return f"signals are {', '.join(SIGNALS)}"


def _check_signals(columns: Sequence[Column], line: int) -> None:
    signals = [column.signal for column in columns]
    if twice := [column for column in columns if signals.count(column.signal) > 1]:
        raise CsvError(f"Columns {', '.join(each.name for each in twice)} are the same signal: map one of them", line)
    if not {"time", "position"} & set(signals):
        raise CsvError("A recording has a time or a distance, with its unit: time [s] or distance [m]", line)
    if not set(METRIC_SIGNALS) & set(signals):
        raise CsvError(f"No column is a signal to compare; {_known()}", line)


def _check(signals: Mapping[str, FloatArray], numbers: Sequence[int]) -> None:
    """Refuse a time or a distance that does not go on, or goes on for too long, and what is infinite.

    Two samples at one instant are the values before and after a jump; a third one is none.
    """
    for key, values in signals.items():
        if (infinite := np.isinf(values)).any():
            raise CsvError(f"{SIGNALS[key].label} is not finite", numbers[int(infinite.argmax())])
    for key, longest in (("time", LONGEST_TIME), ("position", LONGEST)):
        if key not in signals:
            continue
        values, label, unit = signals[key], SIGNALS[key].label.lower(), SIGNALS[key].unit
        if (lost := np.isnan(values)).any():
            raise CsvError(f"The {label} is missing", numbers[int(lost.argmax())])
        steps = np.diff(values)
        may_stand = key == "position" and "time" in signals
        still = np.append(False, (steps[1:] <= 0) & (steps[:-1] <= 0))
        back = np.flatnonzero((steps < 0) | (still & (not may_stand)))
        if len(back):
            what = "goes back" if steps[back[0]] < 0 else "stands still"
            raise CsvError(f"The {label} {what}: every line is further on than the one before", numbers[back[0] + 1])
        if values[-1] - values[0] > longest:
            beyond = int((values - values[0] > longest).argmax())
            raise CsvError(
                f"A recording is {longest:g} {unit} long at most: cut it, if its unit is right", numbers[beyond]
            )
        if values[-1] == values[0]:
            raise CsvError(f"The {label} stands still", numbers[-1])


def _apart_at_gaps(
    signals: dict[str, FloatArray], numbers: Sequence[int], warnings: list[str]
) -> dict[str, FloatArray]:
    """Return the signals with a sample without values in each gap, so that nothing is drawn or integrated across it."""
    key, least = ("time", GAP_TIME) if "time" in signals else ("position", GAP_DISTANCE)
    steps = np.diff(signals[key])
    gaps = np.flatnonzero(steps > max(least, GAP_STEPS * float(np.median(steps[steps > 0]))))
    if not len(gaps):
        return signals
    most = f"{steps.max():.3g} {SIGNALS[key].unit}"
    first = numbers[gaps[0] + 1]
    warnings.append(f"Gaps: {len(gaps)}, the longest {most}, the first before line {first}; nothing is known there")
    axes = ("time", "position")
    middle = {name: (signals[name][gaps] + signals[name][gaps + 1]) / 2 for name in axes if name in signals}
    return {name: np.insert(values, gaps + 1, middle.get(name, np.nan)) for name, values in signals.items()}


def _filled(signals: dict[str, FloatArray], warnings: list[str]) -> dict[str, FloatArray]:
    """Return the signals straight between the values of a signal that came at a slower rate than others."""
    at = signals["time"] if "time" in signals else signals["position"]
    filled = {}
    for key, values in signals.items():
        there = np.flatnonzero(np.isfinite(values))
        if len(there) in (0, len(values)):
            if not len(there):
                warnings.append(f"{SIGNALS[key].label} has no values")
            filled[key] = values
            continue
        samples_at, longest = at[there], FILLED_STEPS * float(np.median(np.diff(at[there]))) if len(there) > 1 else 0.0
        following = (
            np.clip(np.searchsorted(samples_at, at), 1, len(samples_at) - 1)
            if len(there) > 1
            else np.zeros(1, np.int64)
        )
        within = (
            (at >= samples_at[0])
            & (at <= samples_at[-1])
            & (samples_at[following] - samples_at[following - 1] <= longest)
        )
        filled[key] = np.where(within & np.isnan(values), np.interp(at, samples_at, values[there]), values)
        for count, what in (
            (_count(np.isnan(values) & within), "straight between its own values"),
            (_count(np.isnan(filled[key])), "missing, and so are its metrics there"),
        ):
            if count:
                warnings.append(f"{SIGNALS[key].label}: {what}, {count} of {len(values)} samples")
    return filled


def _count(which: NDArray[np.bool_]) -> int:
    return int(np.count_nonzero(which))


def _doubts(signals: Mapping[str, FloatArray]) -> list[str]:
    """Say what may be wrong with units, and what lies in signals beside motion."""
    said = []
    for key, values in signals.items():
        largest, unit = LARGEST.get(SIGNALS[key].unit), SIGNALS[key].unit
        if key in ("time", "position") or largest is None or np.isnan(values).all():
            continue
        if (most := float(np.nanmax(np.abs(values)))) > largest:
            said.append(f"{SIGNALS[key].label} reaches {most:.3g} {unit}: is its unit right?")
    return said + (describe_offsets(signals, float(np.ptp(signals["time"]))) if "time" in signals else [])
