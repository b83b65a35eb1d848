"""What each column of a table means and in which unit, what says where or when a row is, and what has to be asked."""

import re
from collections.abc import Mapping, Sequence
from dataclasses import dataclass, replace
from math import isclose, isinf
from typing import TYPE_CHECKING

import numpy as np

from sim_core.arrays import FloatArray
from sim_core.catalogue import METRIC_SIGNALS, SIGNALS
from sim_core.recorded.offsets import GRAVITY, gravity_in
from sim_core.tables.errors import TableError
from sim_core.tables.layout import Layout
from sim_core.tables.text import CLOCK, is_missing, number
from sim_core.tables.titles import DRIVE, EPOCHS, KINDS, MEANINGS, ROAD, meanings, size_of, unit_in, words
from sim_core.units import UNITS

if TYPE_CHECKING:
    from sim_core.tables.table import ColumnForm, TableForm

# In place of a unit of time: 10:00:00.5, with or without a date; and 100000.5, the same as digits.
CLOCK_UNIT, DIGITS_UNIT = "clock", "hhmmss"
_EPOCH_SIZES = ((1e17, "ns"), (1e14, "µs"), (1e11, "ms"), (0.0, "s"))  # by the size of the numbers since 1970
_RATE = re.compile(r"(?:sampl\w*|abtast)[\s_]*(?:rate|freq\w*)\W*(?:hz)?\W*([\d.]+)\s*(?:hz\b|$)", re.IGNORECASE)


@dataclass(frozen=True, slots=True)
class Question:
    """What has to be answered before a table can be read.

    Attributes:
        field: The place of the answer in the description, as a JSON pointer.
        text: The question.
        choices: Possible answers; empty where any number may be one.
        guess: The likeliest; None where there is none.
    """

    field: str
    text: str
    choices: Sequence[str]
    guess: str | float | None


@dataclass(frozen=True, slots=True, kw_only=True)
class Column:
    """One column of a table.

    Attributes:
        index: Its place, the first being 0.
        title: As it stands in the file.
        means: Distance, height, left or right in a road; a signal of the catalogue in a drive; None: left out.
        unit: Of its values, as it is written; `clock` of times such as 10:00:00.5; empty where none is known.
        sure: Whether both can be read off the file.
        direction: Of a vertical acceleration: which way is positive.
        likely: What a column that is left out may mean.
    """

    index: int
    title: str
    means: str | None
    unit: str
    sure: bool
    direction: str = "up"
    likely: str | None = None


@dataclass(frozen=True, slots=True, kw_only=True)
class Clock:
    """What says where or when a row is: a column, or a constant step.

    Attributes:
        column: The place of the column of time or distance; None where there is none.
        rate: Rows in a second, without such a column of a drive [Hz].
        spacing: Between two rows, without such a column of a road [m].
    """

    column: int | None
    rate: float | None = None
    spacing: float | None = None


def kind_of(layout: Layout, decimal: str, questions: list[Question]) -> str:
    """Return what a table is likely of, and ask where its titles fit both or neither."""
    sure = {
        kind: {meaning for title in layout.titles for meaning, ok in [meanings(kind, title)] if ok} for kind in KINDS
    }
    is_road = "distance" in sure[ROAD] and bool({"height", "left"} & sure[ROAD])
    along = next((place for place, title in enumerate(layout.titles) if meanings(ROAD, title)[0] == "distance"), 0)
    is_road = is_road and _rises(_sample(layout, along, decimal))
    is_drive = "time" in sure[DRIVE] or bool(set(METRIC_SIGNALS) & sure[DRIVE])
    is_likely_road = not is_drive and len(layout.titles) <= 4 and _rises(_sample(layout, 0, decimal))
    guess = ROAD if is_road or is_likely_road else DRIVE
    if is_road == is_drive or (is_road and all(len(title) == 1 for title in layout.titles)):
        questions.append(Question("/kind", "Is this a road or a recorded drive?", KINDS, guess))
    return guess


def understood(
    layout: Layout, decimal: str, kind: str, given: "TableForm", questions: list[Question]
) -> tuple[list[Column], Clock]:
    """Return the columns and the clock, and ask what is not sure.

    Raises:
        TableError: A correction names a column, a meaning or a unit that there is not.
    """
    samples = [_sample(layout, index, decimal) for index in range(len(layout.titles))]
    named = _given(layout.titles, given)
    found = [
        _said(index, title, named[index], kind) if index in named else _found(index, title, layout.units[index], kind)
        for index, title in enumerate(layout.titles)
    ]
    found = _beside_y(found, samples, named)
    found = _by_place(found, samples, layout, kind, left_out=[place for place, form in named.items() if not form.means])
    found = _once_each(found, layout, kind, questions)
    needed = [each for each in found if each.means is not None]
    found = [
        _settled(each, samples[each.index], layout, kind, questions, said=each.index in named)
        if each in needed
        else each
        for each in found
    ]
    if kind == DRIVE and not any(form.means == "body_acceleration" for form in named.values()):
        found = _where_gravity_is(found, samples, questions)
    return found, _clock(found, layout, kind, given, questions)


def _given(titles: Sequence[str], given: "TableForm") -> dict[int, "ColumnForm"]:
    """Return what is said of columns by their places."""
    forms = given.columns or []
    if [form.title or title for form, title in zip(forms, titles, strict=False)] == list(titles):
        return dict(enumerate(forms))
    places: dict[int, ColumnForm] = {}
    for form in forms:
        same = [place for place, title in enumerate(titles) if title == form.title]
        place = next((each for each in same if each not in places), None)
        if not same:
            raise TableError("table: columns: there is no column of this title; or name all columns in order")
        if place is not None:  # what is said first of a column counts
            places[place] = form
    return places


def _said(index: int, title: str, form: "ColumnForm", kind: str) -> Column:
    means, sure = meanings(kind, form.means or "")
    if form.means and not sure:
        raise TableError(f"table: columns/{index}/means: a {kind} has {', '.join(MEANINGS[kind])}")
    unit = form.unit
    if means and not unit:
        unit = unit_in(title, MEANINGS[kind][means])[1]
    return Column(index=index, title=title, means=means, unit=unit or "", sure=True, direction=form.direction or "up")


def _found(index: int, title: str, unit_row: str, kind: str) -> Column:
    means, sure = meanings(kind, title)
    written = unit_row.strip("[]()") or unit_in(title, MEANINGS[kind][means] if means else "")[1]
    direction = "down" if {"down", "depth", "tiefe"} & set(words(title).split()) else "up"
    return Column(index=index, title=title, means=means, unit=written, sure=sure, direction=direction)


def _beside_y(found: list[Column], samples: Sequence[FloatArray], named: Mapping[int, "ColumnForm"]) -> list[Column]:
    """Return the columns, with an x not sure to be the distance where a y varies as well: both may be a map's."""
    spreads = {words(each.title).partition(" ")[0]: _spread(samples[each.index]) for each in found}
    if spreads.get("y", 0) > 0.01 * spreads.get("x", 0):
        is_x = [words(each.title).partition(" ")[0] == "x" and each.index not in named for each in found]
        return [replace(each, sure=each.sure and not x) for each, x in zip(found, is_x, strict=True)]
    return found


def _where_gravity_is(found: list[Column], samples: Sequence[FloatArray], questions: list[Question]) -> list[Column]:
    """Return the columns, and ask where another one than the body's vertical acceleration has gravity in it."""
    body = next((each for each in found if each.means == "body_acceleration"), None)
    with_it = [each for each in found if each.means is None and gravity_in(_accelerations(each, samples))]
    if body is None or not with_it or abs(_middle(_accelerations(body, samples))) > GRAVITY / 2:
        return found
    choices = (str(with_it[0].index + 1), str(body.index + 1))
    asked = f"Gravity is in column {choices[0]}, not in {choices[1]}: which one is the body acceleration?"
    questions.append(Question(f"/columns/{with_it[0].index}/means", asked, choices, choices[0]))
    found[with_it[0].index] = replace(with_it[0], means=body.means)
    found[body.index] = replace(body, means=None, likely=body.means)
    return found


def _accelerations(column: Column, samples: Sequence[FloatArray]) -> FloatArray:
    """Return the first values of a column [m/s^2], NaN where it has another quantity."""
    return samples[column.index] * (size_of(column.unit, "m/s^2") or np.nan)


def _is_clock(column: Column, layout: Layout) -> bool:
    """Check whether most of the cells are times such as 10:00:00.5."""
    rows = [row for row in layout.sample if column.index < len(row) and CLOCK.search(row[column.index])]
    return len(rows) > len(layout.sample) / 2


def _by_place(
    found: list[Column], samples: Sequence[FloatArray], layout: Layout, kind: str, left_out: Sequence[int]
) -> list[Column]:
    """Return the columns, with what they may be by their place and values where no title says it."""
    there = {each.means for each in found}
    axis = "distance" if kind == ROAD else "time"
    if not {axis, "position"} & there:
        unknown = [each for each in found if each.means is None and each.index not in left_out]
        clocks = [each for each in unknown if kind == DRIVE and _is_clock(each, layout)]
        rising = clocks or [each for each in unknown if _rises(samples[each.index])]
        if rising and not (kind == DRIVE and _counts(samples[rising[0].index])):
            found[rising[0].index] = replace(rising[0], means=axis, sure=bool(clocks))
    unknown = [each for each in found if each.means is None and each.index not in left_out]
    others = [each for each in unknown if np.isfinite(samples[each.index]).any()]
    if kind == ROAD and not {"height", "left", "right"} & there and len(others) in (1, 2):
        for each, means in zip(others, ("height",) if len(others) == 1 else ("left", "right"), strict=True):
            found[each.index] = replace(each, means=means)
    if kind == DRIVE and not set(METRIC_SIGNALS) & there and len(others) == 1:
        found[others[0].index] = replace(others[0], means="body_acceleration")
    return found


def _once_each(found: list[Column], layout: Layout, kind: str, questions: list[Question]) -> list[Column]:
    """Return the columns with each meaning once; what is not sure is left out where the table does without."""
    sure = {each.means for each in found if each.sure}
    enough = {"distance", "height"} <= sure or {"distance", "left", "right"} <= sure
    if kind == DRIVE:
        enough = bool(set(METRIC_SIGNALS) & sure)
    taken: dict[str, Column] = {}
    for each in sorted(found, key=lambda column: not column.sure):
        means = each.means
        is_axis = means in ("time", "position", "distance")
        if means is None or (
            not each.sure and enough and not (is_axis and not {"time", "position", "distance"} & sure)
        ):
            found[each.index] = replace(each, means=None, likely=means)
        elif means in taken:
            first = taken[means]
            cells = [[row[column.index] for row in layout.sample] for column in (first, each)]
            if first.sure and each.sure and cells[0] != cells[1]:
                asked = f"Columns {first.index + 1} and {each.index + 1} are both {means}: which one is it?"
                choices = (str(first.index + 1), str(each.index + 1))
                questions.append(Question(f"/columns/{first.index}/means", asked, choices, choices[0]))
            found[each.index] = replace(each, means=None, likely=means)
        else:
            taken[means] = each
    if "height" in taken and "left" in taken:
        found[taken["height"].index] = replace(taken["height"], means=None, likely="height")
    return found


def _settled(
    column: Column, sample: FloatArray, layout: Layout, kind: str, questions: list[Question], *, said: bool
) -> Column:
    """Return a column with its unit, asked where the file does not say it."""
    place, means = f"/columns/{column.index}", str(column.means)
    si = MEANINGS[kind][means]
    if not (column.sure or said):
        asked = f"Is “{column.title}” the {_label(means)}{', down positive' * (column.direction == 'down')}?"
        questions.append(Question(f"{place}/means", asked, tuple(MEANINGS[kind]), means))
    if means == "time":
        if column.unit == DIGITS_UNIT:
            return column
        if column.unit == CLOCK_UNIT or _is_clock(column, layout):
            return replace(column, unit=CLOCK_UNIT)
        middle = _middle(sample)
        if set(column.unit.lower().split()) & set(EPOCHS) or (not column.unit and middle > 1e9):
            return replace(column, unit=next(unit for least, unit in _EPOCH_SIZES if middle >= least))
    problem = "" if column.unit else f"In which unit is “{column.title}”?"
    own = unit_in(column.title, si)[1]
    size, own_size = size_of(column.unit, si), size_of(own, si)
    if column.unit and size is None:
        problem = f"“{column.unit}”, the unit of “{column.title}”, is not understood: which one is it?"
    elif size and own_size and not said and not isclose(size, own_size):
        problem = f"“{column.title}” says {own}, and the row of units {column.unit}: which one is it?"
    if not problem:
        return column
    if said and column.unit:
        raise TableError(f"table: columns/{column.index}/unit: {problem}")
    guess = _likely_unit(means, si, sample)
    units = next((units for units in UNITS.values() if si in units), {si: 1.0})
    questions.append(Question(f"{place}/unit", problem, tuple(dict.fromkeys([*units, guess])), guess))
    return replace(column, unit=guess, sure=False)


def _clock(found: Sequence[Column], layout: Layout, kind: str, given: "TableForm", questions: list[Question]) -> Clock:
    """Return what says where or when a row is, and ask where nothing does."""
    axes = ("distance",) if kind == ROAD else ("time", "position")
    column = next((each.index for axis in axes for each in found if each.means == axis), None)
    if column is not None:
        return Clock(column=column)
    said = given.clock
    if kind == ROAD:
        spacing = said.spacing if said else None
        if spacing is None and layout.step is not None:
            value, unit = layout.step
            spacing = value * (size_of(unit, "m") or 1)
            if size_of(unit, "m") is None:
                questions.append(Question("/clock/spacing", "How far are two heights apart, in metres?", (), value))
        elif spacing is None:
            questions.append(Question("/clock/spacing", "How far are two heights apart, in metres?", (), None))
        return Clock(column=None, spacing=spacing)
    rate = (said.rate if said else None) or _rate_above(layout)
    if rate is None:
        asked = "No column is the time: how many rows are there in a second, in Hz?"
        questions.append(Question("/clock/rate", asked, (), None))
    return Clock(column=None, rate=rate)


def _rate_above(layout: Layout) -> float | None:
    """Return the sample rate that the lines above the titles say [Hz]."""
    said = (_RATE.search(" ".join(cells).rstrip()) for cells in layout.preamble)
    return next((rate for match in said if match and (rate := number(match[1], "."))), None)


def are_complete(kind: str, columns: Sequence[Column], clock: Clock) -> bool:
    """Check whether there is what a table of this kind has at least, be it as a guess."""
    means = {each.means for each in columns}
    is_placed = clock.column is not None or clock.rate is not None or clock.spacing is not None
    if kind == ROAD:
        return is_placed and ("height" in means or {"left", "right"} <= means)
    return is_placed and bool(set(METRIC_SIGNALS) & means)


def ask_for_missing(kind: str, columns: Sequence[Column], questions: list[Question]) -> None:
    """Ask for what a table of this kind has at least, where no column is known to be it."""
    means = {each.means for each in columns}
    titles = tuple(each.title for each in columns if each.means is None)
    if kind == ROAD and not ("height" in means or {"left", "right"} <= means):
        questions.append(
            Question("/columns", "Which column is the height, or which two the left and the right one?", titles, None)
        )
    if kind == DRIVE and not set(METRIC_SIGNALS) & means:
        asked = "No column is known as a signal to compare: which one is it, such as the body acceleration?"
        questions.append(Question("/columns", asked, titles, None))


def left_out(columns: Sequence[Column]) -> list[str]:
    """Return a note on the columns that are not read."""
    names = [
        (each.title or f"column {each.index + 1}") + (f" (it may be the {_label(each.likely)})" if each.likely else "")
        for each in columns
        if each.means is None
    ]
    return [f"Left out: {', '.join(names[:20])}{' …' if len(names) > 20 else ''}"] if names else []


def _label(means: str) -> str:
    return (
        SIGNALS[means].label.lower()
        if means in SIGNALS
        else {"left": "left height", "right": "right height"}.get(means, means)
    )


def _sample(layout: Layout, index: int, decimal: str) -> FloatArray:
    cells = [row[index] for row in layout.sample if index < len(row)]
    return np.array([np.nan if is_missing(cell) else _or_nan(number(cell, decimal)) for cell in cells])


def _or_nan(value: float | None) -> float:
    return np.nan if value is None or isinf(value) else value


def _rises(sample: FloatArray) -> bool:
    steps = np.diff(sample)
    return len(steps) > 0 and bool((steps > 0).all() or (steps < 0).all())


def _counts(sample: FloatArray) -> bool:
    return bool((np.diff(sample) == 1).all()) and sample[0] in (0, 1)


def _spread(sample: FloatArray) -> float:
    return float(np.nanmax(sample) - np.nanmin(sample)) if np.isfinite(sample).any() else 0.0


def _middle(sample: FloatArray) -> float:
    return float(np.nanmedian(sample)) if np.isfinite(sample).any() else 0.0


def _likely_unit(means: str, si: str, sample: FloatArray) -> str:
    """Return the unit in which values of this size would be a car's or a road's."""
    spread = _spread(sample)
    step = abs(float(np.nanmedian(np.diff(sample)))) if len(sample) > 1 and np.isfinite(sample).any() else 0.0
    if means == "time":
        return "d" if 0 < step < 1e-5 else "s" if step < 0.5 else "ms" if step < 500 else "µs" if step < 5e5 else "ns"
    if means in ("height", "left", "right") or means.endswith(("deflection", "_road")):
        return "m" if spread < 1 else "mm"
    if means == "speed":
        return "km/h" if _middle(sample) > 20 else "m/s"
    if means.endswith("acceleration") and si == "m/s^2":
        mean = abs(_middle(sample))
        return "g" if (0.8 < mean < 1.2 and spread < 4) or (mean < 0.3 and spread < 1) else "m/s^2"
    return si
