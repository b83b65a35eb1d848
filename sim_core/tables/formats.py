"""Files that say themselves how they are laid out: ProVAL's ERD, Racelogic's VBO, spreadsheets.

Sources: UMTRI, "The ERD file specification"; Racelogic, "VBO file format"; ECMA-376 (xlsx).
"""

import io
import re
import zipfile
from collections.abc import Sequence
from dataclasses import replace

from sim_core.tables.errors import TableError
from sim_core.tables.layout import Layout, find_layout

_ERD_TEXT = 5  # KEYNUM of values written as text
_ERD_FIELD = 8  # characters of a short name or a unit
_VBO_UNITS = {
    "time": "hhmmss",
    "velocity": "km/h",
    "speed": "km/h",
    "height": "m",
}  # of its own channels, if nothing else is said

MAX_UNPACKED, MAX_RATIO = 64 * 2**20, 100  # of a spreadsheet [bytes], and against its packed size


def own_layout(text: str) -> Layout | None:
    """Return the layout that a file of such a format gives itself; None of any other file.

    Raises:
        TableError: It is one, but incomplete or with values that are no text.
    """
    if text.startswith("ERDFILE"):
        return _erd(text)
    return _vbo(text) if re.search(r"^\[column names\]\s*$", text[:200_000], re.MULTILINE | re.IGNORECASE) else None


def _erd(text: str) -> Layout:
    lines = text.splitlines()
    end = next((number for number, line in enumerate(lines) if line.strip() == "END"), None)
    if end is None or end < 2:
        raise TableError("This ERD file's head does not end")
    numbers = [cell.strip() for cell in lines[1].split(",")]
    try:
        count, key, step = int(numbers[0]), int(numbers[4]), float(numbers[5])
    except (ValueError, IndexError):
        raise TableError("This line of an ERD file has the numbers of channels and samples, and the step", 2) from None
    if key % 10 != _ERD_TEXT:
        raise TableError("The values of this ERD file are binary: export it as text", 2)
    named = {line[:8].strip(): line[8:] for line in lines[2:end]}
    found = find_layout("\n".join(["", *lines[end + 1 :]]), titles_line=0)
    first_row = end + found.first_row
    return replace(
        found,
        titles=_erd_fields(named, "SHORTNAM", count) or [f"Column {1 + place}" for place in range(count)],
        units=_erd_fields(named, "UNITSNAM", count) or [""] * count,
        first_row=first_row,
        step=(abs(step), named.get("XUNITS", "").strip()),
    )


def _erd_fields(named: dict[str, str], key: str, count: int) -> list[str]:
    text = named.get(key, "")
    return [text[_ERD_FIELD * place : _ERD_FIELD * (place + 1)].strip(" .") for place in range(count)] if text else []


def _vbo(text: str) -> Layout:
    sections: dict[str, list[str]] = {}
    first_row, lines = 0, sections.setdefault("", [])
    for number, line in enumerate(text.splitlines(), 1):
        if match := re.fullmatch(r"\s*\[(.+)\]\s*", line):
            lines = sections.setdefault(match[1].lower(), [])
            if match[1].lower() == "data":
                first_row = number + 1
                break
        elif line.strip():
            lines.append(line.strip())
    titles = " ".join(sections["column names"]).split()
    if not first_row or not titles:
        raise TableError("This VBO file has no columns or no data")
    found = find_layout("\n" * (first_row - 1) + "\n".join(text.splitlines()[first_row - 1 :]), " ", titles_line=0)
    units = [_VBO_UNITS.get(title.lower(), "") for title in titles]
    heads, channel_units = sections.get("header", []), sections.get("channel units", [])
    if len(heads) == len(titles):
        units = [_unit_behind(head) or unit for head, unit in zip(heads, units, strict=True)]
        titles = [head.removesuffix(_unit_behind(head)).strip() for head in heads]
    if channel_units and len(channel_units) <= len(titles):
        units = [*units[: -len(channel_units)], *channel_units]
    return replace(found, titles=titles, units=units)


def _unit_behind(head: str) -> str:
    match = re.search(r"\s(km/?h|mph|knots|m/s(?:2|\^2)?|g|m)$", head, re.IGNORECASE)
    return match[1] if match else ""


def is_spreadsheet(content: bytes) -> bool:
    """Check whether a file is an archive, as a spreadsheet is."""
    return content.startswith(b"PK\x03\x04")


def spreadsheet_text(content: bytes, sheet: str | None) -> tuple[str, Sequence[str]]:
    """Return the cells of one sheet as text with tabs in between, and the names of all sheets.

    Raises:
        TableError: It is none, is too large unpacked, or openpyxl is not installed.
    """
    try:
        from openpyxl import load_workbook
    except ImportError:
        raise TableError("To read a spreadsheet ridelab-core[xlsx] has to be installed; or save it as CSV") from None
    try:
        sizes = [(entry.file_size, entry.compress_size) for entry in zipfile.ZipFile(io.BytesIO(content)).infolist()]
        if sum(size for size, _ in sizes) > MAX_UNPACKED or any(
            size > MAX_RATIO * max(packed, 1) and size > 2**20 for size, packed in sizes
        ):
            raise TableError(
                f"This spreadsheet unpacks to more than {MAX_UNPACKED // 2**20} MB, or far beyond its size"
            )
        book = load_workbook(io.BytesIO(content), read_only=True, data_only=True, keep_links=False)
        names = sorted(book.sheetnames, key=lambda name: -(getattr(book[name], "max_row", 0) or 0))  # the longest first
        if sheet is not None and sheet not in names:
            raise TableError("There is no sheet of this name")
        page = book[sheet or names[0]]
        text = io.StringIO()
        for cells in page.iter_rows(values_only=True):
            text.write("\t".join(_cell(cell) for cell in cells) + "\n")
            if text.tell() > MAX_UNPACKED:
                raise TableError(f"This spreadsheet unpacks to more than {MAX_UNPACKED // 2**20} MB")
    except TableError:
        raise
    except Exception as error:  # noqa: BLE001 - openpyxl raises what it meets in a damaged file
        raise TableError(f"This spreadsheet cannot be opened ({type(error).__name__})") from None
    return text.getvalue(), names


def _cell(value: object) -> str:
    if value is None:
        return ""
    if isinstance(value, (int, float)):
        return repr(value)
    return " ".join(str(value).split())
