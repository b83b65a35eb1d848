"""Sweeps: which points of the scenario's space a batch visits.

A sweep as it is sent names fields by their dotted names (`sim_core.scenario.dotted`); `points` checks each name and
value and makes the list of points, each a mapping of those fields to values.
"""

import itertools
import math
from collections import Counter
from collections.abc import Callable, Iterator, Mapping, Sequence
from typing import Annotated, Any, Self

import numpy as np
from pydantic import BeforeValidator, Field, WithJsonSchema, model_validator
from pydantic_core import PydanticCustomError

from backend.json_types import NUMBERS_SCHEMA, JsonObject
from backend.models import RequestModel
from backend.unknown_names import pointer, shown_path, unknown_name
from sim_core.errors import RidelabError
from sim_core.scenario import dotted

PointChanges = JsonObject
# Checked against its field, not against a type: the error then says what that field takes.
Value = Annotated[
    Any,
    WithJsonSchema(
        {
            "anyOf": [
                {"type": "number"},
                {"type": "string"},
                {"type": "boolean"},
                {"type": "null"},
                NUMBERS_SCHEMA,
            ],
            "description": "What the field takes: a number, a choice's name, true or false, three weights, a curve",
        }
    ),
]
MOST_ERRORS = 50
FEW_VALUES = 1000  # are checked in some 10 ms


def _dotted(fields: Any) -> Any:
    """Name nested fields by their dotted names: `{"road": {"seed": 1}}` is `{"road.seed": 1}`."""
    if not isinstance(fields, dict):
        return fields
    flat: dict[str, Any] = {}
    for name, value in fields.items():
        if isinstance(value, dict) and name not in dotted.fields():
            inner = {f"{name}.{key}": each for key, each in value.items()}
            flat |= _dotted(inner)
        else:
            flat[name] = value
    return flat


Dotted = BeforeValidator(_dotted)


def _by_field(description: str, default: Any = ...) -> Any:
    return Field(
        default,
        min_length=1,
        max_length=32,
        description=description,
        json_schema_extra={"propertyNames": dotted.names_schema(dotted.scenario_fields())},
    )


class LatinHypercube(RequestModel):
    """Evenly spread random points (scipy.stats.qmc.LatinHypercube); whole-number fields get whole numbers."""

    ranges: Annotated[dict[str, list[float]], Dotted] = _by_field("Field -> [lowest, highest]")
    samples: int = Field(ge=1, le=1_000_000)
    seed: int = Field(0, ge=0, le=2**32 - 1, description="Same seed, same points")


class Sweep(RequestModel):
    """Exactly one of its three forms; `linked` with any of them."""

    grid: Annotated[dict[str, Annotated[list[Value], Field(min_length=1)]] | None, Dotted] = _by_field(
        "Field -> values; every combination, the last field changing fastest", None
    )
    latin_hypercube: LatinHypercube | None = None
    points: Annotated[list[Annotated[dict[str, Value], Dotted]], Field(min_length=1)] | None = Field(
        None, alias="list", description="Field -> value, point by point; a field a point does not name keeps its value"
    )
    linked: Annotated[dict[str, Annotated[list[str], Field(min_length=1, max_length=32)]] | None, Dotted] = _by_field(
        "Swept field -> further fields that take its value at each point, such as one speed for both", None
    )

    @model_validator(mode="after")
    def _one_form(self) -> Self:
        if sum(form is not None for form in (self.grid, self.latin_hypercube, self.points)) != 1:
            raise PydanticCustomError("one_form", "Exactly one of grid, latin_hypercube and list has to be there")
        return self


class SweepError(Exception):
    """Names or values a sweep cannot use; `errors` has a path and a message for each."""

    def __init__(self, errors: Sequence[tuple[list[str | int], str]]) -> None:
        super().__init__(errors)  # as it is: it travels from a worker process
        self.errors = errors

    def problems(self) -> list[dict[str, str]]:
        """The errors of an answer: the pointer into the request, and the message."""
        return [{"pointer": pointer(["sweep", *shown_path(path)]), "message": message} for path, message in self.errors]


def size(sweep: Sweep) -> int:
    """The number of points."""
    if sweep.grid is not None:
        return math.prod(len(values) for values in sweep.grid.values())
    if sweep.latin_hypercube is not None:
        return sweep.latin_hypercube.samples
    return len(sweep.points or [])


def fields_of(sweep: Sweep) -> list[str]:
    """Return the dotted names of the fields that the sweep changes."""
    linked = itertools.chain.from_iterable((sweep.linked or {}).values())
    return [*_places(sweep), *linked]


def check_at_once(sweep: Sweep, base: JsonObject) -> None:
    """Check the sweep's names, and its values where they are few: of many that takes seconds.

    Raises:
        SweepError: As `points`.
    """
    values = sum(map(len, sweep.points or ())) + sum(map(len, (sweep.grid or {}).values()))
    if values <= FEW_VALUES:
        _checked_points(sweep, base)
        return
    errors: Errors = []
    for name, path in _places(sweep).items():
        _field(name, path, errors)
    _check_links(sweep, errors, values=False)
    _raise(errors)


def points(sweep: Sweep, base: JsonObject, first: int = 0, count: int | None = None) -> list[PointChanges]:
    """Return so many of the sweep's points; `base` is the plain scenario they start from.

    Raises:
        SweepError: Fields that do not exist, and values a field does not take.
    """
    draw = _checked_points(sweep, base)
    leaders = {field: name for name, fields in (sweep.linked or {}).items() for field in fields}
    drawn = draw(first, None if count is None else first + count)
    return [point | {field: point[name] for field, name in leaders.items()} for point in drawn]


Errors = list[tuple[list[str | int], str]]
Points = Callable[[int, int | None], Iterator[PointChanges]]  # from the first one to before the last one


def _checked_points(sweep: Sweep, base: JsonObject) -> Points:
    errors: Errors = []
    if sweep.grid is not None:
        draw = _grid(sweep.grid, errors)
    elif sweep.latin_hypercube is not None:
        draw = _latin_hypercube(sweep.latin_hypercube, errors)
    else:
        draw = _list(sweep.points or [], list(_places(sweep)), base, errors)
    _check_links(sweep, errors)
    _raise(errors)
    return draw


def _raise(errors: Errors) -> None:
    if errors:
        raise SweepError(errors[:MOST_ERRORS])


def _places(sweep: Sweep) -> dict[str, list[str | int]]:
    """Return where each swept field is named first."""
    if sweep.grid is not None:
        return {name: ["grid", name] for name in sweep.grid}
    if sweep.latin_hypercube is not None:
        return {name: ["latin_hypercube", "ranges", name] for name in sweep.latin_hypercube.ranges}
    places: dict[str, list[str | int]] = {}
    for index, point in enumerate(sweep.points or []):
        for name in point:
            if name not in places:
                places[name] = ["list", index, name]
    return places


def _grid(grid: Mapping[str, Sequence[Any]], errors: Errors) -> Points:
    checked = {
        name: [_checked(name, value, ["grid", name, index], errors) for index, value in enumerate(values)]
        for name, values in grid.items()
    }
    every = itertools.product(*checked.values())
    return lambda first, last: (
        dict(zip(checked, values, strict=True)) for values in itertools.islice(every, first, last)
    )


def _list(listed: Sequence[JsonObject], names: Sequence[str], base: JsonObject, errors: Errors) -> Points:
    named = [
        {name: _checked(name, value, ["list", index, name], errors) for name, value in point.items()}
        for index, point in enumerate(listed)
    ]
    unchanged = {} if errors else {name: dotted.value(base, name) for name in names}
    return lambda first, last: (
        {name: point.get(name, unchanged[name]) for name in names} for point in named[first:last]
    )


def _latin_hypercube(cube: LatinHypercube, errors: Errors) -> Points:
    for name, ends in cube.ranges.items():
        path: list[str | int] = ["latin_hypercube", "ranges", name]
        if len(ends) != 2 or not ends[0] < ends[1]:
            errors.append((path, "A range is [lowest, highest], the first smaller than the second"))
            continue
        field = _field(name, path, errors)
        if field is not None and field.kind not in ("number", "integer"):
            errors.append((path, "A range needs a field that takes a number"))
        elif field is not None:
            for index, end in enumerate(ends):
                _checked(name, _whole(end) if field.kind == "integer" else end, [*path, index], errors)

    def draw(first: int, last: int | None) -> Iterator[PointChanges]:
        from scipy.stats import qmc  # takes half a second: most processes never draw

        names = list(cube.ranges)
        unit = qmc.LatinHypercube(d=len(names), rng=np.random.default_rng(cube.seed)).random(cube.samples)
        for row in unit[first:last]:
            values = zip(names, row, strict=True)
            yield {name: _scaled(name, float(value), cube.ranges[name]) for name, value in values}

    return draw


def _scaled(name: str, fraction: float, ends: Sequence[float]) -> float | int:
    low, high = ends
    if dotted.field(name).kind == "integer":
        return min(int(low + fraction * (high - low + 1)), int(high))
    return min(low + fraction * (high - low), high)


def _whole(value: float) -> float | int:
    return int(value) if float(value).is_integer() else value


def _field(name: str, path: list[str | int], errors: Errors) -> dotted.DottedField | None:
    try:
        return dotted.field(name)
    except RidelabError:
        same_field = bool(errors) and errors[-1][0] == path  # as for each of its values
        if len(errors) < MOST_ERRORS and not same_field:
            errors.append((path, unknown_name("field", name, dotted.offered(name))))
        return None


def _checked(name: str, value: Any, path: list[str | int], errors: Errors) -> Any:
    field = _field(name, path if path[0] == "list" else path[:-1], errors)
    if field is None:
        return None
    try:
        return field.checked(_whole(value) if field.kind == "integer" and isinstance(value, float) else value)
    except RidelabError as error:
        errors.append((path, error.message))
        return None


def _check_links(sweep: Sweep, errors: Errors, *, values: bool = True) -> None:
    names = list(_places(sweep))
    for name, fields in (sweep.linked or {}).items():
        path: list[str | int] = ["linked", name]
        if name not in names:
            errors.append((path, "Only a field that the sweep changes can be followed by others"))
            continue
        own = _field(name, path, errors)
        for index, field in enumerate(fields):
            other = _field(field, [*path, index], errors)
            if own is not None and other is not None and own.unit != other.unit:
                errors.append(([*path, index], f"Has another unit than {name}: {other.unit}, not {own.unit}"))
            elif other is not None and values:
                for value in _values(sweep, name):
                    _checked(field, value, [*path, index], errors)
    _check_overlaps(fields_of(sweep), errors)


def _values(sweep: Sweep, name: str) -> Sequence[Any]:
    """Return what that field is given: every value, or a range's ends."""
    if sweep.grid is not None:
        return sweep.grid[name]
    if sweep.latin_hypercube is not None:
        return sweep.latin_hypercube.ranges[name]
    return [point[name] for point in sweep.points or [] if name in point]


def _check_overlaps(names: Sequence[str], errors: Errors) -> None:
    """Refuse a field and one of its own members in one sweep, which would fight over the value."""
    for name in names:
        if name in dotted.fields() and any(other.startswith(name + ".") for other in names):
            errors.append(([], f"A sweep changes {name} either whole or in parts"))
    for name, count in Counter(names).items():
        if count > 1:
            errors.append((["linked"], f"{name} is changed twice"))
