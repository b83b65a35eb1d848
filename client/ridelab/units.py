"""Units as people write them: what a number with a unit is in the unit that the service takes."""

import json
import math
import re
from collections.abc import Mapping
from pathlib import Path

_TABLE = json.loads(Path(__file__).with_name("units.gen.json").read_text(encoding="utf-8"))  # sim_core/units.py
UNITS: Mapping[str, Mapping[str, float]] = _TABLE["units"]
ALIASES: Mapping[str, str] = _TABLE["aliases"]
# Stands in a unit's place where a field is true or false.
SWITCH = "on/off"
_SWITCH_WORDS = {
    "true": True,
    "on": True,
    "yes": True,
    "1": True,
    "false": False,
    "off": False,
    "no": False,
    "0": False,
}
_NUMBER = re.compile(r"[-+]?(?:\d+\.?\d*|\.\d+)(?:e[-+]?\d+)?", re.IGNORECASE)
_DIGITS = 12  # 7 cm are 0.07 m, not 0.07000000000000001
_RAISED = str.maketrans("⁰¹²³⁴⁵⁶⁷⁸⁹⁻μ", "0123456789-µ")


def quantity(text: str, unit: str) -> float:
    """Return what a number, with or without a unit behind it, is in `unit`.

    Raises:
        ValueError: It is no number, or its unit measures something else; the message names the units it takes.
    """
    start = _NUMBER.match(text)
    if start is None:
        raise ValueError(f"{text} is not a number")
    number, written = float(start[0]), text[start.end() :].strip()
    if not math.isfinite(number):
        raise ValueError(f"{text} is not a finite number")
    if not written:
        return number
    units = _of_same_quantity(unit)
    by_key = {_key(name): name for name in units}
    name = by_key.get(_key({_key(alias): full for alias, full in ALIASES.items()}.get(_key(written), written)))
    if name is None:
        others = " or".join(", ".join(each for each in units if each != "1").rsplit(",", 1))
        raise ValueError(f"{text} is not understood: it takes {others or 'a number without a unit'}")
    return float(f"{number * units[name] / units[unit]:.{_DIGITS}g}")


def switch(text: str) -> bool:
    """Return what a text says of a field that is true or false.

    Raises:
        ValueError: It says neither; the message names what it takes.
    """
    value = _SWITCH_WORDS.get(text.strip().lower())
    if value is None:
        raise ValueError(f"{text} is not understood: it takes true or false, on or off, yes or no, 1 or 0")
    return value


def unit_within(number: str, unit: str, low: float, high: float) -> str | None:
    """Return the unit of the same quantity in which a number lies between two values given in `unit`.

    Of several the one that makes it greatest; None if there is none.
    """
    values = {quantity(f"{number}{name}", unit): name for name in _of_same_quantity(unit) if name != "1"}
    return values.get(max((value for value in values if low <= value <= high), default=math.nan))


def starts_as_number(text: str) -> bool:
    """Check whether it begins with a number, whatever stands behind it."""
    return _NUMBER.match(text) is not None


def is_number(text: str) -> bool:
    """Check whether it is a number and nothing else, without a unit."""
    return _NUMBER.fullmatch(text) is not None


def _of_same_quantity(unit: str) -> Mapping[str, float]:
    """Return every unit of what this one measures; this one alone where the table does not have it."""
    return next((units for units in UNITS.values() if unit in units), {unit: 1.0})


def _key(unit: str) -> str:
    """`kg·m²`, `kg*m^2` and `KG m2` are one."""
    return re.sub(r"[·⋅*^\s]", "", unit.translate(_RAISED)).lower()
