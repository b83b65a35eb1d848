"""The answers about what there is to choose from, as JSON; those about strategies change with files of one's own."""

import dataclasses
from collections.abc import Mapping
from functools import cache

import orjson

from backend.custom_controllers import registry as custom_controllers
from backend.http.problem_types import KINDS
from backend.json_types import JsonObject
from backend.runs import figures
from sim_core import library
from sim_core.comparison.variation import one_road_resolution
from sim_core.scenario import dotted
from sim_core.strategies import reads
from sim_core.strategies import strategies as known_strategies
from sim_core.strategies.effects import conditional_reads


def schema() -> bytes:
    """Return the JSON Schema of the scenario with the options of custom controllers, and its version.

    Beside it stands the schema of a data sheet, which `POST /vehicles/from-data-sheet` takes.
    """
    plain = _plain_schema()
    parts = {f"{dotted.OWN}{each.id}": each for each in custom_controllers.descriptions() if each.options}
    options = {
        "properties": {each.id: {"$ref": f"#/$defs/{name}", "title": each.label} for name, each in parts.items()}
    }
    of_each = {name: {"description": each.text, **_options(each.options)} for name, each in parts.items()}
    definitions = {**plain["$defs"], **of_each, "Own": {**plain["$defs"]["Own"], **options}}
    return orjson.dumps({**plain, "$defs": definitions})


@cache
def _plain_schema() -> JsonObject:
    return library.schema()


@cache
def presets() -> bytes:
    """Return every preset, the paper's first."""
    return orjson.dumps(library.presets())


@cache
def vehicles() -> bytes:
    """Return every vehicle with its sources."""
    return orjson.dumps(library.vehicles())


def strategies() -> bytes:
    """Return every strategy."""
    return orjson.dumps(
        [
            {
                "id": strategy.id,
                "label": strategy.label,
                "description": strategy.description(),
                "reads": reads(strategy),
                "reads_when": conditional_reads(strategy),
                "one_road_resolution": one_road_resolution(strategy.id),
                **dataclasses.asdict(figures.style_of(strategy.id)),
                **_origin(strategy.id),
            }
            for strategy in known_strategies().values()
        ]
    )


def _origin(name: str) -> JsonObject:
    """Return what is said of a custom controller beside what is said of every strategy."""
    origin = custom_controllers.origin(name)
    if origin is None:
        return {"own": False, "source": None, "options": _options({}), "fault": None}
    controller_source, description = origin
    return {
        "own": True,
        "source": custom_controllers.source(name),
        "options": _options(description.options),
        "fault": controller_source.fault,
    }


def _options(options: Mapping[str, JsonObject]) -> JsonObject:
    return {"type": "object", "properties": dict(options), "additionalProperties": False}


@cache
def problems() -> bytes:
    """Return every kind of problem, by status."""
    return orjson.dumps(list(KINDS.values()))


@cache
def catalogue() -> bytes:
    """Return the core's catalogue."""
    return orjson.dumps(library.catalogue())


def figure_templates() -> bytes:
    """Return every figure without data, in the order of display."""
    return orjson.dumps({"figures": figures.templates()})


def warm() -> None:
    """Build every answer, so that the first request finds it."""
    for make in (schema, presets, vehicles, strategies, problems, catalogue, figure_templates):
        make()
