"""A surveyed profile: read from CSV line by line, checked, converted to a road. Runs in a worker: no web here."""

import math
from collections.abc import Sequence
from dataclasses import asdict, dataclass, field, replace

import numpy as np

from backend import csv_lines
from backend.csv_lines import CsvError
from backend.json_types import JsonObject
from backend.roads import export
from sim_core.arrays import FloatArray
from sim_core.road.iri import iri
from sim_core.road.iso8608 import classified
from sim_core.road.survey import CONTACT, DetectedBump, bumps_in, surveyed
from sim_core.scenario.measured import SPACING, MeasuredRoad
from sim_core.units import UNITS, factor

MAX_LENGTH, MIN_LENGTH = 3000.0, 5.0  # of a road [m]
MAX_GAP = 5.0  # between two heights [m]
WIDE_GAP = 0.25  # beyond which a warning says what is missing [m]
MAX_HEIGHT = 1e5  # beyond which it is none [m]
HILLY = 1.0  # heights beyond this, without the slope, may be in another unit [m]

DISTANCE = ("distance", "position", "station", "x", "s")
HEIGHT = ("height", "elevation", "z", "profile")
LEFT, RIGHT = ("left", "left_height", "left height", "z_left"), ("right", "right_height", "right height", "z_right")
FORM = (
    "The header names the columns with their units: distance [m], height [mm], or distance [m], left [mm], right [mm]"
)


class SurveyError(Exception):
    """The file is not a road.

    Args:
        message: Why.
        line: Where, the first being 1; None where it is not of one line.
    """

    def __init__(self, message: str, line: int | None) -> None:
        super().__init__(message, line)
        self.message = message
        self.line = line


@dataclass(frozen=True, slots=True, kw_only=True)
class Survey:
    """The result of reading a file: the road, its bumps, the analysis of the heights as they came, and warnings."""

    road: MeasuredRoad
    bumps: list[DetectedBump]
    analysis: JsonObject
    warnings: list[str] = field(default_factory=list)


def read(content: bytes) -> Survey:
    """Return the road of a CSV file.

    Raises:
        CsvError: It is none; `line` is where.
    """
    text = csv_lines.decoded(content)
    lines = csv_lines.lines(text)
    number, head = next(lines, (1, ""))
    separator = csv_lines.separator(head)
    exported = export.exported_id(text)
    scales, order = _columns([name.strip() for name in head.split(separator)], number, alone=exported is not None)
    numbers, table = _table(lines, separator, len(scales))
    columns = [table[:, index] * scales[index] for index in order]
    if len(columns) == 1:
        columns.insert(0, SPACING * np.arange(len(table), dtype=float))
    distance, *tracks = columns
    _check_distances(distance, numbers)
    check_heights(tracks, numbers)
    return survey_of(distance, tracks) if exported is None else exported_survey(exported, distance, tracks)


def _columns(names: Sequence[str], line: int, *, alone: bool) -> tuple[list[float], list[int]]:
    """Each column's unit in metres, and the columns of distance and height, or left and right height.

    `alone` allows a height without a distance.
    """
    titles, scales = [], []
    for name in names:
        title, unit = csv_lines.title_and_unit(name)
        try:
            scales.append(factor(unit, "m"))
        except ValueError:
            wrong = f'the unit "{unit}" of "{title}" is not understood' if unit else f'"{title}" has no unit'
            raise CsvError(f"{FORM}; {wrong}: units are {', '.join(UNITS['length'])}", line) from None
        titles.append(title.lower())
    for wanted in ((DISTANCE, HEIGHT), (DISTANCE, LEFT, RIGHT), *([(HEIGHT,)] * alone)):
        matches = [[index for index, title in enumerate(titles) if title in each] for each in wanted]
        if len(titles) == len(wanted) and all(len(each) == 1 for each in matches):
            return scales, [each[0] for each in matches]
    raise CsvError(FORM, line)


def _table(lines: csv_lines.Lines, separator: str, columns: int) -> tuple[list[int], FloatArray]:
    """Line numbers and values (lines, columns)."""
    numbers, rows = [], []
    for number, row in csv_lines.numbers(lines, separator, columns):
        if not all(map(math.isfinite, row)):
            raise CsvError("A value is not a finite number", number)
        numbers.append(number)
        rows.append(row)
    if len(rows) < 2:
        raise CsvError("A road has two heights at least", numbers[-1] if numbers else 1)
    return numbers, np.array(rows)


def _check_distances(distance: FloatArray, numbers: Sequence[int]) -> None:
    """Raises a CsvError where heights do not follow each other, or are too far apart, or too few."""
    steps = np.diff(distance)
    back, far = np.flatnonzero(steps <= 0), np.flatnonzero(steps > MAX_GAP)
    if len(back):
        what = "goes back" if steps[back[0]] < 0 else "stands still"
        raise CsvError(f"The distance {what}: every line is further on than the one before", numbers[back[0] + 1])
    if len(far):
        raise CsvError(f"A gap of more than {MAX_GAP:g} m since the line before", numbers[far[0] + 1])
    beyond = np.flatnonzero(distance - distance[0] > MAX_LENGTH + 1e-6)
    if len(beyond):
        raise CsvError(f"A road is {MAX_LENGTH:g} m long at most", numbers[beyond[0]])
    if distance[-1] - distance[0] < MIN_LENGTH:
        raise CsvError(f"A road is {MIN_LENGTH:g} m long at least; is the unit right?", numbers[-1])


def check_heights(tracks: Sequence[FloatArray], numbers: Sequence[int | None]) -> None:
    """Raises a SurveyError where a height is beyond what a road can have."""
    beyond = np.flatnonzero(np.abs(tracks).max(axis=0) > MAX_HEIGHT)
    if len(beyond):
        raise SurveyError(f"A height of more than {MAX_HEIGHT / 1000:g} km; is the unit right?", numbers[beyond[0]])


def exported_survey(road_id: str, distance: FloatArray, tracks: Sequence[FloatArray]) -> Survey:
    """Return the road of a file that says it is an export: the same one again, if nothing in it was changed."""
    alike = all(np.array_equal(track, tracks[0]) for track in tracks[1:])
    road = export.unchanged(road_id, distance, tracks[0]) if alike else None
    if road is None:
        survey = survey_of(distance, tracks)
        changed = "This exported road was changed: it is read as a new measurement"
        return replace(survey, warnings=[changed, *survey.warnings])
    said = ["This is an exported road: its heights are taken as they are"]
    heights = road.heights()
    return Survey(road=road, bumps=bumps_in(heights), analysis=analysis_of(distance, [heights]), warnings=said)


def analysis_of(distance: FloatArray, tracks: Sequence[FloatArray]) -> JsonObject:
    """IRI and ISO 8608 fit of heights as they came, in the form of `RoadHead`; as far apart as most of them are."""
    length = float(distance[-1] - distance[0])
    steps = max(1, round(length / max(SPACING, float(np.median(np.diff(distance))))))
    spacing = length / steps
    x = distance[0] + spacing * np.arange(steps + 1)
    even = [np.interp(x, distance, track) for track in tracks]
    indices = [iri(track, spacing) for track in even]
    fit = classified(even, spacing)
    return {
        "iri": {"tracks": indices, "mean": float(np.mean(indices))},
        "iso_class": fit and fit.iso_class,
        "roughness": fit and asdict(fit.roughness),
        "waviness": fit and asdict(fit.waviness),
        "spectrum": fit and {"frequency": fit.frequency.tolist(), "density": fit.density.tolist()},
    }


def survey_of(distance: FloatArray, tracks: Sequence[FloatArray]) -> Survey:
    """Return the road of one track or two (n,) [m], and what was done to them."""
    profile = surveyed(distance, np.mean(tracks, axis=0))
    most = float(np.abs(profile.heights).max())
    if not most <= export.HIGHEST:  # nor NaN
        raise SurveyError("Heights differ by kilometres; is the unit right?", 1)
    road, widest = MeasuredRoad.of(profile.heights), float(np.diff(distance).max())
    warnings = ["The mean of left and right track is taken"] if len(tracks) == 2 else []
    if distance[0]:
        warnings.append(f"The first distance, {distance[0]:g} m, is x = 0")
    warnings += [
        f"{len(distance)} heights became {road.samples}, one every {1000 * SPACING:g} mm, straight lines in between",
        f"A straight line was taken off: {profile.offset:.4g} m at the start, {100 * profile.slope:.3g} % slope",
        f"Heights were averaged over {1000 * CONTACT:g} mm, as a tyre's contact does",
    ]
    if widest > WIDE_GAP:
        warnings.append(f"Heights are up to {widest:.3g} m apart: waves shorter than {2 * widest:.3g} m are missing")
    if most > HILLY:
        warnings.append(f"Heights reach {most:.3g} m beside the straight line; is the unit right?")
    bumps = bumps_in(profile.heights)
    if bumps:
        warnings.append("IRI, roughness and waviness count its bumps too")
    return Survey(road=road, bumps=bumps, analysis=analysis_of(distance, tracks), warnings=warnings)
