"""The scenario's reference page, docs/reference/scenario.md, written from its schema."""

from typing import Any

from sim_core.catalogue import COMFORT, EVENTS, RUN_FIGURES, SIGNALS, Entry
from sim_core.scenario import Scenario, dotted
from sim_core.scenario.data_sheet import DataSheet
from sim_core.scenario.presets import PRESETS
from sim_core.scenario.vehicles import VEHICLES
from sim_core.strategies import STRATEGIES, reads

_HEAD = """# The scenario, field by field

Written from sim_core/scenario/parts.py; a test keeps this page equal to it. Every field
has a default, the paper's unless its text says "ours"; the range is what a slider offers, the limits what is accepted.
A field that is on or off is `true` or `false` in JSON; the command takes `on`, `off`, `yes`, `no`, `1` and `0` too.
"""
_DATA_SHEET = """Of what a whole car's data sheet says `sim_core.scenario.data_sheet.DataSheet`,
`POST /api/v1/vehicles/from-data-sheet` and the page make a `vehicle`; its fields stand in no scenario."""


def page() -> str:
    """The whole page as Markdown."""
    schema = Scenario.model_json_schema()
    lines = [_HEAD]
    for name, part in schema["properties"].items():
        lines += _part(name, _resolve(part, schema), schema)
    lines += ["## Presets\n", "| id | what it is | other than the paper's |", "|---|---|---|"]
    lines += [f"| {_named(each.id)} | {each.description} | {_changed(each.scenario)} |" for each in PRESETS.values()]
    lines += ["\n## Vehicles\n", "| id | what it is | other than the paper's |", "|---|---|---|"]
    for car in VEHICLES.values():
        lines.append(f"| {_named(car.id)} | {car.description} | {_changed(Scenario(vehicle=car.vehicle))} |")
    lines += ["", _DATA_SHEET, "", *_part("data_sheet", DataSheet.model_json_schema(), {})]
    lines += ["## Strategies\n", "| id | what it does | reads |", "|---|---|---|"]
    for row in STRATEGIES.values():
        lines.append(f"| {_named(row.id)} | {row.description()} | {', '.join(f'`{name}`' for name in reads(row))} |")
    for title, catalogue in {
        "Signals": SIGNALS,
        "Comfort figures": COMFORT,
        "Run figures": RUN_FIGURES,
        "Events": EVENTS,
    }.items():
        lines += [f"\n## {title}\n", "| key | label | unit | note |", "|---|---|---|---|"]
        lines += [_quantity(item) for item in catalogue.values()]
    return "\n".join(lines) + "\n"


def _named(name: str) -> str:
    """A name with an anchor, so that an address may end with it."""
    return f'<a id="{name}"></a>`{name}`'


def _changed(scenario: Scenario) -> str:
    """Fields that have another value than by default."""
    default, plain = (each.model_dump(mode="json") for each in (Scenario(), scenario))
    names = [name for name in dotted.fields() if not name.rpartition(".")[2].isdigit()]  # no single weights
    values = {name: dotted.value(plain, name) for name in names}
    changed = {name: value for name, value in values.items() if value != dotted.value(default, name)}
    return ", ".join(f"`{name}` {_show(value)}" for name, value in changed.items())


def _resolve(node: dict[str, Any], schema: dict[str, Any]) -> dict[str, Any]:
    """A node with its $ref followed."""
    target: dict[str, Any] = schema["$defs"][node["$ref"].rsplit("/", 1)[1]] if "$ref" in node else {}
    return target | {key: value for key, value in node.items() if key != "$ref"}


def _part(path: str, part: dict[str, Any], schema: dict[str, Any]) -> list[str]:
    """A table for a part, then its nested parts."""
    lines = [
        f"## Fields of {path}\n",
        "| field | default | unit | range | limits | what it is |",
        "|---|---|---|---|---|---|",
    ]
    nested: list[str] = []
    for name, node in part["properties"].items():
        field = _resolve(node, schema)
        if "properties" in field:
            nested += _part(f"{path}.{name}", field, schema)
        else:
            lines.append(_field(f"{path}.{name}", field))
    return [*lines, "", *nested]


def _field(path: str, field: dict[str, Any]) -> str:
    number = next((option for option in field.get("anyOf", [field]) if "maximum" in option), field)
    if "prefixItems" in field:
        number = field["prefixItems"][0]
    soft, default = field.get("soft_range"), field.get("default", "required")
    limits = f"{_show(number['minimum'])} to {_show(number['maximum'])}" if "maximum" in number else ""
    if "enum" in field:
        limits = ", ".join(f"`{choice}`" for choice in field["enum"])
    between = f"{_show(soft[0])} to {_show(soft[1])}" if soft else ""
    return (
        f"| {_named(path)} | {_show(default)} | {field.get('unit', '')} | {between} | {limits} | "
        f"{field['title']}. {field.get('description', '')} |"
    )


def _show(value: Any) -> str:
    """Return a number without needless digits, a list and a boolean as JSON has them, null as none."""
    if value is None:
        return "none"
    if isinstance(value, bool):
        return str(value).lower()
    if isinstance(value, (list, tuple)):
        return "[" + ", ".join(_show(item) for item in value) + "]"
    return f"{value:.10g}" if isinstance(value, (int, float)) else str(value)


def _quantity(item: Entry) -> str:
    return f"| {_named(item.key)} | {item.label} | {item.unit} | {item.description} |"
