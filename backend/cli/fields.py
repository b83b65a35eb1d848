"""Fields and values as they are typed: `--set road.bump.height=0.12`, and the points of a sweep."""

import json
import re
from collections.abc import Mapping, Sequence
from pathlib import Path
from typing import Any

from backend.cli.reporting import InputError
from backend.cli.targets import document
from sim_core.errors import RidelabError
from sim_core.scenario import Scenario, dotted

_SPAN = re.compile(r"([^:,]+):([^:,]+):(\d+)")
_DIGITS = 12  # 0.05:0.15:11 gives 0.06 and not 0.060000000000000005


def changed(scenario: Mapping[str, Any], changes: Sequence[str]) -> dict[str, Any]:
    """The scenario with each `FIELD=VALUE` in its place.

    Raises:
        InputError: No such field, or it does not take that value.
    """
    if not changes:
        return dict(scenario)
    values = {}
    for change in changes:
        field, text = _split(change, "--set", "FIELD=VALUE")
        values[field.name] = _checked(field, _value(field, text))
    whole = _merged(Scenario().model_dump(mode="json"), scenario)
    try:
        return dotted.with_changes(whole, values)
    except (KeyError, TypeError, ValueError, IndexError):
        raise InputError(f"{', '.join(values)}: the scenario given has no such place") from None


def sweep_of(
    *, grid: Sequence[str], ranges: Sequence[str], samples: int | None, seed: int, points: Path | None
) -> dict[str, Any]:
    """The sweep that a command's options describe.

    Raises:
        InputError: Not exactly one form, no such field, or it does not take a value.
        OSError: The file of points cannot be read.
    """
    if sum((bool(grid), bool(ranges), points is not None)) != 1:
        raise InputError("Say what to sweep with one of --grid, --latin-hypercube and --list")
    if (samples is not None) != bool(ranges):
        raise InputError("--latin-hypercube and --samples belong together")
    if grid:
        return {"grid": _unique(grid, "--grid", "FIELD=VALUES", _values)}
    if ranges:
        found = ranges_of(ranges, "--latin-hypercube")
        return {"latin_hypercube": {"ranges": found, "samples": samples, "seed": seed}}
    assert points is not None  # noqa: S101  # one of three
    return {"list": document(points.read_bytes(), str(points))}


def ranges_of(specs: Sequence[str], option: str = "--range") -> dict[str, list[float]]:
    """Each `FIELD=LOW:HIGH`.

    Raises:
        InputError: No such field, given twice, or no range.
    """
    return _unique(specs, option, "FIELD=LOW:HIGH", _range)


def _unique(specs: Sequence[str], option: str, form: str, read: Any) -> dict[str, Any]:
    found = {}
    for spec in specs:
        field, text = _split(spec, option, form)
        if field.name in found:
            raise InputError(f"{field.name}: given twice to {option}")
        found[field.name] = read(field, text)
    return found


def _split(text: str, option: str, form: str) -> tuple[dotted.DottedField, str]:
    name, sign, value = text.partition("=")
    if not sign or not value:
        raise InputError(f"{option} takes {form}, and {text or 'nothing'} is no such pair")
    try:
        return dotted.field(name.strip()), value.strip()
    except RidelabError as error:
        raise InputError(f"{name.strip()}: {error.message}") from None


def _values(field: dotted.DottedField, text: str) -> list[Any]:
    """`0.05:0.15:11` (both ends, evenly), or values with commas."""
    span = _SPAN.fullmatch(text)
    if span is not None and field.kind in ("number", "integer"):
        low, high, count = _number(field, span[1]), _number(field, span[2]), int(span[3])
        if not 2 <= count <= 1_000_000:
            raise InputError(f"{field.name}: LOW:HIGH:COUNT takes a count from 2 to 1000000")
        steps = [low + (high - low) * index / (count - 1) for index in range(count)]
        return [_checked(field, _whole(field, float(f"{step:.{_DIGITS}g}"))) for step in steps]
    if ":" in text and field.kind in ("number", "integer"):
        raise InputError(
            f"{field.name}: {text} is neither LOW:HIGH:COUNT, such as 0.05:0.15:11 for 11 values with both ends, "
            "nor values with commas"
        )
    if field.kind == "weights":
        return [_checked(field, value) for value in _json(field, f"[{text}]")]
    return [_checked(field, _value(field, item.strip())) for item in text.split(",")]


def _range(field: dotted.DottedField, text: str) -> list[float]:
    low, sign, high = text.partition(":")
    if not sign or ":" in high:
        raise InputError(f"{field.name}: a range is LOW:HIGH")
    return [_number(field, low), _number(field, high)]


def _number(field: dotted.DottedField, text: str) -> float:
    try:
        return float(text)
    except ValueError:
        raise InputError(f"{field.name}: {text} is not a number") from None


def _whole(field: dotted.DottedField, value: float) -> float | int:
    return int(value) if field.kind == "integer" and value.is_integer() else value


def _value(field: dotted.DottedField, text: str) -> Any:
    """JSON where it is JSON, else the text itself; three weights may stand without brackets."""
    if field.kind == "weights" and not text.startswith("["):
        return _json(field, f"[{text}]")
    try:
        return json.loads(text)
    except ValueError:
        return text


def _json(field: dotted.DottedField, text: str) -> Any:
    try:
        return json.loads(text)
    except ValueError:
        raise InputError(f"{field.name}: three weights are 8,1,1; several of them [8,1,1],[2,6,1]") from None


def _checked(field: dotted.DottedField, value: Any) -> Any:
    try:
        return field.checked(value)
    except RidelabError as error:
        raise InputError(f"{field.name}: {error.message}") from None


def _merged(base: dict[str, Any], over: Mapping[str, Any]) -> dict[str, Any]:
    merged = dict(base)
    for key, value in over.items():
        below = merged.get(key)
        merged[key] = _merged(below, value) if isinstance(below, dict) and isinstance(value, dict) else value
    return merged
