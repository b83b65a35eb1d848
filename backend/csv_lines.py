"""CSV of measurements: read line by line within bounds; every error has its line. Runs in a worker: no web here."""

import math
from collections.abc import Iterator, Mapping

MAX_LINES = 350_000
MAX_LINE = 500  # characters
MAX_NUMBER = 1e12  # in any unit

Lines = Iterator[tuple[int, str]]  # the number of each, the first being 1, and its text


class CsvError(Exception):
    """The file is not what it should be.

    Args:
        message: Why.
        line: Where, the first being 1.
    """

    def __init__(self, message: str, line: int) -> None:
        super().__init__(message, line)
        self.message = message
        self.line = line


def decoded(content: bytes) -> str:
    """The text of a file.

    Raises:
        CsvError: It is not UTF-8.
    """
    try:
        return content.decode("utf-8-sig")
    except UnicodeDecodeError as error:
        raise CsvError("This is not UTF-8", content.count(b"\n", 0, error.start) + 1) from None


def lines(text: str, longest: int = MAX_LINE) -> Lines:
    """The lines without empty ones and comments (#).

    Raises:
        CsvError: There are too many, or one is longer than `longest` characters.
    """
    start, number = 0, 0
    while start < len(text):
        end = text.find("\n", start)
        end = len(text) if end < 0 else end
        number += 1
        if number > MAX_LINES:
            raise CsvError(f"The file may have {MAX_LINES} lines", number)
        if end - start > longest:
            raise CsvError(f"A line may have {longest} characters", number)
        line = text[start:end].strip()
        if line and not line.startswith("#"):
            yield number, line
        start = end + 1


def separator(head: str) -> str:
    """Return the separator between the cells of this header."""
    return next((each for each in ("\t", ";", ",") if each in head), ",")


def title_and_unit(name: str) -> tuple[str, str]:
    """The two parts of a column's name such as `distance [m]` or `distance (m)`; a unit that is not there is empty."""
    title, _, unit = name.replace('"', "").replace("(", "[").replace(")", "]").partition("[")
    return title.strip(), unit.strip().removesuffix("]").strip()


def numbers(
    rows: Lines, between: str, columns: int, *, wanted: Mapping[int, str] | None = None, empty: float | None = None
) -> Iterator[tuple[int, list[float]]]:
    """The number of each line and its values; between semicolons with decimal commas too.

    Args:
        rows: Behind the header.
        between: The separator.
        columns: How many there are.
        wanted: Those to read, by their place, and what an error calls them; None is all.
        empty: The value of an empty cell; None where there may be none.

    Raises:
        CsvError: A line has other cells than that many, or a wanted one is no number.
    """
    wanted = dict.fromkeys(range(columns), "") if wanted is None else wanted
    for number, line in rows:
        cells = line.split(between)
        if len(cells) != columns:
            raise CsvError(f"The header has {columns} columns and this line {len(cells)}", number)
        values = []
        for index, name in wanted.items():
            cell = cells[index].replace(",", ".").strip() if between == ";" else cells[index].strip()
            try:
                values.append(float(cell) if cell or empty is None else empty)
            except ValueError:
                raise CsvError(
                    f"A value{name and f' of column {index + 1}, {name},'} is not a number", number
                ) from None
            if MAX_NUMBER < abs(values[-1]) < math.inf:
                raise CsvError(f"A value is beyond {MAX_NUMBER:g}", number)
        yield number, values
