"""A scenario as tables: every part, each field with its unit, differences from the paper marked."""

import shlex
from dataclasses import dataclass
from functools import cache
from inspect import cleandoc
from typing import Any

import orjson

from backend.json_types import JsonObject
from sim_core.comparison import numbers
from sim_core.scenario import Scenario, dotted
from sim_core.scenario.fields import field_texts
from sim_core.strategies import label_of


@dataclass(frozen=True, slots=True, kw_only=True)
class Field:
    """One field: its value as text, and the paper's where they differ."""

    name: str
    title: str
    shown: str
    paper: str | None


@dataclass(frozen=True, slots=True, kw_only=True)
class ScenarioPart:
    """One part and its own fields, not those of parts inside it."""

    name: str
    title: str
    description: str
    fields: tuple[Field, ...]

    @property
    def differs(self) -> int:
        """The number of fields that differ from the paper's."""
        return sum(field.paper is not None for field in self.fields)


def parts(scenario: JsonObject) -> list[ScenarioPart]:
    """Every part of a complete scenario, in the schema's order; parts inside parts follow them."""
    by_part: dict[str, list[Field]] = {}
    for name, described in dotted.fields().items():
        path = name.split(".")[:-1]
        if dotted.is_option(name) and path[1] not in scenario["own"]:
            continue
        if ".".join(path) in dotted.fields():  # one of three weights, which are shown together
            continue
        for length in range(1, len(path) + 1):
            by_part.setdefault(".".join(path[:length]), [])
        by_part[".".join(path)].append(_field(described, dotted.value(scenario, name), dotted.value(_paper(), name)))
    return [
        ScenarioPart(name=name, title=_title(name), description=_described(name)[1], fields=tuple(fields))
        for name, fields in by_part.items()
    ]


def command(scenario: JsonObject, strategies: list[str], roads: int = 1, baseline: str | None = None) -> str:
    """The command line that repeats the run, over several roads with that baseline."""
    changes = [
        f"--set {field.name}={_typed(dotted.value(scenario, field.name))}"
        for part in parts(scenario)
        for field in part.fields
        if field.paper is not None
    ]
    over = [f"--roads {roads} --baseline {baseline}"] if roads > 1 else []
    return " ".join(["ridelab run", *changes, f"--strategy {','.join(strategies)}", *over])


def _field(described: dotted.DottedField, value: Any, paper: Any) -> Field:
    return Field(
        name=described.name,
        title=described.title,
        shown=_shown(value, described),
        paper=None if value == paper else _shown(paper, described),
    )


def _shown(value: Any, described: dotted.DottedField) -> str:
    if value is None:
        return "none"
    if described.kind == "data":
        return orjson.dumps(value).decode()
    if isinstance(value, list):
        return ", ".join(numbers.exact(item) for item in value)
    if isinstance(value, int | float) and not isinstance(value, bool):
        return numbers.with_unit(numbers.exact(value), described.unit)
    return str(value).replace("_", " ")


def _typed(value: Any) -> str:
    """A value in the form that `--set` takes."""
    if isinstance(value, dict) or (isinstance(value, list) and isinstance(value[0], dict)):
        return shlex.quote(orjson.dumps(value).decode())
    if isinstance(value, list):
        return ",".join(_typed(item) for item in value)
    return f"{value:.10g}" if isinstance(value, float) else "null" if value is None else str(value)


def _title(name: str) -> str:
    """A part's title after that of the part around it; a model's class name is no title."""
    above, _, key = name.rpartition(".")
    if above == "own":
        return f"{_title(above)}: {label_of(key)}"
    title = _described(name)[0]
    if not above:
        return title
    return f"{_title(above)}: {title if ' ' in title else key.replace('_', ' ').capitalize()}"


@cache
def _described(name: str) -> tuple[str, str]:
    """A part's own title and description."""
    if name.startswith(dotted.OWN):
        return name, "Its options."
    model: Any = Scenario
    for key in name.split("."):
        texts, model = field_texts(model, key), model.model_fields[key].annotation
    return texts.get("title", model.__name__), texts.get("description", cleandoc(model.__doc__ or "")).replace("`", "")


@cache
def _paper() -> JsonObject:
    return Scenario().model_dump(mode="json")
