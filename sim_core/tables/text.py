"""The text of a file, and its lines cut into cells, within bounds that keep a hostile file cheap."""

import csv
import io
import re
from collections.abc import Iterator
from itertools import islice

import charset_normalizer

from sim_core.tables.errors import TableError

MAX_BYTES = 64 * 2**20
MAX_LINES = 2_000_000
MAX_LINE = 20_000  # characters
MAX_COLUMNS = 400
MAX_CELLS = 50_000_000

# Each with what stands between two cells; a blank is any number of blanks and tabs.
SEPARATORS = ("\t", ";", ",", "|", " ")
Row = tuple[int, list[str]]  # the line where it begins, the first being 1, and its cells

_SAMPLE = 65_536  # bytes from which an encoding is found
_BYTE_ORDER_MARKS = ((b"\xef\xbb\xbf", "utf-8-sig"), (b"\xff\xfe", "utf-16"), (b"\xfe\xff", "utf-16"))
_ONE_BYTE_ENCODINGS = ["cp1252", "mac_roman", "cp437"]


def decoded(content: bytes, encoding: str | None = None) -> tuple[str, str]:
    """Return the text of a file and its encoding: the one given, or the one that is found.

    Raises:
        TableError: It is too long, or no text.
    """
    if len(content) > MAX_BYTES:
        raise TableError(f"A table has {MAX_BYTES // 2**20} MB at most")
    encoding = encoding or _encoding(content)
    try:
        text = content.decode(encoding)
    except LookupError:
        raise TableError("There is no such encoding") from None
    except UnicodeDecodeError as error:
        raise TableError(f"This is not {encoding}", content.count(b"\n", 0, error.start) + 1) from None
    if "\0" in text:
        raise TableError("This is no text: it has bytes of value 0", text.count("\n", 0, text.index("\0")) + 1)
    return text, encoding


def _encoding(content: bytes) -> str:
    for mark, encoding in _BYTE_ORDER_MARKS:
        if content.startswith(mark):
            return encoding
    head = content[:_SAMPLE]
    zeros = [head[first::2].count(0) / max(1, len(head) // 2) for first in (0, 1)]
    if max(zeros) > 0.4:  # of a text that is mostly ASCII every other byte is 0
        return "utf-16-be" if zeros[0] > zeros[1] else "utf-16-le"
    try:
        content.decode("utf-8")
    except UnicodeDecodeError as error:
        start = max(0, error.start - _SAMPLE // 2)
        found = charset_normalizer.from_bytes(content[start : start + _SAMPLE], cp_isolation=_ONE_BYTE_ENCODINGS).best()
        return found.encoding if found else _ONE_BYTE_ENCODINGS[0]
    return "utf-8"


def rows(text: str, separator: str, first: int = 1) -> Iterator[Row]:
    """Yield the lines of the text from the one named `first` on, cut into cells; a quoted cell may span lines.

    Raises:
        TableError: There are too many lines, columns or cells, or one is too long.
    """
    lines = _bounded(io.StringIO(text, newline=None), blanks=separator == " ")
    reader = csv.reader(islice(lines, first - 1, None), delimiter=separator, skipinitialspace=True)
    before, count = 0, 0
    try:
        for cells in reader:
            line, before, count = before + first, reader.line_num, count + len(cells)
            if len(cells) > MAX_COLUMNS:
                raise TableError(f"A table has {MAX_COLUMNS} columns at most", line)
            if count > MAX_CELLS:
                raise TableError(f"A table has {MAX_CELLS} cells at most", line)
            yield line, [cell.strip() for cell in cells]
    except csv.Error:
        raise TableError("A quotation mark is not closed", before + first) from None


def _bounded(lines: io.StringIO, *, blanks: bool) -> Iterator[str]:
    for number, line in enumerate(lines, 1):
        if number > MAX_LINES:
            raise TableError(f"A table has {MAX_LINES} lines at most", number)
        if len(line) > MAX_LINE:
            raise TableError(f"A line has {MAX_LINE} characters at most", number)
        yield f"{' '.join(line.split())}\n" if blanks else line


_COMMENT = re.compile(r"(?:#|%|//|!)\s*")

# Numbers: with a sign, thousands, a fraction after a point or a comma, an exponent.
_BETWEEN_THOUSANDS = "'  \u202f’"
_NUMERIC = re.compile(rf"[+\-−]?(?:\d(?:[\d.,{_BETWEEN_THOUSANDS}]*[\d.])?|[.,]\d+)(?:[eEdD][+-]?\d+)?")
_THOUSANDS = {
    decimal: re.compile(rf"[+\-−]?\d{{1,3}}([{other}{_BETWEEN_THOUSANDS}])\d{{3}}(?:\1\d{{3}})*(?:\{decimal}\d*)?")
    for decimal, other in ((".", ","), (",", "."))
}
# Hours, if there are any, minutes, seconds with a fraction, and half of the day.
CLOCK = re.compile(r"(?:^|[T\s])(?:(\d{1,3}):)?(\d{1,2}):(\d{2}(?:[.,:]\d+)?)\s*([AaPp])?")
_MISSING = re.compile(r"|-{1,2}|–|-?nan(\(ind\))?|-?1\.#\w+|#?n/?a|#nv|null|none|nil|no ?data|#[\w/]+[!?]|\?|\*+")
_STATION = re.compile(r"^(\d{1,6})\+(\d{2,3})([.,]\d+)?$")  # 12+340.5, of km and m or of hundreds of feet and feet


def is_missing(cell: str) -> bool:
    """Check whether the cell says that there is no value."""
    return _MISSING.fullmatch(cell.lower()) is not None


def is_comment(cells: list[str]) -> bool:
    """Check whether a row is a comment."""
    return bool(cells) and _COMMENT.match(cells[0]) is not None


def without_comment_sign(cells: list[str]) -> list[str]:
    """Return the cells of a comment without the sign before it."""
    first = _COMMENT.sub("", cells[0], count=1)
    return [first, *cells[1:]] if first else cells[1:]


def is_value(cell: str) -> bool:
    """Check whether the cell looks like a number, a clock's time or a date."""
    return any(each.fullmatch(cell) for each in (_NUMERIC, _STATION)) or CLOCK.search(cell) is not None


def number(cell: str, decimal: str) -> float | None:
    """Return the number in a cell whose fraction follows that decimal mark; None where there is none."""
    text = _STATION.sub(r"\1\2\3", cell.replace("−", "-"))
    if _THOUSANDS[decimal].fullmatch(text):
        text = re.sub(rf"[{'.' if decimal == ',' else ','}{_BETWEEN_THOUSANDS}]", "", text)
    if _NUMERIC.fullmatch(text) is None:
        return None
    try:
        return float(re.sub("[dD]", "e", text.replace(decimal, ".")))
    except ValueError:
        return None


def decimal_mark(cells: list[str]) -> tuple[str, bool]:
    """Return the decimal mark of these numeric cells, and whether it is sure.

    A comma with three digits behind it, alone and everywhere, may stand between thousands.
    """
    commas = [cell for cell in cells if "," in cell]
    if not commas:
        return ".", True
    if any("." in cell for cell in commas):
        last = [max(".,", key=cell.rfind) for cell in commas if "." in cell]
        return max(".,", key=last.count), len(set(last)) == 1
    grouped = [cell for cell in commas if re.fullmatch(r"[+\-−]?[1-9]\d{0,2}(?:,\d{3})+", cell)]
    several = any(cell.count(",") > 1 for cell in grouped)
    return ("." if several else ","), several or len(grouped) < len(commas)
