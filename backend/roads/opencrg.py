"""A road in ASAM's OpenCRG 1.1, text or binary: two wheel tracks of its grid, and a stored road as such a file.

Runs in a worker: no web here. docs/explanation/road.md says what is read and what is not.
"""

from collections.abc import Sequence
from dataclasses import replace
from pathlib import Path

import numpy as np

from backend.roads import export
from backend.roads.crg_header import BINARY, MAX_LINE, MAX_LINES, MAX_NUMBER, TEXT, Header, places_of, read_header
from backend.roads.survey import Survey, check_heights, exported_survey, survey_of
from sim_core.arrays import FloatArray
from sim_core.scenario.measured import SPACING, MeasuredRoad
from sim_core.tables.errors import TableError
from sim_core.tables.roads import MAX_LENGTH, MIN_LENGTH

TRACK = 0.75  # of a wheel beside the reference line, where none is asked for [m]
MAX_BEND = 0.1  # share by which a wheel's path on a bend may differ from the reference line's
SAID_BEND = 0.01  # and beyond which it is said
RECORD = 80  # characters or bytes of a record of values
HEAD = """$CT
{first}
$
$ROAD_CRG
REFERENCE_LINE_START_U   = 0.0
REFERENCE_LINE_END_U     = {end}
REFERENCE_LINE_INCREMENT = {increment}
LONG_SECTION_V_RIGHT     = -1.5
LONG_SECTION_V_LEFT      = 1.5
LONG_SECTION_V_INCREMENT = 3.0
$
$ROAD_CRG_MODS
$
$KD_DEFINITION
#:{format}
U:reference line u,m,0,{increment}
D:long section 1,m
D:long section 2,m
$
{dollars}
"""  # no modifier: the default ones would move it
_DIGITS = np.zeros(256, dtype=bool)
_DIGITS[list(b"0123456789+-.eEdD ")] = True  # all else in a value's place says that it is missing


def read(sent: bytes | Path, left: float | None = None, right: float | None = None) -> Survey:
    """Return the road under two wheels, which run beside the reference line at v = `left` and v = `right` [m].

    Raises:
        TableError: There is none, or something in it is not supported; `line` is where, None in a binary part.
    """
    content = sent if isinstance(sent, bytes) else sent.read_bytes()
    header = read_header(content)
    places = places_of(header)
    wheels = _wheels(header, np.sort(list(places.values())), left, right)
    table = _text_values(header, content) if header.data_format in TEXT else _binary_values(header, content)
    begin = header.values.get("reference_line_start_u", 0.0)
    distance: FloatArray = begin + header.increment * np.arange(len(table), dtype=np.float64)
    length = distance[-1] - distance[0]
    if not MIN_LENGTH <= length <= MAX_LENGTH + 1e-6:
        raise TableError(f"A road is from {MIN_LENGTH:g} to {MAX_LENGTH:g} m long, this one {length:g} m", None)
    with np.errstate(all="ignore"):  # what is no number is refused
        _check_bends(header, table, wheels)
        tracks = [_across(header, table, places, wheel) + _reference(header, table, wheel) for wheel in wheels]
    check_heights(tracks, [None] * len(table))
    if header.road_id is not None:
        return exported_survey(header.road_id, distance, tracks)
    survey = survey_of(distance, tracks)
    return replace(survey, warnings=[*header.notes, *survey.warnings])


def _wheels(header: Header, v: FloatArray, left: float | None, right: float | None) -> tuple[float, float]:
    """Return where the two wheels run, v [m]."""
    wheels = (min(TRACK, float(v[-1])) if left is None else left, max(-TRACK, float(v[0])) if right is None else right)
    if not v[0] - 1e-9 <= wheels[1] < wheels[0] <= v[-1] + 1e-9:
        span = f"from {v[0]:g} m right to {v[-1]:g} m left"
        raise TableError(f"The wheels' places, right below left, are within the road: v {span}", None)
    header.notes.append(f"Wheels run {wheels[0]:g} m left of the reference line and {-wheels[1]:g} m right of it")
    return wheels


def _text_values(header: Header, content: bytes) -> FloatArray:
    """Return the values (rows, channels); a row begins a line, and a line has at most RECORD characters."""
    width = TEXT[header.data_format]
    row = header.channels * width
    lengths = [min(RECORD, row - begin) for begin in range(0, row, RECORD)]
    pieces: list[bytes] = []
    number, start = header.line, header.begin
    while start < len(content):
        end = content.find(b"\n", start)
        end = len(content) if end < 0 else end
        number += 1
        expected = lengths[len(pieces) % len(lengths)]
        if end - start > MAX_LINE:
            raise TableError(f"A line may have {MAX_LINE} characters", number)
        line = content[start:end].rstrip()
        start = end + 1
        if not line:
            if number - header.line > len(pieces) + MAX_LINES:
                raise TableError(f"There may be {MAX_LINES} empty lines", number)
            continue
        if not expected - width < len(line) <= expected:
            raise TableError(f"This line has {expected // width} values of {width} characters", number)
        pieces.append(line.ljust(expected))
        if len(pieces) > MAX_LINES * len(lengths):
            raise TableError(f"A road may have {MAX_LINES} cross-sections", number)
    if not pieces or len(pieces) % len(lengths):
        raise TableError("The file ends within a cross-section", number)
    plain = np.frombuffer(bytearray(b"".join(pieces)), dtype=np.uint8).reshape(-1, width)
    is_number = _DIGITS[plain].all(axis=1)
    cells = plain.view(f"S{width}").ravel()
    values = np.where(cells == b"**unused**", 0.0, np.nan)
    plain[(plain | 32) == ord("d")] = ord("e")  # Fortran's exponent
    try:
        values[is_number] = cells[is_number].astype(np.float64)
    except ValueError:
        index = next(index for index in np.flatnonzero(is_number) if not _is_number(cells[index]))
        said = f"A value of cross-section {index // header.channels + 1} is not a number"
        raise TableError(said, None) from None
    return _complete(header, values.reshape(-1, header.channels))


def _is_number(cell: bytes) -> bool:
    try:
        float(cell)
    except ValueError:
        return False
    return True


def _binary_values(header: Header, content: bytes) -> FloatArray:
    """Return the values (rows, channels): one after the other, the last record filled with NaN."""
    kind = np.dtype(BINARY[header.data_format])
    rows = (len(content) - header.begin) // (kind.itemsize * header.channels)
    values = np.frombuffer(content, kind, rows * header.channels, header.begin).reshape(-1, header.channels)
    size = np.abs(values[values != 0])
    if np.isinf(size).any() or np.nanmean(np.append((size > MAX_NUMBER) | (size < 1e-20), False)) > 0.01:
        whole = (len(content) - header.begin) % RECORD == 0
        why = (
            "are they big-endian, as OpenCRG's binary ones are?"
            if whole
            else f"they are no whole records of {RECORD} bytes: line ends were changed, or the file is cut off"
        )
        raise TableError(f"Values are none of a road; {why}")
    return _complete(header, values)


def _complete(header: Header, values: FloatArray) -> FloatArray:
    """Return the cross-sections that the header announces; without that, up to the last one with a value."""
    end = header.values.get("reference_line_end_u")
    if end is None:
        rows = int(np.flatnonzero(~np.isnan(values).all(axis=1)).max(initial=-1)) + 1
    else:
        begin = header.values.get("reference_line_start_u", 0.0)
        rows = int((end - begin) / header.values["reference_line_increment"] + 0.5) + 1
    if rows > len(values):
        raise TableError(f"The file is cut off: {rows} cross-sections are announced, {len(values)} are there", None)
    if rows < 2:
        raise TableError("A road has two cross-sections at least; the end is behind the start", None)
    if rows > MAX_LINES:
        raise TableError(f"A road may have {MAX_LINES} cross-sections", None)
    return values[:rows]


def _across(header: Header, table: FloatArray, places: dict[int, float], wheel: float) -> FloatArray:
    """Heights of the grid (rows,) [m] under a wheel at v [m], straight between the two sections beside it."""
    channels = np.array(sorted(places, key=places.__getitem__))
    v = np.array([places[channel] for channel in channels])
    second = int(np.clip(np.searchsorted(v, wheel), 1, len(v) - 1))
    low, high = (table[:, channels[index]].astype(np.float64) for index in (second - 1, second))
    height: FloatArray = low + (wheel - v[second - 1]) / (v[second] - v[second - 1]) * (high - low)
    gaps = np.flatnonzero(np.isnan(height))
    for row in gaps:  # as ASAM's reader: at the border the last height goes on
        heights = table[row, channels].astype(np.float64)
        there = ~np.isnan(heights)
        if not there.any():
            raise TableError(f"Cross-section {row + 1} has no height at all", None)
        height[row] = np.interp(wheel, v[there], heights[there])
    if len(gaps):
        header.notes.append(f"At v = {wheel:g} m {len(gaps)} heights are missing: those beside them are taken")
    height *= header.scale("z_grid")
    return height


def _reference(header: Header, table: FloatArray, wheel: float) -> FloatArray:
    """Return what slope and banking of the reference line add to the heights (rows,) [m] at v [m]."""
    columns = {name: table[:, channel].astype(np.float64) for name, channel in header.reference.items()}
    if any(np.isnan(column[1:]).any() for column in columns.values()):
        raise TableError("A value of the reference line is missing", None)
    slope = columns.get("slope", np.full(len(table), header.values.get("reference_line_start_s", 0.0)))
    climb = np.cumsum(np.append(0.0, slope[1:])) * header.increment * header.scale("slope")
    banking = columns.get("banking", header.values.get("reference_line_start_b", 0.0))
    return np.asarray(climb + header.scale("banking") * np.nan_to_num(banking) * wheel, dtype=np.float64)


def _check_bends(header: Header, table: FloatArray, wheels: Sequence[float]) -> None:
    """Say that a wheel's path is longer or shorter than the reference line; refuse where it is much so."""
    if "phi" not in header.reference:
        return
    heading = np.unwrap(table[1:, header.reference["phi"]].astype(np.float64)) * header.scale("curvature")
    apart = max(1, min(round(1 / header.increment), len(heading) - 1))  # over a metre: headings are coarse
    curvature = (heading[apart:] - heading[:-apart]) / (apart * header.increment)
    bend = float(np.abs(curvature).max(initial=0.0)) * max(map(abs, wheels))
    if not bend <= MAX_BEND:
        raise TableError(f"The reference line bends by more than {MAX_BEND:.0%} of a wheel's path", None)
    if bend > SAID_BEND:
        header.notes.append(
            f"Distance is the reference line's: on its bends a wheel's path differs by up to {bend:.1%}"
        )


def as_binary(road: MeasuredRoad) -> bytes:
    """Return every height of the road across 3 m; sent again, it is the same road.

    Single precision keeps each micrometre below 16 m; a road that reaches higher is written in double precision.
    """
    heights = road.heights()
    data_format = "KRBI" if float(np.abs(heights).max()) < 16 else "KDBI"
    kind = np.dtype(BINARY[data_format])
    values = np.repeat(heights, 2).astype(kind).tobytes()
    missing = np.full(-len(values) % RECORD // kind.itemsize, np.nan, dtype=kind)
    return _head(road, data_format) + values + missing.tobytes()


def as_text(road: MeasuredRoad) -> bytes:
    """Return the same as text, to a micrometre."""
    heights = road.heights()
    data_format = "LRFI" if float(np.abs(heights).max()) < 99 else "LDFI"
    width = TEXT[data_format]
    return _head(road, data_format) + "".join(f"{h:{width}.6f}{h:{width}.6f}\n" for h in heights).encode()


def _head(road: MeasuredRoad, data_format: str) -> bytes:
    return HEAD.format(
        first=export.FIRST_LINE.format(id=road.id).strip(),
        end=f"{road.length:.2f}",
        increment=SPACING,
        format=data_format,
        dollars="$" * 72,
    ).encode()
