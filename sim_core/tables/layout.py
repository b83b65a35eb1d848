"""How a table is laid out in a text: what stands between cells, where titles, units and values begin and end."""

from collections.abc import Sequence
from dataclasses import dataclass
from itertools import islice
from statistics import mode

from sim_core.tables import text as texts
from sim_core.tables.errors import TableError
from sim_core.tables.text import Row, is_missing, is_value
from sim_core.tables.titles import is_unit

_SNIFFED_LINES, _SNIFFED_CHARACTERS = 4000, 2_000_000  # in which the first values have to be
_TITLES_WITHIN = 8  # lines above the values
LEAST_VALUES = 0.4  # of the cells of a row
_SINGLE_COLUMN = 0.1  # what one column is worth beside several, when separators are compared


@dataclass(frozen=True, slots=True, kw_only=True)
class Layout:
    """Where a text has its table.

    Attributes:
        separator: Between cells; a blank is any number of blanks and tabs.
        decimal: Before a fraction, a point or a comma.
        decimal_sure: Whether it can only be that one.
        titles_line: The line of the titles, the first being 1; None where there is none.
        units_line: That of a row of units.
        first_row: That of the first values.
        titles: Of each column, numbered where there are none.
        units: Of each column as the row of units has it; empty where it has none.
        sample: The first values, a row each.
        preamble: The lines above the titles.
        step: Between two rows, where the file's head says it, and its unit.
    """

    separator: str
    decimal: str
    decimal_sure: bool
    titles_line: int | None
    units_line: int | None
    first_row: int
    titles: Sequence[str]
    units: Sequence[str]
    sample: Sequence[Sequence[str]]
    preamble: Sequence[Sequence[str]] = ()
    step: tuple[float, str] | None = None


def find_layout(text: str, separator: str | None = None, titles_line: int | None = None) -> Layout:
    """Return the likeliest layout of a table in a text, with the separator and the line of titles where they are given.

    It is that of the longest run of lines with equally many cells, most of them values.

    Raises:
        TableError: There is no such run.
    """
    errors: list[TableError] = []
    head = text[:_SNIFFED_CHARACTERS]
    runs = [_longest_run(head, each, errors) for each in ([separator] if separator else texts.SEPARATORS)]
    best = max((run for run in runs if run is not None), key=_Run.rank, default=None)
    if best is None or (best.width == 1 and errors):
        raise errors[0] if errors else TableError("There are no rows of numbers in this file")
    above = best.rows[: best.start]
    titles, units = _titles(above, best.width, titles_line, best.separator)
    sample = [cells for _, cells in best.rows[best.start : best.end] if any(cells) and not texts.is_comment(cells)]
    numeric = [cell for cells in sample[:500] for cell in cells if is_value(cell) and ":" not in cell]
    decimal, sure = texts.decimal_mark(numeric)
    first_of_titles = titles[0] if titles else best.rows[best.start][0]
    return Layout(
        separator=best.separator,
        decimal=decimal,
        decimal_sure=sure,
        titles_line=titles[0] if titles else None,
        units_line=units[0] if units else None,
        first_row=best.rows[best.start][0],
        titles=_padded(titles[1], sample) if titles else [f"Column {1 + place}" for place in range(best.width)],
        units=_padded(units[1], sample) if units else [""] * best.width,
        sample=sample,
        preamble=[cells for line, cells in above if line < first_of_titles],
    )


@dataclass(frozen=True, slots=True)
class _Run:
    """The longest run of rows of values that one separator gives: rows[start:end]."""

    separator: str
    rows: list[Row]
    start: int
    end: int
    width: int
    worth: float

    def rank(self) -> tuple[float, bool, int]:
        """Return what is compared with other runs; blanks, at which words are cut as well, come last of equals."""
        return self.worth, self.separator != " ", sum(len(cells) for _, cells in self.rows[: self.start])


def _longest_run(head: str, separator: str, errors: list[TableError]) -> _Run | None:
    rows: list[Row] = []
    try:
        rows.extend(islice(texts.rows(head, separator), _SNIFFED_LINES))
    except TableError as error:
        errors.append(error)  # what came before may do; the whole is read again
    best: _Run | None = None
    start, width, worth = 0, 0, 0.0
    for place, (_, cells) in enumerate([*rows, (0, ["end"])]):
        share = values_share(cells)
        if not any(cells) or texts.is_comment(cells) or (share > 0 and len(cells) == width):
            worth += share
            continue
        worth *= _SINGLE_COLUMN if width == 1 else 1
        if width and worth > (best.worth if best else 0):
            best = _Run(separator, rows, start, place, width, worth)
        start, width, worth = place, len(cells) if share else 0, share
    return best


def values_share(cells: Sequence[str]) -> float:
    """Return the share of values among the cells that are there; 0 where too few are."""
    there = [cell for cell in cells if not is_missing(cell)]
    share = sum(map(is_value, there)) / len(there) if there else 0.0
    return share if share > LEAST_VALUES else 0.0


def _titles(above: Sequence[Row], width: int, wanted: int | None, separator: str) -> tuple[Row | None, Row | None]:
    """Return the row of titles and that of units above the values, of equally many cells as these."""
    units: Row | None = None
    nearest: Row | None = None
    for line, found in [row for row in reversed(above) if any(row[1])][:_TITLES_WITHIN]:
        is_comment = texts.is_comment(found)
        found = texts.without_comment_sign(found) if is_comment else found
        cells = _joined(found, width) if separator == " " else found
        if wanted is not None and line != wanted and units is not None:
            continue
        if not _fits(cells, width, is_comment=is_comment) or (wanted is None and values_share(cells)):
            continue
        if units is None and line != wanted and _are_units(cells):
            units = (line, cells)
        elif nearest is not None:
            is_better = line == min(nearest[0], *units[:1] if units else ()) - 1 and _are_distinct(cells)
            return ((line, cells) if is_better else nearest), units
        elif wanted in (None, line):
            nearest = (line, cells)
            if wanted is not None or _are_distinct(cells):
                break
    return nearest, units


def _are_distinct(cells: Sequence[str]) -> bool:
    """Check whether most of the cells are there and no two are the same, as titles are."""
    there = [cell for cell in cells if cell]
    return len(set(there)) == len(there) >= len(cells) / 2


def _fits(cells: Sequence[str], width: int, *, is_comment: bool) -> bool:
    """Check whether a row may be the titles; that of an index may be missing, and a last column be empty."""
    return len(cells) == width or (width > 2 and abs(len(cells) - width) == 1 and not is_comment)


def _joined(cells: Sequence[str], width: int) -> list[str]:
    """Return titles cut at blanks with their units in brackets behind them again."""
    joined: list[str] = []
    for cell in cells:
        opened = joined and joined[-1].count("[") + joined[-1].count("(") > joined[-1].count("]") + joined[-1].count(
            ")"
        )
        if joined and len(cells) > width and (cell[:1] in ("[", "(") or opened):
            joined[-1] += f" {cell}"
        else:
            joined.append(cell)
    return joined


def _are_units(cells: Sequence[str]) -> bool:
    """Check whether each cell is a unit, or says that there is none, and one at least is one."""
    known = [is_unit(cell.strip("[]()")) for cell in cells if not is_missing(cell)]
    return bool(known) and all(known)


def _padded(cells: Sequence[str], sample: Sequence[Sequence[str]]) -> list[str]:
    """Return one cell for each column; a missing first one belongs to an index, a missing last one to no title."""
    width = mode(map(len, sample))
    missing = width - len(cells)
    if missing > 0 and _counts([row[0] for row in sample]):
        return [*[""] * missing, *cells]
    return [*cells, *[""] * missing][:width]


def _counts(cells: Sequence[str]) -> bool:
    """Check whether these are 0, 1, 2 … or 1, 2, 3 …: an index."""
    return cells[0] in ("0", "1") and list(cells) == [str(int(cells[0]) + place) for place in range(len(cells))]
