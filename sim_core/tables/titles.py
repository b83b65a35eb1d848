"""What a column's title says: the column's name, its unit, and what it means in a road or a drive."""

import re
import tomllib
from collections.abc import Mapping, Sequence
from pathlib import Path

from sim_core.catalogue import SIGNALS
from sim_core.units import UNITS, factor

ROAD, DRIVE = "road", "drive"
KINDS = (ROAD, DRIVE)
# Kind -> meaning -> its SI unit.
MEANINGS: Mapping[str, Mapping[str, str]] = {
    ROAD: dict.fromkeys(("distance", "height", "left", "right"), "m"),
    DRIVE: {key: entry.unit for key, entry in SIGNALS.items()},
}
# Seconds of what stands in place of a unit of time counted from 1970 on, by the magnitude of its values.
EPOCHS = ("unix", "epoch", "posix", "utc", "gmt")

_NAMES: Mapping[str, Mapping[str, Mapping[str, Sequence[str]]]] = tomllib.loads(
    Path(__file__).with_name("names.toml").read_text(encoding="utf-8")
)
_IN_BRACKETS = re.compile(r"^(.*?)\s*[\[({<]\s*([^\[\](){}<>]*?)\s*[\])}>]\s*$", re.DOTALL)
_BEHIND_A_WORD = re.compile(r"^(.*?)(?:\s*/\s+|\s+in\s+|,\s+|\s+|_|-)([^\d\s]\S*)$", re.IGNORECASE)
_CAMEL = re.compile(r"(?<=[a-z])(?=[A-Z])|(?<=[A-Za-z])(?=\d)|(?<=\d)(?=[A-Za-z])")

# Units that only tables have, each as a number of another one.
_OTHER_UNITS = {
    **{"dm": "10 cm", "mi": "1609.344 m", "ftus": "0.3048006096 m", "mil": "25.4 µm", "thou": "25.4 µm", "h": "60 min"},
    **{"d": "1440 min", "ms-1": "1 m/s", "mg": "0.001 g", "cm/s2": "0.01 m/s^2", "cm/s^2": "0.01 m/s^2"},
}
_PLAIN = str.maketrans("⁻¹²", "-12", "·⋅ ")
_NUMBER_OF_UNITS = re.compile(r"([\d.]+(?:e-?\d+)?)\s*[x*×·]?\s*([^\d\s].*)", re.IGNORECASE)


def size_of(written: str, unit: str) -> float | None:
    """Return how many SI units one unit of a table is: 1e-5 for `0.01 mm` in `m`; None where it measures otherwise."""
    other = _OTHER_UNITS.get(written.lower().translate(_PLAIN), written)
    several = _NUMBER_OF_UNITS.fullmatch(other)
    number, name = several.groups() if several else ("1", other)
    try:
        return float(number) * factor(name, unit) or None
    except ValueError:
        return None


def is_unit(written: str) -> bool:
    """Check whether that is how a unit is written, of whatever quantity."""
    known = any(size_of(written, unit) for units in UNITS.values() for unit in list(units)[:1])
    return known or not set(EPOCHS).isdisjoint(written.lower().split())


def unit_in(title: str, unit: str) -> tuple[str, str]:
    """Return the name in a title and the unit that it says, as it is written: in brackets, or behind the name.

    Args:
        title: Such as `distance [m]`, `distance (feet)`, `distance_mm`, `Weg in m` or `speed_km_h`.
        unit: The SI unit of what the column may be; behind a name only its like is a unit.
    """
    if match := _IN_BRACKETS.match(title):
        return match[1], match[2]
    parts = title.rsplit("_", 2)
    if len(parts) == 3 and parts[0] and size_of("/".join(parts[1:]), unit):
        return parts[0], "/".join(parts[1:])
    match = _BEHIND_A_WORD.match(title)
    return (match[1], match[2]) if match and match[1] and size_of(match[2], unit) else (title, "")


def words(name: str) -> str:
    """Return a name's words in small letters, a blank between two: `GForceVert`, `g_force-vert` and `G Force Vert`."""
    return " ".join(re.split(r"[\W_]+", _CAMEL.sub(" ", name).lower())).strip()


def meanings(kind: str, title: str) -> tuple[str | None, bool]:
    """Return what a column of that title means in such a table, or None, and whether that is sure."""
    likely: str | None = None
    for meaning, unit in MEANINGS[kind].items():
        name = words(unit_in(title, unit)[0])
        known = _NAMES[kind].get(meaning, {})
        if name in _own_names(kind, meaning) or name in known.get("sure", ()):
            return meaning, True
        there = set(name.split())
        is_likely = any(set(each.split()) <= there for each in known.get("likely", ()))
        if likely is None and is_likely and there.isdisjoint(known.get("never", ())):
            likely = meaning
    return likely, False


def _own_names(kind: str, meaning: str) -> tuple[str, ...]:
    label = (words(SIGNALS[meaning].label),) if kind == DRIVE else ()
    return (words(meaning), *label)
