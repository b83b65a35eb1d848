"""A recorded drive out of a table's values: a clock that goes on, gaps apart, signals of slower rates filled."""

from collections.abc import Mapping
from typing import TYPE_CHECKING

import numpy as np
from numpy.typing import NDArray

from sim_core.arrays import FloatArray
from sim_core.catalogue import SIGNALS
from sim_core.recorded.offsets import describe_offsets
from sim_core.scenario.recorded import LONGEST
from sim_core.tables.columns import Clock, Question
from sim_core.tables.errors import TableError
from sim_core.tables.values import Values

if TYPE_CHECKING:
    from sim_core.tables.table import TableForm

LEAST_SAMPLES, MOST_SAMPLES = 10, 400_000
LONGEST_TIME = 3600.0  # [s]
# A step of so many usual ones, and so long, is a gap: nothing is known in it [s], [m].
GAP_STEPS, GAP_TIME, GAP_DISTANCE = 10.0, 0.1, 1.0
FILLED_STEPS = 3.0  # a signal of a slower rate is straight between values at most so many of its own steps apart
# Values beyond are hardly a car's, by SI unit.
LARGEST = {"m/s^2": 200.0, "rad/s^2": 300.0, "N": 1e5, "m": 1.0, "m/s": 100.0, "Pa": 1e8}


def made(
    cells: Values, clock: Clock, given: "TableForm", questions: list[Question], notes: list[str]
) -> dict[str, FloatArray]:
    """Return the signals (samples,) [SI units] with NaN where nothing is known, and what was done or has to be asked.

    Raises:
        TableError: The time or the distance does not go on, or there is too little.
    """
    signals, lines = dict(cells.signals), np.array(cells.lines)
    if len(lines) < LEAST_SAMPLES:
        raise TableError(f"A recording has {LEAST_SAMPLES} samples at least", int(lines[-1]) if len(lines) else None)
    if clock.column is None and clock.rate is not None:
        signals = {"time": np.arange(len(lines)) / clock.rate, **signals}
    signals, lines = _part(signals, lines, given, questions, notes)
    for key, longest in (("time", None), ("position", LONGEST)):
        if key in signals:
            _check_going_on(key, signals, lines, longest)
    axis = signals["time"] if "time" in signals else signals["position"]
    if jumps := _count(np.diff(axis) == 0):
        notes.append(f"Instants with two samples: {jumps}, taken as the values before and after a jump")
    signals = _filled(_apart_at_gaps(signals, lines, notes), notes)
    notes += _doubts(signals)
    return signals


def _part(
    signals: dict[str, FloatArray],
    lines: NDArray[np.int64],
    given: "TableForm",
    questions: list[Question],
    notes: list[str],
) -> tuple[dict[str, FloatArray], NDArray[np.int64]]:
    """Return the part of the drive that is asked for, by time, or by distance without one."""
    axis = "time" if "time" in signals else "position"
    values, longest = signals[axis], LONGEST_TIME if axis == "time" else LONGEST
    since = values - values[0]
    if given.from_ is None and given.to is None and not np.nanmax(since) > longest and len(values) <= MOST_SAMPLES:
        return signals, lines
    first = 0.0 if given.from_ is None else given.from_
    last = float(np.nanmax(since)) if given.to is None else given.to
    unit = SIGNALS[axis].unit
    if last - first > longest:
        length = f"{np.nanmax(since):.6g} {unit}"
        asked = f"The recording is {length} long, and {longest:g} {unit} are taken at most: up to where?"
        questions.append(Question("/to", asked, (), first + longest))
        last = first + longest
    taken = (since >= first) & (since <= last)
    if np.count_nonzero(taken) < LEAST_SAMPLES:
        raise TableError("table: from and to leave too little of the recording")
    if np.count_nonzero(taken) > MOST_SAMPLES:
        asked = (
            f"The recording has {np.count_nonzero(taken)} samples, and {MOST_SAMPLES} are taken at most: up to where?"
        )
        questions.append(Question("/to", asked, (), float(since[taken][MOST_SAMPLES - 1])))
    notes.append(f"Taken from {first:.6g} {unit} to {last:.6g} {unit} after its start")
    return {key: each[taken] for key, each in signals.items()}, lines[taken]


def _check_going_on(
    key: str, signals: Mapping[str, FloatArray], lines: NDArray[np.int64], longest: float | None
) -> None:
    """Refuse a time or a distance that does not go on.

    Two samples at one instant are the values before and after a jump; a third one is none.
    """
    values, label, unit = signals[key], SIGNALS[key].label.lower(), SIGNALS[key].unit
    if (lost := np.isnan(values)).any():
        raise TableError(f"The {label} is missing", int(lines[lost.argmax()]))
    steps = np.diff(values)
    may_stand = key == "position" and "time" in signals
    still = np.append(False, (steps[1:] <= 0) & (steps[:-1] <= 0))
    back = np.flatnonzero((steps < 0) | (still & (not may_stand)))
    if len(back):
        what = "goes back" if steps[back[0]] < 0 else "stands still"
        raise TableError(f"The {label} {what}: every line is further on than the one before", int(lines[back[0] + 1]))
    if longest is not None and values[-1] - values[0] > longest:
        beyond = int((values - values[0] > longest).argmax())
        raise TableError(
            f"A recording is {longest:g} {unit} long at most: cut it, if its unit is right", int(lines[beyond])
        )
    if values[-1] == values[0]:
        raise TableError(f"The {label} stands still", int(lines[-1]))


def _apart_at_gaps(signals: dict[str, FloatArray], lines: NDArray[np.int64], notes: list[str]) -> dict[str, FloatArray]:
    """Return the signals with a sample without values in each gap, so that nothing is drawn or integrated across it."""
    key, least = ("time", GAP_TIME) if "time" in signals else ("position", GAP_DISTANCE)
    steps = np.diff(signals[key])
    gaps = np.flatnonzero(steps > max(least, GAP_STEPS * float(np.median(steps[steps > 0]))))
    if not len(gaps):
        return signals
    most = f"{steps.max():.3g} {SIGNALS[key].unit}"
    first = lines[gaps[0] + 1]
    notes.append(f"Gaps: {len(gaps)}, the longest {most}, the first before line {first}; nothing is known there")
    axes = ("time", "position")
    middle = {name: (signals[name][gaps] + signals[name][gaps + 1]) / 2 for name in axes if name in signals}
    return {name: np.insert(values, gaps + 1, middle.get(name, np.nan)) for name, values in signals.items()}


def _filled(signals: dict[str, FloatArray], notes: list[str]) -> dict[str, FloatArray]:
    """Return the signals straight between the values of a signal that came at a slower rate than others."""
    at = signals["time"] if "time" in signals else signals["position"]
    filled = {}
    for key, values in signals.items():
        there = np.flatnonzero(np.isfinite(values))
        if len(there) in (0, len(values)):
            if not len(there):
                notes.append(f"{SIGNALS[key].label} has no values")
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
                notes.append(f"{SIGNALS[key].label}: {what}, {count} of {len(values)} samples")
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
