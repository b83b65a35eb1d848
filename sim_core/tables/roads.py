"""A road out of a table's values: in order, without holes, as long as a road may be."""

from typing import TYPE_CHECKING

import numpy as np

from sim_core.arrays import FloatArray
from sim_core.tables.columns import Clock, Question
from sim_core.tables.errors import TableError
from sim_core.tables.values import Values

if TYPE_CHECKING:
    from sim_core.tables.table import TableForm

MAX_LENGTH, MIN_LENGTH = 3000.0, 5.0  # [m]
BRIDGED, BRIDGED_STEPS = 1.0, 3.0  # a longer step, of so many usual ones, is a gap that is asked about [m]


def made(
    cells: Values, clock: Clock, given: "TableForm", questions: list[Question], notes: list[str]
) -> dict[str, FloatArray]:
    """Return distance and height, or left and right height (rows,) [m], and what was done or has to be asked.

    Raises:
        TableError: The distance turns back or stands still, or there is too little of a road.
    """
    signals, lines = dict(cells.signals), np.array(cells.lines)
    if clock.spacing is not None:
        signals = {"distance": np.arange(len(lines), dtype=np.float64) * clock.spacing, **signals}
    there = np.all([np.isfinite(values) for values in signals.values()], axis=0)
    if not there.all():
        notes.append(f"Rows without a value: {np.count_nonzero(~there)}, the first in line {lines[~there][0]}")
    signals, lines = {key: values[there] for key, values in signals.items()}, lines[there]
    if len(lines) < 2:
        raise TableError("A road has two heights at least")
    if np.median(np.diff(signals["distance"])) < 0:
        signals, lines = {key: values[::-1] for key, values in signals.items()}, lines[::-1]
        notes.append(
            "The distance descends: its rows were turned round, so that the car meets its least distance first"
        )
    distance = signals["distance"]
    steps = np.diff(distance)
    if (back := steps <= 0).any():
        what = "goes back" if steps[back.argmax()] < 0 else "stands still"
        raise TableError(f"The distance {what}: every line is further on than the one before", int(lines[1:][back][0]))
    signals, distance = _part(signals, given, questions, notes)
    _bridge(distance, given, questions, notes)
    if distance[-1] - distance[0] < MIN_LENGTH:
        raise TableError(f"A road is {MIN_LENGTH:g} m long at least; is the unit right?", int(lines[-1]))
    return signals


def _part(
    signals: dict[str, FloatArray], given: "TableForm", questions: list[Question], notes: list[str]
) -> tuple[dict[str, FloatArray], FloatArray]:
    """Return the part of the road that is asked for, and ask for one of a road that is too long."""
    distance = signals["distance"]
    first = distance[0] if given.from_ is None else given.from_
    last = distance[-1] if given.to is None else given.to
    if last - first > MAX_LENGTH + 1e-6:
        asked = (
            f"The road is {distance[-1] - distance[0]:.6g} m long, and {MAX_LENGTH:g} m are taken at most: up to where?"
        )
        questions.append(Question("/to", asked, (), float(first + MAX_LENGTH)))
        last = first + MAX_LENGTH
    taken = (distance >= first - 1e-9) & (distance <= last + 1e-9)
    if np.count_nonzero(taken) < 2:
        raise TableError("table: from and to leave nothing of the road")
    if not taken.all():
        notes.append(f"Taken from {first:.6g} m to {last:.6g} m of {distance[0]:.6g} m to {distance[-1]:.6g} m")
    part = {key: values[taken] for key, values in signals.items()}
    return part, part["distance"]


def _bridge(distance: FloatArray, given: "TableForm", questions: list[Question], notes: list[str]) -> None:
    """Say which gaps straight lines bridge, and ask about long ones."""
    steps = np.diff(distance)
    gaps = steps > BRIDGED_STEPS * np.median(steps)
    if not gaps.any():
        return
    widest = float(steps.max())
    if widest > (BRIDGED if given.bridge is None else given.bridge):
        place = float(distance[:-1][steps.argmax()])
        where = f"over {widest:.4g} m at {place:.6g} m"
        asked = f"Nothing is known {where}: how long a gap may a straight line bridge, in metres?"
        questions.append(Question("/bridge", asked, (), widest))
    notes.append(f"Straight lines bridge gaps: {np.count_nonzero(gaps)}, the widest {widest:.4g} m")
