"""Sweeps: which points of the scenario's space a batch visits.

A sweep as it is sent names fields by their dotted names (`sim_core.scenario.dotted`); `points` checks each name and
value and makes the list of points, each a mapping of those fields to values.
"""

import itertools
import math
from collections import Counter
from collections.abc import Iterator, Mapping, Sequence
from functools import cached_property
from typing import Annotated, Any, Self

import numpy as np
from pydantic import (
    BeforeValidator,
    Field,
    ValidatorFunctionWrapHandler,
    WithJsonSchema,
    WrapValidator,
    model_validator,
)
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


def _dotted_points(points: Any, validated: ValidatorFunctionWrapHandler) -> Any:
    """Name fields by their dotted names; a list of objects is what it has to be, and large ones take their time."""
    if not isinstance(points, list) or {*map(type, points)} != {dict}:
        return validated(points)
    return [point if dict not in map(type, point.values()) else _dotted(point) for point in points]


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
    points: Annotated[list[dict[str, Value]] | None, WrapValidator(_dotted_points)] = Field(
        None,
        alias="list",
        min_length=1,
        description="Field -> value, point by point; a field a point does not name keeps its value",
    )
    linked: Annotated[dict[str, Annotated[list[str], Field(min_length=1, max_length=32)]] | None, Dotted] = _by_field(
        "Swept field -> further fields that take its value at each point, such as one speed for both", None
    )

    @model_validator(mode="after")
    def _one_form(self) -> Self:
        if sum(form is not None for form in (self.grid, self.latin_hypercube, self.points)) != 1:
            raise PydanticCustomError("one_form", "Exactly one of grid, latin_hypercube and list has to be there")
        return self

    @property
    def size(self) -> int:
        """Return the number of points."""
        if self.grid is not None:
            return math.prod(len(values) for values in self.grid.values())
        return len(self.points or []) if self.latin_hypercube is None else self.latin_hypercube.samples

    @cached_property
    def places(self) -> dict[str, list[str | int]]:
        """Return where each swept field is named first."""
        if self.grid is not None:
            return {name: ["grid", name] for name in self.grid}
        if self.latin_hypercube is not None:
            return {name: ["latin_hypercube", "ranges", name] for name in self.latin_hypercube.ranges}
        places: dict[str, list[str | int]] = {}
        for index, point in enumerate(self.points or []):
            for name in point:
                if name not in places:
                    places[name] = ["list", index, name]
        return places

    @property
    def fields(self) -> list[str]:
        """Return the dotted names of the fields that the sweep changes."""
        linked = itertools.chain.from_iterable((self.linked or {}).values())
        return [*self.places, *linked]

    def plain(self) -> JsonObject:
        """Return the sweep as it was sent, its fields by dotted names."""
        rest = self.model_dump(mode="json", by_alias=True, exclude_none=True, exclude={"points"})
        return rest if self.points is None else {"list": self.points, **rest}


class SweepError(Exception):
    """Names or values a sweep cannot use; `errors` has a path and a message for each."""

    def __init__(self, errors: Sequence[tuple[list[str | int], str]]) -> None:
        super().__init__(errors)  # as it is: it travels from a worker process
        self.errors = errors

    def problems(self) -> list[dict[str, str]]:
        """The errors of an answer: the pointer into the request, and the message."""
        return [{"pointer": pointer(["sweep", *shown_path(path)]), "message": message} for path, message in self.errors]


def check_at_once(sweep: Sweep, base: JsonObject) -> None:
    """Check the sweep's names, and its values where they are few: of many that takes seconds.

    Raises:
        SweepError: As `points`.
    """
    values = sum(map(len, sweep.points or ())) + sum(map(len, (sweep.grid or {}).values()))
    if values <= FEW_VALUES:
        _checked_points(sweep, base, range(sweep.size))
        return
    found = _Errors()
    for name, path in sweep.places.items():
        found.field(name, path)
    _check_links(sweep, found, values=False)
    found.end()


def points(sweep: Sweep, base: JsonObject, first: int = 0, count: int | None = None) -> list[PointChanges]:
    """Return so many of the sweep's points; `base` is the plain scenario they start from.

    Raises:
        SweepError: Fields that do not exist, and values a field does not take; of a list in these points.
    """
    last = sweep.size if count is None else min(sweep.size, first + count)
    leaders = {field: name for name, fields in (sweep.linked or {}).items() for field in fields}
    drawn = _checked_points(sweep, base, range(first, last))
    return [point | {field: point[name] for field, name in leaders.items()} for point in drawn]


def _checked_points(sweep: Sweep, base: JsonObject, some: range) -> Iterator[PointChanges]:
    found = _Errors()
    drawn: Iterator[PointChanges]
    if sweep.grid is not None:
        drawn = itertools.islice(_grid(sweep.grid, found), some.start, some.stop)
    elif sweep.latin_hypercube is not None:
        drawn = itertools.islice(_latin_hypercube(sweep.latin_hypercube, found), some.start, some.stop)
    else:
        drawn = _list(sweep, base, some, found)
    _check_links(sweep, found)
    found.end()
    return drawn


class _Errors:
    """What a sweep cannot use; so many errors are enough."""

    def __init__(self) -> None:
        self._errors: list[tuple[list[str | int], str]] = []

    def add(self, path: list[str | int], message: str) -> None:
        """Note an error; raise SweepError where that is the last one to be told."""
        self._errors.append((path, message))
        if len(self._errors) == MOST_ERRORS:
            self.end()

    def end(self) -> None:
        """Raise SweepError where there were errors."""
        if self._errors:
            raise SweepError(self._errors)

    def field(self, name: str, path: list[str | int]) -> dotted.DottedField | None:
        """Return the field of that name; where there is none it is an error."""
        try:
            return dotted.field(name)
        except RidelabError:
            self.add(path, unknown_name("field", name, dotted.offered(name)))
            return None

    def checked(self, field: dotted.DottedField, value: Any, path: list[str | int]) -> Any:
        """Return the value as the field takes it; where it takes it not it is an error."""
        try:
            return field.checked(_whole(value) if field.kind == "integer" and isinstance(value, float) else value)
        except RidelabError as error:
            self.add(path, error.message)
            return None


def _grid(grid: Mapping[str, Sequence[Any]], found: _Errors) -> Iterator[PointChanges]:
    checked: dict[str, list[Any]] = {}
    for name, values in grid.items():
        field = found.field(name, ["grid", name])
        if field is not None:
            checked[name] = [found.checked(field, value, ["grid", name, i]) for i, value in enumerate(values)]
    return (dict(zip(checked, values, strict=True)) for values in itertools.product(*checked.values()))


def _list(sweep: Sweep, base: JsonObject, some: range, found: _Errors) -> Iterator[PointChanges]:
    fields = {name: found.field(name, path) for name, path in sweep.places.items()}
    unchanged = {name: dotted.value(base, name) for name, field in fields.items() if field is not None}
    named: list[PointChanges] = []
    for index in some:
        point = (sweep.points or [])[index].items()
        taken = ((name, field, value) for name, value in point if (field := fields[name]) is not None)
        named.append({name: found.checked(field, value, ["list", index, name]) for name, field, value in taken})
    return ({name: point.get(name, value) for name, value in unchanged.items()} for point in named)


def _latin_hypercube(cube: LatinHypercube, found: _Errors) -> Iterator[PointChanges]:
    for name, ends in cube.ranges.items():
        path: list[str | int] = ["latin_hypercube", "ranges", name]
        if len(ends) != 2 or not ends[0] < ends[1]:
            found.add(path, "A range is [lowest, highest], the first smaller than the second")
            continue
        field = found.field(name, path)
        if field is not None and field.kind not in ("number", "integer"):
            found.add(path, "A range needs a field that takes a number")
        elif field is not None:
            for index, end in enumerate(ends):
                found.checked(field, _whole(end) if field.kind == "integer" else end, [*path, index])
    return _drawn(cube)


def _drawn(cube: LatinHypercube) -> Iterator[PointChanges]:
    from scipy.stats import qmc  # takes half a second: most processes never draw

    names = list(cube.ranges)
    unit = qmc.LatinHypercube(d=len(names), rng=np.random.default_rng(cube.seed)).random(cube.samples)
    for row in unit:
        values = zip(names, row, strict=True)
        yield {name: _scaled(name, float(value), cube.ranges[name]) for name, value in values}


def _scaled(name: str, fraction: float, ends: Sequence[float]) -> float | int:
    low, high = ends
    if dotted.field(name).kind == "integer":
        return min(int(low + fraction * (high - low + 1)), int(high))
    return min(low + fraction * (high - low), high)


def _whole(value: float) -> float | int:
    return int(value) if float(value).is_integer() else value


def _check_links(sweep: Sweep, found: _Errors, *, values: bool = True) -> None:
    for name, followers in (sweep.linked or {}).items():
        path: list[str | int] = ["linked", name]
        if name not in sweep.places:
            found.add(path, "Only a field that the sweep changes can be followed by others")
            continue
        own = found.field(name, path)
        for index, follower in enumerate(followers):
            other = found.field(follower, [*path, index])
            if own is not None and other is not None and own.unit != other.unit:
                found.add([*path, index], f"Has another unit than {name}: {other.unit}, not {own.unit}")
            elif other is not None and values:
                for value in _values(sweep, name):
                    found.checked(other, value, [*path, index])
    _check_overlaps(sweep.fields, found)


def _values(sweep: Sweep, name: str) -> Sequence[Any]:
    """Return what that field is given: every value, or a range's ends."""
    if sweep.grid is not None:
        return sweep.grid[name]
    if sweep.latin_hypercube is not None:
        return sweep.latin_hypercube.ranges[name]
    return [point[name] for point in sweep.points or [] if name in point]


def _check_overlaps(names: Sequence[str], found: _Errors) -> None:
    """Refuse a field and one of its own members in one sweep, which would fight over the value."""
    for name in names:
        if name in dotted.fields() and any(other.startswith(name + ".") for other in names):
            found.add([], f"A sweep changes {name} either whole or in parts")
    for name, count in Counter(names).items():
        if count > 1:
            found.add(["linked"], f"{name} is changed twice")
