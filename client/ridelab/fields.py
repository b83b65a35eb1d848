"""A scenario's fields by dotted name."""

import json
from collections.abc import Iterable, Iterator, Mapping
from dataclasses import dataclass
from difflib import get_close_matches
from typing import Any

from ridelab.units import SWITCH


def fields_of(schema: Mapping[str, Any]) -> dict[str, Mapping[str, Any]]:
    """By dotted name the JSON Schema of each field of the scenario, in its order; three weights are one field."""
    return dict(_fields(schema, schema["$defs"], ""))


@dataclass(frozen=True, slots=True, kw_only=True)
class Limits:
    """The numbers that a field accepts, in its unit.

    Attributes:
        least: Its smallest value.
        most: Its greatest value.
        usual: Both ends of what a slider offers.
    """

    least: float
    most: float
    usual: tuple[float, float]


def limits_of(schema: Mapping[str, Any]) -> dict[str, Limits]:
    """Return by dotted name the limits of each field that is one number and has some."""
    limits = {}
    for name, field in fields_of(schema).items():
        number = {**next((each for each in field.get("anyOf", ()) if each.get("type") != "null"), {}), **field}
        if "minimum" in number and "maximum" in number:
            low, high = number["minimum"], number["maximum"]
            limits[name] = Limits(least=low, most=high, usual=tuple(number.get("soft_range", (low, high))))
    return limits


def units_of(schema: Mapping[str, Any]) -> dict[str, str]:
    """By dotted name the unit of what `--set` takes: each field, and weights one by one too.

    That of a field that is true or false is `ridelab.units.SWITCH`.
    """
    return {
        each: SWITCH if field.get("type") == "boolean" else field.get("unit", "1")
        for name, field in fields_of(schema).items()
        for each in (name, *(f"{name}.{index}" for index in range(field.get("maxItems", 0))))
    }


def with_values(scenario: Mapping[str, Any], values: Mapping[str, Any]) -> dict[str, Any]:
    """A copy of a complete scenario with these fields changed.

    Raises:
        ValueError: It has no such place.
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
            raise ValueError(f"{name}: the scenario given has no such place") from None
    return copy


def similar(name: str, names: Iterable[str]) -> str:
    """Return what a wrong name may have meant, as the end of a message; empty where nothing is like it.

    Dotted names that end with it come first: `height` may have meant `road.bump.height`.
    """
    names = list(names)
    alike = [each for each in names if each.endswith(f".{name}")] or get_close_matches(name, names)
    return f"; perhaps {' or '.join(alike)}" if alike else ""


def _fields(part: Mapping[str, Any], parts: Mapping[str, Any], prefix: str) -> Iterator[tuple[str, Mapping[str, Any]]]:
    for key, schema in part["properties"].items():
        if "$ref" in schema:
            yield from _fields(parts[schema["$ref"].rpartition("/")[2]], parts, f"{prefix}{key}.")
        else:
            yield prefix + key, schema
