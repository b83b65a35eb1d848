"""The header of an OpenCRG file: road parameters, modifiers and channels, up to the first value."""

import math
import re
from dataclasses import dataclass, field

import numpy as np

from backend.roads import export
from backend.roads.survey import MAX_GAP
from sim_core.tables.errors import TableError

MAX_LINES, MAX_LINE = 350_000, 500  # cross-sections, and characters of a line
MAX_NUMBER = 1e12  # in any unit
MAX_HEADER = 20_000  # lines
MIN_GAP = 1e-4  # between cross-sections [m]
TEXT = {"LRFI": 10, "LDFI": 20}  # characters of a value
BINARY = {"KRBI": ">f4", "KDBI": ">f8"}
SECTION = re.compile(r"long section\s+(?:at\s+v\s*=\s*(?P<at>\S+)|(?P<number>\d+))\s*,\s*m\b", re.IGNORECASE)
REFERENCE = re.compile(r"reference line\s+(?:(phi)\s*,\s*rad|(slope)\s*,\s*m/m|(banking)\s*,\s*m/m)\b", re.IGNORECASE)
NUMBER = re.compile(r"\s*([+-]?(?:\d+\.?\d*|\.\d+)(?:[eEdD][+-]?\d+)?)")
MODIFIERS = re.compile(r"scale_(z_grid|slope|banking|length|width|curvature)|ref(line|point)_\w+|grid_nan_mode")
_SECTIONS = ("$road_crg_mods", "$road_crg_opts", "$road_crg_file", "$road_crg_mpro", "$road_crg", "$ct", "$kd_def")


@dataclass(slots=True)
class Header:
    """What stands before the values, which begin at byte `begin`, behind line `line`."""

    values: dict[str, float] = field(default_factory=dict)  # of road parameters, modifiers and options
    data_format: str = "KRBI"
    channels: int = 0
    sections: dict[int, float] = field(default_factory=dict)  # v or number of a long section by its channel
    reference: dict[str, int] = field(default_factory=dict)  # channels of the reference line
    numbered: bool = False
    road_id: str | None = None
    notes: list[str] = field(default_factory=list)
    begin: int = 0
    line: int = 0

    def scale(self, name: str) -> float:
        """Return a modifier."""
        return self.values.get(f"scale_{name}", 1.0)

    @property
    def increment(self) -> float:
        """Between two cross-sections [m]."""
        return self.values["reference_line_increment"] * self.scale("length")


def read_header(content: bytes) -> Header:
    """Return the header of a file.

    Raises:
        TableError: It is none, or something in it is not supported.
    """
    header, section, start = Header(), "", 0
    while header.line < MAX_HEADER:
        end = content.find(b"\n", start)
        header.line += 1
        if end < 0:
            raise TableError("This is no OpenCRG file: its values begin behind a line of $$$$", header.line)
        if end - start > MAX_LINE:
            raise TableError(f"A line may have {MAX_LINE} characters", header.line)
        line = content[start:end].decode("latin-1").strip()
        start = end + 1
        if line.startswith("$"):
            if not section and line.startswith("$$$$"):
                header.begin = start
                return _checked(header)
            section = "" if section else next((each for each in _SECTIONS if line.lower().startswith(each)), "other")
            if section == "$road_crg_file":
                raise TableError("It refers to other files: send one that has everything", header.line)
        elif section == "$ct":
            header.road_id = header.road_id or export.exported_id(line)
        elif section and line and not line.startswith("*"):
            _entry(header, section, line.partition("!")[0].strip())
    raise TableError(f"The header may have {MAX_HEADER} lines", header.line)


def _entry(header: Header, section: str, line: str) -> None:
    """One line of a section."""
    if section == "$kd_def":
        _define(header, line)
        return
    name, equals, text = line.partition("=")
    name = name.strip().lower()
    if not equals or section not in ("$road_crg", "$road_crg_mods", "$road_crg_opts"):
        return
    number = NUMBER.match(text)
    value = float(number[1].lower().replace("d", "e")) if number else math.nan
    if not abs(value) <= MAX_NUMBER:
        raise TableError(f"{name} is not a number", header.line)
    if section == "$road_crg_mods":
        if not MODIFIERS.fullmatch(name) or (name == "grid_nan_mode" and value != 2):
            raise TableError(f"The modifier {name} is not supported", header.line)
        if name in ("scale_length", "scale_width") and value <= 0:
            raise TableError(f"{name} is above 0", header.line)
    elif section == "$road_crg_opts" and name.startswith("border_smooth") and value:
        header.notes.append(f"The option {name} is left out: heights are taken as they are in the file")
    header.values[name] = value


def _define(header: Header, line: str) -> None:
    """One line of the data definition."""
    if line.startswith("#:"):
        header.data_format = line[2:6].upper()
        if header.data_format not in {**TEXT, **BINARY}:
            raise TableError(f"The format of values is one of {', '.join([*TEXT, *BINARY])}", header.line)
    if not line.upper().startswith("D:"):
        return
    channel, name = header.channels, line[2:].strip()
    header.channels += 1
    section = SECTION.match(name)
    if section:
        header.numbered = section["number"] is not None
        at = NUMBER.fullmatch(section["number"] or section["at"])
        if at is None:
            raise TableError("The place of a long section is not a number", header.line)
        header.sections[channel] = float(at[1].lower().replace("d", "e"))
        return
    reference = REFERENCE.match(name)
    if reference:
        header.reference[next(filter(None, reference.groups())).lower()] = channel
    elif re.match("reference line|long section", name, re.IGNORECASE):
        raise TableError(f"The channel {name} is not supported, or its unit is not", header.line)
    else:
        header.notes.append(f"The channel {name} is left out")


def _checked(header: Header) -> Header:
    increment = header.values.get("reference_line_increment", 0.0)
    if not (MIN_GAP <= increment <= MAX_GAP and MIN_GAP <= header.increment <= MAX_GAP):
        raise TableError(f"REFERENCE_LINE_INCREMENT is from {MIN_GAP:g} to {MAX_GAP:g} m", header.line)
    if len(header.sections) < 2:
        raise TableError("A grid has two long sections at least", header.line)
    return header


def places_of(header: Header) -> dict[int, float]:
    """Return where each long section is, v [m], by its channel."""
    count, numbers = len(header.sections), list(header.sections.values())
    if header.numbered:
        if sorted(numbers) != list(range(1, count + 1)):
            raise TableError("Long sections are all numbered from 1 on, or all have their place", header.line)
        right, left, step = (header.values.get(f"long_section_v_{name}") for name in ("right", "left", "increment"))
        if step is None:
            step = 0.01 if left is None or right is None else (left - right) / (count - 1)
        if right is None:  # a grid of which only the increment is known lies around its reference line
            right = -step * (count - 1) / 2 if left is None else left - step * (count - 1)
        numbers = [right + step * (number - 1) for number in numbers]
    if not min(np.diff(np.sort(numbers))) > 1e-6:
        raise TableError("Two long sections are at one place", header.line)
    return {channel: v * header.scale("width") for channel, v in zip(header.sections, numbers, strict=True)}
