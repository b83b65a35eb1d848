"""Fields and values as they are typed: `--set road.bump.height=0.12`, and the points of a sweep.

Only their form is read here; which fields there are and which values they take the service says.
"""

import json
import math
import re
from collections.abc import Callable, Mapping, Sequence
from pathlib import Path
from typing import Any

from ridelab.cli.reporting import InputError
from ridelab.cli.service import Services
from ridelab.cli.targets import document, find

_NUMBER = r"[-+]?(?:\d+\.?\d*|\.\d+)(?:e[-+]?\d+)?"
_SPAN = re.compile(rf"({_NUMBER}):({_NUMBER}):(\d+)", re.IGNORECASE)
_DIGITS = 12  # 0.05:0.15:11 gives 0.06 and not 0.060000000000000005
_MOST_VALUES = 1_000_000
VEHICLE = "vehicle"  # the part of a scenario that --set takes whole
_WORDS = {"true": True, "false": False, "null": None}


def scenario_of(target: str, changes: Sequence[str] | None, services: Services) -> dict[str, Any]:
    """The scenario of a target with each `FIELD=VALUE` in its place."""
    return changed(find(target, services).scenario, changes or [], services)


def changed(scenario: Mapping[str, Any], changes: Sequence[str], services: Services) -> dict[str, Any]:
    """The scenario with each `FIELD=VALUE` in its place."""
    if not changes:
        return dict(scenario)
    whole = _merged(next(iter(services.names.presets.values())), scenario)
    pairs = [_pair(change, "--set takes FIELD=VALUE", str) for change in changes]
    pairs.sort(key=lambda pair: pair[0] != VEHICLE)  # its fields may be changed, wherever it stands
    values = {
        name: vehicle_of(text, services) if name == VEHICLE else _read(name, text, _value) for name, text in pairs
    }
    return with_values(whole, values)


def vehicle_of(target: str, services: Services) -> Any:
    """The vehicle of a file with one (a vehicle's, a scenario's, a run's), or that a service knows by name."""
    if not Path(target).is_file():
        vehicles = services.at().vehicles()
        if target not in vehicles:
            raise InputError(f"{VEHICLE}: {target} is neither a file nor a vehicle ({', '.join(vehicles)})")
        return vehicles[target]["vehicle"]
    content = document(Path(target).read_bytes(), target)
    if isinstance(content, dict) and isinstance(content.get("scenario"), dict):
        content = content["scenario"]
    if not isinstance(content, dict) or not isinstance(content.get(VEHICLE), dict):
        raise InputError(f"{target}: this file has no member {VEHICLE}")
    return content[VEHICLE]


def with_values(scenario: Mapping[str, Any], values: Mapping[str, Any]) -> dict[str, Any]:
    """A copy of a complete scenario with these fields changed."""
    copy: dict[str, Any] = json.loads(json.dumps(scenario))
    for name, value in values.items():
        *path, last = name.split(".")
        part: Any = copy
        try:
            for step in path:
                part = part[int(step)] if isinstance(part, list) else part.setdefault(step, {})
            part[int(last) if isinstance(part, list) else last] = value
        except (TypeError, AttributeError, ValueError, IndexError):
            raise InputError(f"{name}: the scenario given has no such place") from None
    return copy


def grid_of(specs: Sequence[str]) -> dict[str, list[Any]]:
    """Each `FIELD=VALUES`."""
    return _unique(specs, "--grid", "FIELD=VALUES", _values)


def ranges_of(specs: Sequence[str], option: str) -> dict[str, list[float]]:
    """Each `FIELD=LOW:HIGH`."""
    return _unique(specs, option, "FIELD=LOW:HIGH", _range)


def _unique(specs: Sequence[str], option: str, form: str, read: Callable[[str], Any]) -> dict[str, Any]:
    values: dict[str, Any] = {}
    for name, value in (_pair(spec, f"{option} takes {form}", read) for spec in specs):
        if name in values:
            raise InputError(f"{name}: given twice to {option}")
        values[name] = value
    return values


def _pair(text: str, form: str, read: Callable[[str], Any]) -> tuple[str, Any]:
    """A field's name and what stands behind the sign."""
    name, _, value = (part.strip() for part in text.partition("="))
    if not value:
        raise InputError(f"{form}, and {text or 'nothing'} is no such pair")
    return name, _read(name, value, read)


def _read(name: str, text: str, read: Callable[[str], Any]) -> Any:
    try:
        return read(text)
    except ValueError as error:
        raise InputError(f"{name}: {error}") from None


def _values(text: str) -> list[Any]:
    """`0.05:0.15:11` (both ends, evenly), values with commas, or weights such as `[8,1,1],[2,6,1]`."""
    if text.startswith("["):
        return list(document(f"[{text}]".encode(), "weights"))
    if ":" not in text:
        return [_value(item.strip()) for item in text.split(",")]
    if (span := _SPAN.fullmatch(text)) is None:
        hint = "LOW:HIGH:COUNT, such as 0.05:0.15:11 for 11 values with both ends, nor values with commas between them"
        raise ValueError(f"{text} is neither {hint}")
    low, high, count = _value(span[1]), _value(span[2]), int(span[3])
    if not 2 <= count <= _MOST_VALUES:
        raise ValueError(f"LOW:HIGH:COUNT takes a count from 2 to {_MOST_VALUES}")
    steps = [float(f"{low + (high - low) * index / (count - 1):.{_DIGITS}g}") for index in range(count)]
    return [int(step) for step in steps] if all(step.is_integer() for step in steps) else steps


def _range(text: str) -> list[Any]:
    low, sign, high = text.partition(":")
    if not sign or ":" in high:
        raise ValueError("a range is LOW:HIGH, without the unit")
    return [_value(low), _value(high)]


def _value(text: str) -> Any:
    """A number, three weights with or without brackets, null where a field may be without a value, or a word."""
    if text in _WORDS:
        return _WORDS[text]
    if "," in text:
        return [_value(item.strip()) for item in text.removeprefix("[").removesuffix("]").split(",")]
    try:
        number = float(text)
    except ValueError:
        if re.match(_NUMBER, text):  # no choice of a field begins with a number
            raise ValueError(
                f"{text} is not a number: one is written without its unit, several as LOW:HIGH:COUNT or with commas"
            ) from None
        return text
    if not math.isfinite(number):
        raise ValueError(f"{text} is not a finite number")
    return int(number) if number.is_integer() and abs(number) < 1e15 else number


def _merged(base: Mapping[str, Any], over: Mapping[str, Any]) -> dict[str, Any]:
    merged = dict(base)
    for key, value in over.items():
        below = merged.get(key)
        merged[key] = _merged(below, value) if isinstance(below, dict) and isinstance(value, dict) else value
    return merged
