"""Fields and values as they are typed: `--set road.bump.height=0.12`, and the points of a sweep.

A number may have a unit (`12cm`). Which fields there are and which values they take the service says.
"""

import math
import re
from collections.abc import Callable, Collection, Iterable, Iterator, Mapping, Sequence
from itertools import accumulate
from pathlib import Path
from typing import Any

from ridelab import fields as scenario_fields
from ridelab.cli.names import Names
from ridelab.cli.reporting import InputError
from ridelab.cli.service import Services
from ridelab.cli.targets import document, find, parsed
from ridelab.fields import Limits, similar
from ridelab.units import SWITCH, is_number, quantity, starts_as_number, switch, unit_within

_SPAN = re.compile(r"([^:]+):([^:]+):(\d+)")
_DIGITS = 12  # 0.05:0.15:11 gives 0.06 and not 0.060000000000000005
_MOST_VALUES = 1_000_000
VEHICLE = "vehicle"  # the part of a scenario that --set takes whole
PROFILE, LENGTH, START = "road.profile", "road.length", "road.bump.start"
_WORDS = {"true": True, "false": False, "null": None}


def scenario_of(
    target: str, changes: Sequence[str] | None, services: Services, swept: Collection[str] = ()
) -> dict[str, Any]:
    """The scenario of a target with each `FIELD=VALUE` in its place; `swept` fields get their values later."""
    return changed(find(target, services).scenario, changes or [], services, swept)


def changed(
    scenario: Mapping[str, Any], changes: Sequence[str], services: Services, swept: Collection[str] = ()
) -> dict[str, Any]:
    """The scenario with each `FIELD=VALUE` in its place; `swept` fields get their values later.

    A length that nobody gave is left to the service: where the road is measured it is that road's. The one that the
    scenario has belongs to its own road, not to a measured one that is chosen here; so does the place of its bump,
    where the height is 0.
    """
    if not changes and PROFILE not in swept:
        return dict(scenario)
    whole = _merged(next(iter(services.names.presets.values())), scenario)
    pairs = [_pair(change, "--set takes FIELD=VALUE") for change in changes]
    pairs.sort(key=lambda pair: pair[0] != VEHICLE)  # its fields may be changed, wherever it stands
    values = {
        name: vehicle_of(text, services) if name == VEHICLE else _field(name, text, services.names)
        for name, text in pairs
    }
    result, named, road = with_values(whole, values), {*values, *swept}, scenario.get("road")
    has_length = isinstance(road, dict) and "length" in road and PROFILE not in named
    if not isinstance(result["road"], dict):
        return result
    if LENGTH not in named and not has_length:
        result["road"].pop("length", None)
    bump = result["road"].get("bump")
    if PROFILE in named and START not in named and isinstance(bump, dict) and bump.get("height") == 0:
        bump.pop("start", None)
    return result


def vehicle_of(target: str, services: Services) -> Any:
    """The vehicle of a file with one (a vehicle's, a scenario's, a run's), or that a service knows by name."""
    if not Path(target).is_file():
        vehicles = services.quick.vehicles()
        if target not in vehicles:
            all_of_them = f"({', '.join(vehicles)}){similar(target, vehicles)}"
            raise InputError(f"{VEHICLE}: {target} is neither a file nor a vehicle {all_of_them}")
        return vehicles[target]["vehicle"]
    content = document(Path(target).read_bytes(), target)
    if isinstance(content, dict) and isinstance(content.get("scenario"), dict):
        content = content["scenario"]
    if not isinstance(content, dict) or not isinstance(content.get(VEHICLE), dict):
        raise InputError(f"{target}: this file has no member {VEHICLE}")
    return content[VEHICLE]


def with_values(scenario: Mapping[str, Any], values: Mapping[str, Any]) -> dict[str, Any]:
    """A copy of a complete scenario with these fields changed."""
    try:
        return scenario_fields.with_values(scenario, values)
    except ValueError as error:
        raise InputError(str(error)) from None


Read = Callable[[str, str], Any]  # a text, in a unit unless it says another


def grid_of(specs: Sequence[str], units: Mapping[str, str]) -> dict[str, list[Any]]:
    """Each `FIELD=VALUES`; `units` are the fields' own."""
    return _unique(specs, "--grid", "FIELD=VALUES", _values, units)


def links_of(specs: Sequence[str]) -> dict[str, list[str]]:
    """Each `FIELD=FIELD,FIELD`."""
    pairs = (_pair(spec, "--link takes FIELD=FIELD,..") for spec in specs)
    return {name: [field.strip() for field in fields.split(",")] for name, fields in pairs}


def ranges_of(specs: Sequence[str], option: str, units: Mapping[str, str]) -> dict[str, list[float]]:
    """Each `FIELD=LOW:HIGH`; `units` are the fields' own."""
    return _unique(specs, option, "FIELD=LOW:HIGH", _range, units)


def limit_of(text: str, units: Mapping[str, str], example: str) -> tuple[str, float]:
    """The metric and the number of `METRIC=MOST`; `units` are the metrics' own."""
    name, most = _pair(text, f"--limit takes METRIC=MOST, such as {example}")
    return name, read(name, most, quantity, units)


def _unique(specs: Sequence[str], option: str, form: str, reader: Read, units: Mapping[str, str]) -> dict[str, Any]:
    values: dict[str, Any] = {}
    for name, text in (_pair(spec, f"{option} takes {form}") for spec in specs):
        if name in values:
            raise InputError(f"{name}: given twice to {option}")
        _check_name(name, units)
        values[name] = read(name, text, reader, units)
    return values


def _pair(text: str, form: str) -> tuple[str, str]:
    """A field's name and what stands behind the sign."""
    name, _, value = (part.strip() for part in text.partition("="))
    if not value:
        raise InputError(f"{form}, and {text or 'nothing'} is no such pair")
    return name, value


def _field(name: str, text: str, names: Names) -> Any:
    """Return a field's value as `--set` takes it; of a whole part, too, which is JSON."""
    units, limits = names.fields, names.limits.get(name)
    _check_name(name, [*units, *_parts(units)])
    value = read(name, text, _value, units)
    if limits is not None and is_number(text) and not limits.least <= value <= limits.most:
        raise InputError(f"{name}: {_beyond(text, units[name], limits)}")
    return value


def _beyond(text: str, unit: str, limits: Limits) -> str:
    """Return what to say of a number beyond a field's limits, and which unit it may have been meant in."""
    shown_unit = "" if unit == "1" else f" {unit}"
    meant = unit_within(text, unit, *limits.usual)
    hint = f"; perhaps {text}{meant}" if meant else ""
    return f"{text}{shown_unit} is not within {limits.least:g} to {limits.most:g}{shown_unit}{hint}"


def _parts(names: Iterable[str]) -> Iterator[str]:
    """Return what a scenario's fields are grouped in: `road`, `road.bump`."""
    parts = {part for name in names for part in accumulate(name.split(".")[:-1], "{}.{}".format)}
    return (part for part in parts if part not in names)  # weights are fields themselves


def _check_name(name: str, names: Collection[str]) -> None:
    """Refuse a field that the service does not have."""
    if name not in names:
        raise InputError(f"{name}: there is no such name{similar(name, names) or '; ridelab fields lists them'}")


def read(name: str, text: str, reader: Read, units: Mapping[str, str]) -> Any:
    """Return what the text says in that name's unit; `units` is empty where the names are not known here."""
    try:
        return reader(text, units.get(name, "1"))
    except ValueError as error:
        if units and name not in units:  # then its unit was a guess
            raise InputError(f"{name}: there is no such name{similar(name, units)}") from None
        raise InputError(f"{name}: {error}") from None


def _values(text: str, unit: str) -> list[Any]:
    """`0.05:0.15:11` (both ends, evenly), values with commas, or weights such as `[8,1,1],[2,6,1]`."""
    if text.startswith("["):
        return list(parsed(f"[{text}]"))
    if ":" not in text or unit == SWITCH:
        return _together(text.split(","), unit, _value)
    if (span := _SPAN.fullmatch(text)) is None:
        hint = "LOW:HIGH:COUNT, such as 0.05:0.15:11 for 11 values with both ends, nor values with commas between them"
        raise ValueError(f"{text} is neither {hint}")
    (low, high), count = _together([span[1], span[2]], unit, quantity), int(span[3])
    if not 2 <= count <= _MOST_VALUES:
        raise ValueError(f"LOW:HIGH:COUNT takes a count from 2 to {_MOST_VALUES}")
    steps = [float(f"{low + (high - low) * index / (count - 1):.{_DIGITS}g}") for index in range(count)]
    return [int(step) for step in steps] if all(step.is_integer() for step in steps) else steps


def _range(text: str, unit: str) -> list[Any]:
    low, sign, high = text.partition(":")
    if not sign or ":" in high:
        raise ValueError("a range is LOW:HIGH, such as 0.05:0.15 or 5cm:15cm")
    return _together([low, high], unit, _value)


def _together(texts: Sequence[str], unit: str, read: Read) -> list[Any]:
    """Values that belong together: all numbers but 0 say their unit, or none does.

    Raises:
        ValueError: A value is none, or only some say their unit: whoever writes 2:120cm does not mean 2 m.
    """
    texts = [text.strip() for text in texts]
    values = [read(text, unit) for text in texts]
    numbers = [text for text in texts if starts_as_number(text)]
    bare = [is_number(text) for text in numbers if not (is_number(text) and float(text) == 0)]  # 0 is 0 in every unit
    if len(set(bare)) > 1:
        raise ValueError(f"{' and '.join(numbers)}: give each number its unit, or none of them")
    return values


def _value(text: str, unit: str) -> Any:
    """Return a number, a list, JSON, null where a field may be without a value, or a word.

    Three weights may stand with or without brackets and commas. What a switch takes, `ridelab.units.switch` says.
    """
    if unit == SWITCH:
        return switch(text)
    if text in _WORDS:
        return _WORDS[text]
    if text.startswith(("{", "[{", "[[")):
        return document(text.encode(), "the value")
    if "," in text:
        return [_value(item.strip(), unit) for item in text.removeprefix("[").removesuffix("]").split(",")]
    if len(words := text.split()) > 1 and all(map(is_number, words)):
        return [_value(word, unit) for word in words]
    try:
        number = float(text)
    except ValueError:
        if not starts_as_number(text):  # no choice of a field begins with a number
            return text
        number = quantity(text, unit)
    if not math.isfinite(number):
        raise ValueError(f"{text} is not a finite number")
    return int(number) if number.is_integer() and abs(number) < 1e15 else number


def _merged(base: Mapping[str, Any], over: Mapping[str, Any]) -> dict[str, Any]:
    merged = dict(base)
    for key, value in over.items():
        below = merged.get(key)
        merged[key] = _merged(below, value) if isinstance(below, dict) and isinstance(value, dict) else value
    return merged
