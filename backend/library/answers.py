"""The answers about what there is to choose from, as JSON; those about strategies change with files of one's own."""

import dataclasses
from collections.abc import Mapping
from functools import cache
from typing import Any

import orjson
from pydantic import BaseModel

from backend import custom_controllers
from backend.http.kinds import KINDS
from backend.json_types import JsonObject
from backend.library.models import (
    Catalogue,
    ConditionalReadsAnswer,
    PresetAnswer,
    ProblemAnswer,
    StrategyAnswer,
    VehicleAnswer,
)
from backend.runs import figures
from sim_core import catalogue as core
from sim_core.comparison.variation import one_road_resolution
from sim_core.comparison.vehicle_facts import vehicle_facts
from sim_core.scenario import SCHEMA_VERSION, Scenario, dotted
from sim_core.scenario.data_sheet import DataSheet
from sim_core.scenario.presets import PRESETS
from sim_core.scenario.vehicles import VEHICLES, VehiclePreset
from sim_core.strategies import reads
from sim_core.strategies import strategies as known_strategies
from sim_core.strategies.effects import conditional_reads


def schema() -> bytes:
    """JSON Schema of the scenario, with the options of controllers of one's own that there are, and its version.

    Beside it stands the schema of a data sheet, which `POST /vehicles/from-data-sheet` takes.
    """
    plain = _scenario_schema()
    parts = {f"{dotted.OWN}{each.id}": each for each in custom_controllers.descriptions() if each.options}
    options = {
        "properties": {each.id: {"$ref": f"#/$defs/{name}", "title": each.label} for name, each in parts.items()}
    }
    of_each = {name: {"description": each.text, **_options(each.options)} for name, each in parts.items()}
    definitions = {**plain["$defs"], **of_each, "Own": {**plain["$defs"]["Own"], **options}}
    beside = {"schema_version": SCHEMA_VERSION, "data_sheet": DataSheet.model_json_schema()}
    return orjson.dumps({**plain, "$defs": definitions, **beside})


@cache
def _scenario_schema() -> JsonObject:
    return Scenario.model_json_schema()


@cache
def presets() -> bytes:
    """Every preset, the paper's first."""
    return _json([PresetAnswer.model_validate(preset) for preset in PRESETS.values()])


@cache
def vehicles() -> bytes:
    """Every vehicle with its sources."""
    return _json([_vehicle(preset) for preset in VEHICLES.values()])


def _vehicle(preset: VehiclePreset) -> VehicleAnswer:
    own = {name: getattr(preset, name) for name in ("id", "label", "description", "vehicle", "sources", "derived")}
    return VehicleAnswer(**own, **vehicle_facts(preset.vehicle))


def strategies() -> bytes:
    """Every strategy."""
    return _json(
        [
            StrategyAnswer(
                id=strategy.id,
                label=strategy.label,
                description=strategy.description(),
                reads=reads(strategy),
                reads_when=[ConditionalReadsAnswer.model_validate(each) for each in conditional_reads(strategy)],
                one_road_resolution=one_road_resolution(strategy.id),
                **dataclasses.asdict(figures.style_of(strategy.id)),
                **_origin(strategy.id),
            )
            for strategy in known_strategies().values()
        ]
    )


def _origin(name: str) -> JsonObject:
    """What is said of a controller of one's own beside what is said of every strategy."""
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
    """Every kind of problem, by status."""
    return _json([ProblemAnswer(**dataclasses.asdict(kind)) for kind in KINDS.values()])


@cache
def catalogue() -> bytes:
    """The core's catalogue."""
    lists = {name: getattr(core, name.upper()) for name in Catalogue.model_fields}
    plain = {name: list(items.values()) if isinstance(items, dict) else items for name, items in lists.items()}
    return _json(Catalogue(**plain))


def figure_templates() -> bytes:
    """Every figure without data, in the order of display."""
    return orjson.dumps({"figures": figures.templates()})


def warm() -> None:
    """Build every answer, so that the first request finds it."""
    for make in (schema, presets, vehicles, strategies, problems, catalogue, figure_templates):
        make()


def _json(content: BaseModel | list[Any]) -> bytes:
    return orjson.dumps(content, default=lambda model: model.model_dump(mode="json"))
