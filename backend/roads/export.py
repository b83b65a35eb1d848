"""A stored road as CSV, which is read back as the same road. Runs in a worker: no web here."""

import re

import numpy as np

from sim_core.arrays import FloatArray
from sim_core.scenario.measured import ID_PATTERN, SPACING, MeasuredRoad

HIGHEST = 1000.0  # of a stored road [m]
FIRST_LINE = "# Ridelab road {id}: a height every 10 mm, from x = 0\n"
_EXPORTED = re.compile(rf"\ufeff?# Ridelab road ({ID_PATTERN.strip('^$')}):")


def as_csv(road: MeasuredRoad) -> bytes:
    """Return distances and heights [m] behind a comment with the road's id."""
    lines = [f"{index * SPACING:.2f},{height:.6f}\n" for index, height in enumerate(road.heights())]
    return "".join([FIRST_LINE.format(id=road.id), "distance [m],height [m]\n", *lines]).encode()


def exported_id(text: str) -> str | None:
    """Return the id of the road in a file that `as_csv` has written; None for any other file."""
    match = _EXPORTED.match(text)
    return match and match[1]


def unchanged(road_id: str, distance: FloatArray, heights: FloatArray) -> MeasuredRoad | None:
    """Return the road of that id where these are its distances and heights (samples,) [m]; None where they are not."""
    places = np.arange(len(heights)) * SPACING
    if np.abs(distance - places).max() > SPACING / 10 or np.abs(heights).max() > HIGHEST:
        return None
    road = MeasuredRoad.of(heights)
    return road if road.id == road_id else None
