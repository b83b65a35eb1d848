"""A scenario's fields by dotted name."""

import json
from collections.abc import Iterable, Iterator, Mapping
from difflib import get_close_matches
from typing import Any


def fields_of(schema: Mapping[str, Any]) -> dict[str, Mapping[str, Any]]:
    """By dotted name the JSON Schema of each field of the scenario, in its order; three weights are one field."""
    return dict(_fields(schema, schema["$defs"], ""))


def units_of(schema: Mapping[str, Any]) -> dict[str, str]:
    """By dotted name the unit of what `--set` takes: each field, and weights one by one too."""
    return {
        each: field.get("unit", "1")
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
    """What a wrong name may have meant, as the end of a message; empty where nothing is like it."""
    alike = get_close_matches(name, list(names))
    return f"; perhaps {' or '.join(alike)}" if alike else ""


def _fields(part: Mapping[str, Any], parts: Mapping[str, Any], prefix: str) -> Iterator[tuple[str, Mapping[str, Any]]]:
    for key, schema in part["properties"].items():
        if "$ref" in schema:
            yield from _fields(parts[schema["$ref"].rpartition("/")[2]], parts, f"{prefix}{key}.")
        else:
            yield prefix + key, schema
