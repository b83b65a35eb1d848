"""A scenario as tables: every part, each field with its unit, what differs from the paper marked."""

from collections.abc import Mapping
from dataclasses import dataclass
from functools import cache
from typing import Any

from backend.runs.reports import numbers
from sim_core.scenario import Scenario


@dataclass(frozen=True, slots=True, kw_only=True)
class Field:
    """One field: its value as text, and the paper's where that is another."""

    name: str
    title: str
    shown: str
    paper: str | None


@dataclass(frozen=True, slots=True, kw_only=True)
class Part:
    """One part and its own fields, not those of parts inside it."""

    name: str
    title: str
    description: str
    fields: tuple[Field, ...]

    @property
    def differs(self) -> int:
        """How many of its fields are other than the paper's."""
        return sum(field.paper is not None for field in self.fields)


def parts(scenario: Mapping[str, Any]) -> list[Part]:
    """Every part of a complete scenario, in the schema's order; parts inside parts follow them."""
    schema = _schema()
    found: list[Part] = []
    for name, node in schema["properties"].items():
        _collect(found, (name,), _resolved(node), "", scenario[name], _paper()[name])
    return found


def command(scenario: Mapping[str, Any], strategies: list[str], roads: int = 1, baseline: str | None = None) -> str:
    """The command line that runs it again, over several roads with that baseline."""
    changes = [
        f"--set {field.name}={_typed(_at(scenario, field.name))}"
        for part in parts(scenario)
        for field in part.fields
        if field.paper is not None
    ]
    over = [f"--roads {roads} --baseline {baseline}"] if roads > 1 else []
    return " ".join(["ridelab run", *changes, f"--strategy {','.join(strategies)}", *over])


def _collect(
    found: list[Part],
    path: tuple[str, ...],
    node: dict[str, Any],
    above: str,
    values: Mapping[str, Any],
    paper: Mapping[str, Any],
) -> None:
    own, inside = [], []
    title = f"{above}: {_title(path, node)}" if above else _title(path, node)
    for key, child in node["properties"].items():
        field = _resolved(child)
        if "properties" in field:
            inside.append((key, field))
        else:
            own.append(_field((*path, key), field, values[key], paper[key]))
    description = str(node.get("description", "")).replace("`", "")
    found.append(Part(name=".".join(path), title=title, description=description, fields=tuple(own)))
    for key, field in inside:
        _collect(found, (*path, key), field, title, values[key], paper[key])


def _field(path: tuple[str, ...], node: Mapping[str, Any], value: Any, paper: Any) -> Field:
    unit = str(node.get("unit", "1"))
    return Field(
        name=".".join(path),
        title=str(node["title"]),
        shown=_shown(value, unit),
        paper=None if value == paper else _shown(paper, unit),
    )


def _shown(value: Any, unit: str) -> str:
    if value is None:
        return "none"
    if isinstance(value, list):
        return ", ".join(numbers.exact(item) for item in value)
    if isinstance(value, int | float) and not isinstance(value, bool):
        return numbers.with_unit(numbers.exact(value), unit)
    return str(value).replace("_", " ")


def _typed(value: Any) -> str:
    """As `--set` takes it."""
    if isinstance(value, list):
        return ",".join(_typed(item) for item in value)
    return f"{value:.10g}" if isinstance(value, float) else "null" if value is None else str(value)


def _title(path: tuple[str, ...], node: Mapping[str, Any]) -> str:
    """A part's title; a model's own name, which the schema puts there for one without, is no title."""
    title = str(node.get("title", ""))
    return title if " " in title or len(path) == 1 else path[-1].replace("_", " ").capitalize()


def _resolved(node: Mapping[str, Any]) -> dict[str, Any]:
    """A node of the schema with its $ref followed; what stands beside the $ref comes first."""
    target = _schema()["$defs"][node["$ref"].rsplit("/", 1)[1]] if "$ref" in node else {}
    return {**target, **{key: value for key, value in node.items() if key != "$ref"}}


def _at(scenario: Mapping[str, Any], name: str) -> Any:
    found: Any = scenario
    for key in name.split("."):
        found = found[key]
    return found


@cache
def _schema() -> dict[str, Any]:
    return Scenario.model_json_schema()


@cache
def _paper() -> dict[str, Any]:
    return Scenario().model_dump(mode="json")
