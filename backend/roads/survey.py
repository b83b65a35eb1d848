"""A surveyed profile: read from a table, checked, converted to a road. Runs in a worker: no web here."""

from collections.abc import Mapping, Sequence
from dataclasses import asdict, dataclass, field, replace
from io import BytesIO
from pathlib import Path
from typing import Any

import numpy as np

from backend.json_types import JsonObject
from backend.roads import export
from sim_core.arrays import FloatArray
from sim_core.road.iri import iri
from sim_core.road.iso8608 import classified
from sim_core.road.survey import CONTACT, DetectedBump, bumps_in, surveyed
from sim_core.scenario.measured import SPACING, MeasuredRoad
from sim_core.tables.errors import TableError
from sim_core.tables.table import read_table
from sim_core.tables.titles import MEANINGS, ROAD

MAX_GAP = 5.0  # between two heights [m]
WIDE_GAP = 0.25  # beyond which a warning says what is missing [m]
MAX_HEIGHT = 1e5  # beyond which it is none [m]
HILLY = 1.0  # heights beyond this, without the slope, may be in another unit [m]


@dataclass(frozen=True, slots=True, kw_only=True)
class Survey:
    """The result of reading a file: the road, its bumps, the analysis of the heights as they came, and warnings."""

    road: MeasuredRoad
    bumps: list[DetectedBump]
    analysis: JsonObject
    warnings: list[str] = field(default_factory=list)


def read(content: bytes | Path, table: Mapping[str, Any] | None = None) -> Survey:
    """Return the road of a table, with corrections as of `sim_core.read_table`.

    Raises:
        TableError: It is none; an UnsureTableError where it has to be asked about.
    """
    with content.open("rb") if isinstance(content, Path) else BytesIO(content) as file:
        exported = export.exported_id(file.read(200).decode(errors="replace"))
    found = read_table(content, ROAD, table if exported is None else {"clock": {"spacing": SPACING}})
    distance, *tracks = (found.signals[key] for key in MEANINGS[ROAD] if key in found.signals)
    check_heights(tracks, [None] * len(distance))
    _check_steps(distance)
    survey = survey_of(distance, tracks) if exported is None else exported_survey(exported, distance, tracks)
    return replace(survey, warnings=[*found.notes, *survey.warnings])


def _check_steps(distance: FloatArray) -> None:
    """Raise a TableError where heights are too far apart."""
    if (widest := float(np.median(np.diff(distance)))) > MAX_GAP:
        raise TableError(f"Heights are {widest:.4g} m apart, and may be {MAX_GAP:g} m; is the unit right?")


def check_heights(tracks: Sequence[FloatArray], numbers: Sequence[int | None]) -> None:
    """Raises a TableError where a height is beyond what a road can have."""
    beyond = np.flatnonzero(np.abs(tracks).max(axis=0) > MAX_HEIGHT)
    if len(beyond):
        raise TableError(f"A height of more than {MAX_HEIGHT / 1000:g} km; is the unit right?", numbers[beyond[0]])


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
        raise TableError("Heights differ by kilometres; is the unit right?", 1)
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
