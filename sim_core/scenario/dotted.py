"""Single fields of a scenario by their dotted names, as sweeps and the command line use them.

`road.bump.height` is a field, `mpc.stage_weights.cruise` three weights, `mpc.stage_weights.cruise.0` the first of them;
`fuzzy.rules` is data, which is given whole. `own.ID.OPTION` is an option of a controller of one's own, as far as there
is one.
"""

import re
from collections.abc import Callable, Iterable, Iterator, Mapping
from copy import copy
from dataclasses import dataclass
from functools import cache
from typing import Annotated, Any, Literal, Self, get_args, get_origin

from pydantic import BaseModel, ConfigDict, TypeAdapter, ValidationError
from pydantic.fields import FieldInfo

from sim_core.errors import RefusedError, UnknownNameError
from sim_core.scenario import Scenario
from sim_core.scenario.fields import WEIGHT, field_texts

Kind = Literal["number", "integer", "switch", "choice", "text", "weights", "data"]
OWN = "own."
OPTION = r"^own\.[a-z][a-z0-9_]*\.[A-Za-z_][A-Za-z0-9_]*$"
_LIMITS = {"less_than", "less_than_equal", "greater_than", "greater_than_equal"}  # pydantic's names of them
STRICT = ConfigDict(strict=True, allow_inf_nan=False, hide_input_in_errors=True)


@dataclass(frozen=True, slots=True, kw_only=True)
class DottedField:
    """One field: what it is called, its unit (`1` for none) and what it takes."""

    name: str
    title: str
    unit: str
    kind: Kind
    adapter: TypeAdapter[Any]
    default: Any = None  # of an option, which a scenario may lack

    @classmethod
    def of(cls, name: str, title: str, unit: str, annotation: Any, limits: FieldInfo, default: Any = None) -> Self:
        """Return the field of a type within limits."""
        annotated: Any = Annotated[annotation, limits]
        adapter: TypeAdapter[Any] = TypeAdapter(annotated, config=STRICT)
        return cls(name=name, title=title, unit=unit, kind=kind_of(annotation), adapter=adapter, default=default)

    def checked(self, value: Any) -> Any:
        """Return the value as the scenario holds it, in plain JSON types.

        Raises:
            RidelabError: It is of another type or beyond the hard limits; the message does not repeat it.
        """
        return self.adapter.dump_python(validated(self.adapter, value, self.name, self.unit), mode="json")


def validated(adapter: TypeAdapter[Any], value: Any, field: str, unit: str = "1") -> Any:
    """Return the value as the adapter takes it.

    Raises:
        RidelabError: It does not, of that field; the message does not repeat the value.
    """
    try:
        return adapter.validate_python(value)
    except ValidationError as error:
        raise RefusedError(explain(error.errors(include_input=False)[0], unit), field=field) from None


def explain(error: Mapping[str, Any], unit: str = "1") -> str:
    """Return what one of pydantic's errors says of a field: a limit with its unit.

    Args:
        error: The error, of `ValidationError.errors()`.
        unit: The field's unit, `1` for none.
    """
    if error["type"] == "bool_type":
        return "Input should be true or false"
    return f"{error['msg']} {unit}" if error["type"] in _LIMITS and unit != "1" else str(error["msg"])


_find_options: Callable[[], Mapping[str, DottedField]] = dict


def use_options(find: Callable[[], Mapping[str, DottedField]]) -> None:
    """Have this say which options of controllers of one's own there are, by dotted name."""
    global _find_options
    _find_options = find


def fields() -> dict[str, DottedField]:
    """Return every field by its dotted name, in the scenario's order; options of controllers of one's own come last."""
    return {**scenario_fields(), **_find_options()}


@cache
def scenario_fields() -> dict[str, DottedField]:
    """Return those that every scenario has."""
    return {field.name: field for field in _walk(Scenario, "")}


def names_schema(names: Iterable[str]) -> dict[str, Any]:
    """Return the JSON Schema of a name: one of these, or an option of a controller of one's own."""
    return {"anyOf": [{"enum": list(names)}, {"pattern": OPTION}]}


def is_option(name: str) -> bool:
    """Check whether it names an option of a controller of one's own, which may be there no more."""
    return re.match(OPTION, name) is not None


def field(name: str) -> DottedField:
    """Return the field of that name.

    Raises:
        UnknownNameError: There is none, or it is a whole part; the message lists the names to choose from.
    """
    match = scenario_fields().get(name) or (_find_options().get(name) if is_option(name) else None)
    if match is None:
        raise _unknown(name)
    return match


def _unknown(name: str) -> UnknownNameError:
    return UnknownNameError(f"Unknown field; there are {', '.join(offered(name))}")


def value(scenario: Mapping[str, Any], name: str) -> Any:
    """Return a field's value in a complete plain scenario."""
    if is_option(name):
        _, controller, option = name.split(".")
        options = scenario["own"].get(controller, {})
        return options[option] if option in options else field(name).default
    part: Any = scenario
    for step in name.split("."):
        part = part[_key(part, step)]
    return part


def is_within(name: str, part: str) -> bool:
    """Check whether a dotted name is that of a part or field, or of something in it."""
    return f"{name}.".startswith(f"{part}.")


def with_changes(scenario: Mapping[str, Any], changes: Mapping[str, Any]) -> dict[str, Any]:
    """Return a copy of a complete plain scenario with these fields or whole parts changed, which shares the others.

    The values are not checked: `Scenario.model_validate` does that.

    Args:
        scenario: As `Scenario.model_dump(mode="json")` gives it.
        changes: Dotted name -> value.

    Raises:
        UnknownNameError: There is no such field; the message lists the names to choose from.
    """
    changed = dict(scenario)
    for name, value in changes.items():
        fields = scenario_fields()
        if name not in fields and not is_option(name) and not any(is_within(each, name) for each in fields):
            raise _unknown(name)
        *parts, last = name.split(".")
        part: Any = changed
        for step in parts:
            part[step] = copy(part[step]) if step in part else {}  # a controller none of whose options was set
            part = part[step]
        part[_key(part, last)] = value
    return changed


def _key(part: Any, step: str) -> str | int:
    return step if isinstance(part, Mapping) else int(step)


def offered(name: str) -> list[str]:
    """Return what an unknown name may have meant: those below the deepest part that it begins with."""
    names = list(fields())
    steps = name.split(".")
    for length in range(len(steps), 0, -1):
        prefix = ".".join(steps[:length]) + "."
        below = [each for each in names if each.startswith(prefix)]
        if below:
            return below
    return names


def _walk(model: type[BaseModel], prefix: str) -> Iterator[DottedField]:
    for key, info in model.model_fields.items():
        name, annotation = prefix + key, info.annotation
        if isinstance(annotation, type) and issubclass(annotation, BaseModel):
            yield from _walk(annotation, f"{name}.")
            continue
        extra = info.json_schema_extra if isinstance(info.json_schema_extra, dict) else {}
        unit, title = str(extra.get("unit", "1")), field_texts(model, key)["title"]
        yield DottedField.of(name, title, unit, annotation, info)
        titles = extra.get("item_titles")
        for index, item_title in enumerate(titles if isinstance(titles, list) else []):
            yield DottedField.of(f"{name}.{index}", f"{title}: {item_title}", unit, float, WEIGHT)


def kind_of(annotation: Any) -> Kind:
    """Return the kind of a field of that type."""
    types = {annotation, *get_args(annotation)}
    if annotation is bool:
        return "switch"
    if get_args(annotation) and all(isinstance(each, str) for each in get_args(annotation)):
        return "choice"
    kinds: dict[type, Kind] = {str: "text", float: "number", int: "integer"}
    if (known := next((each for each in kinds if each in types), None)) is not None:
        return kinds[known]
    return "weights" if get_origin(annotation) is tuple else "data"
