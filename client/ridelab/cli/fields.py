"""Fields and values as they are typed: `--set road.bump.height=0.12`, and the points of a sweep.

Only their form is judged here; which values a field takes the service says.
"""

import json
import re
from collections.abc import Callable, Mapping, Sequence
from pathlib import Path
from typing import Any

from ridelab.cli.names import Field
from ridelab.cli.reporting import InputError
from ridelab.cli.service import Services
from ridelab.cli.targets import document, find

_SPAN = re.compile(r"([^:,]+):([^:,]+):(\d+)")
_DIGITS = 12  # 0.05:0.15:11 gives 0.06 and not 0.060000000000000005
_MOST_VALUES = 1_000_000
_NUMBERS = ("number", "integer")
_UNKNOWN = Field(unit="1", kind="string")  # the service refuses its name, and says which there are
_WORDS = {"true": True, "false": False, "null": None}


def scenario_of(target: str, changes: Sequence[str] | None, services: Services) -> dict[str, Any]:
    """The scenario of a target with each `FIELD=VALUE` in its place; errors as those of `changed` and `find`."""
    return changed(find(target, services).scenario, changes or [], services)


def changed(scenario: Mapping[str, Any], changes: Sequence[str], services: Services) -> dict[str, Any]:
    """The scenario with each `FIELD=VALUE` in its place.

    Raises:
        InputError: A value that is none of its field's kind.
    """
    if not changes:
        return dict(scenario)
    whole = _merged(next(iter(services.names.presets.values())), scenario)
    return with_values(whole, dict(_read(change, "--set", "FIELD=VALUE", _value, services) for change in changes))


def with_values(scenario: Mapping[str, Any], values: Mapping[str, Any]) -> dict[str, Any]:
    """A copy of a complete scenario with these fields changed.

    Raises:
        InputError: It has no such place.
    """
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


def sweep_of(
    services: Services,
    *,
    grid: Sequence[str],
    ranges: Sequence[str],
    samples: int | None,
    seed: int,
    points: Path | None,
) -> dict[str, Any]:
    """The sweep that a command's options describe.

    Raises:
        InputError: A field given twice, or values that are none of its kind.
        OSError: The file of points cannot be read.
    """
    if points is not None:
        return {"list": document(points.read_bytes(), str(points))}
    if grid:
        return {"grid": _unique(grid, "--grid", "FIELD=VALUES", _values, services)}
    ranged = ranges_of(ranges, "--latin-hypercube", services)
    return {"latin_hypercube": {"ranges": ranged, "samples": samples, "seed": seed}}


def ranges_of(specs: Sequence[str], option: str, services: Services) -> dict[str, list[float]]:
    """Each `FIELD=LOW:HIGH`.

    Raises:
        InputError: A field given twice, or no range.
    """
    return _unique(specs, option, "FIELD=LOW:HIGH", _range, services)


Reader = Callable[[str, Field], Any]


def _unique(specs: Sequence[str], option: str, form: str, read: Reader, services: Services) -> dict[str, Any]:
    values: dict[str, Any] = {}
    for spec in specs:
        name, value = _read(spec, option, form, read, services)
        if name in values:
            raise InputError(f"{name}: given twice to {option}")
        values[name] = value
    return values


def _read(text: str, option: str, form: str, read: Reader, services: Services) -> tuple[str, Any]:
    """A field's name and what stands behind the sign."""
    name, _, value = (part.strip() for part in text.partition("="))
    if not value:
        raise InputError(f"{option} takes {form}, and {text or 'nothing'} is no such pair")
    try:
        return name, read(value, services.names.fields.get(name, _UNKNOWN))
    except ValueError as error:
        raise InputError(f"{name}: {error}") from None


def _values(text: str, field: Field) -> list[Any]:
    """`0.05:0.15:11` (both ends, evenly), or values with commas."""
    if field.kind == "array":
        return list(_weights(f"[{text}]"))
    span = _SPAN.fullmatch(text)
    try:
        if span is None or field.kind not in _NUMBERS:
            return [_value(item.strip(), field) for item in text.split(",")]
        low, high, count = _number(span[1], field), _number(span[2], field), int(span[3])
    except ValueError:
        raise ValueError(
            f"{text} is neither LOW:HIGH:COUNT, such as 0.05:0.15:11 for 11 values with both ends, nor values with "
            f"commas between them{_in(field)}"
        ) from None
    if not 2 <= count <= _MOST_VALUES:
        raise ValueError(f"LOW:HIGH:COUNT takes a count from 2 to {_MOST_VALUES}")
    steps = [float(f"{low + (high - low) * index / (count - 1):.{_DIGITS}g}") for index in range(count)]
    return [int(step) if field.kind == "integer" and step.is_integer() else step for step in steps]


def _range(text: str, field: Field) -> list[float]:
    low, sign, high = text.partition(":")
    if not sign or ":" in high:
        raise ValueError(f"a range is LOW:HIGH{_in(field)}")
    return [_number(low, field), _number(high, field)]


def _value(text: str, field: Field) -> Any:
    """A number, a word, or three weights with or without brackets; null where a field may be without one."""
    if text in _WORDS:
        return _WORDS[text]
    if field.kind == "array":
        return _weights(text if text.startswith("[") else f"[{text}]")
    if field.kind not in _NUMBERS:
        return text
    number = _number(text, field)
    return int(number) if field.kind == "integer" and number.is_integer() else number


def _number(text: str, field: Field) -> float:
    try:
        number = float(text)
    except ValueError:
        raise ValueError(f"{text} is not a number: it takes one{_in(field)}") from None
    if number - number != 0:  # infinite, or not a number
        raise ValueError(f"{text} is not a finite number")
    return number


def _in(field: Field) -> str:
    return "" if field.unit == "1" else f", in {field.unit} and without the unit"


def _weights(text: str) -> Any:
    try:
        return json.loads(text)
    except ValueError:
        raise ValueError("three weights are 8,1,1; several of them [8,1,1],[2,6,1]") from None


def _merged(base: Mapping[str, Any], over: Mapping[str, Any]) -> dict[str, Any]:
    merged = dict(base)
    for key, value in over.items():
        below = merged.get(key)
        merged[key] = _merged(below, value) if isinstance(below, dict) and isinstance(value, dict) else value
    return merged
