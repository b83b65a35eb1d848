"""What the core declares: the scenario's schema, presets, strategies, signals, figure templates."""

import dataclasses
from functools import cache
from typing import Any

import orjson
from fastapi import Response
from pydantic import BaseModel, Field

from backend.api import router
from backend.json_types import JsonObject
from backend.means_over_roads import one_road_resolution
from backend.models import Answer, Figures
from backend.runs import figures
from sim_core import catalogue
from sim_core.scenario import SCHEMA_VERSION, Scenario
from sim_core.scenario.presets import PRESETS
from sim_core.strategies import STRATEGIES, reads

schema = router("schema")


class PresetAnswer(Answer):
    """A named scenario."""

    id: str
    label: str
    description: str
    scenario: Scenario


class StrategyAnswer(Answer):
    """A strategy: what it does, which parts of the scenario it reads, how it is drawn."""

    id: str
    label: str
    description: str
    reads: list[str]
    colour: str
    dark_colour: str = Field(description="On a dark background")
    dash: str
    one_road_resolution: dict[str, float] = Field(
        description="Smaller changes [%] on one road may be luck; by statistic, comfort figures as an RMS. Of two "
        "strategies the larger one counts"
    )


class QuantityAnswer(Answer):
    """One named quantity; unit `1` for none."""

    key: str
    label: str
    unit: str
    symbol: str
    description: str
    notable: float = Field(description="From this size on an event is worth a warning; 0 for what warns of nothing")


class Catalogue(Answer):
    """Everything that has a name and a unit."""

    signals: list[QuantityAnswer]
    metric_signals: list[str]
    paper_signals: list[str]
    windows: list[QuantityAnswer]
    statistics: list[QuantityAnswer]
    stages: list[QuantityAnswer]
    comfort: list[QuantityAnswer]
    events: list[QuantityAnswer]
    run_figures: list[QuantityAnswer]
    references: list[QuantityAnswer]


@cache
def _schema() -> bytes:
    return orjson.dumps({**Scenario.model_json_schema(), "schema_version": SCHEMA_VERSION})


@cache
def _presets() -> bytes:
    return _json([PresetAnswer.model_validate(preset) for preset in PRESETS.values()])


@cache
def _strategies() -> bytes:
    return _json(
        [
            StrategyAnswer(
                id=strategy.id,
                label=strategy.label,
                description=strategy.description(),
                reads=reads(strategy),
                one_road_resolution=one_road_resolution(strategy.id),
                **dataclasses.asdict(figures.STYLES[strategy.id]),
            )
            for strategy in STRATEGIES.values()
        ]
    )


@cache
def _catalogue() -> bytes:
    lists = {name: getattr(catalogue, name.upper()) for name in Catalogue.model_fields}
    plain = {name: list(items.values()) if isinstance(items, dict) else items for name, items in lists.items()}
    return _json(Catalogue(**plain))


@cache
def _templates() -> bytes:
    return orjson.dumps({"figures": figures.templates()})


def _json(content: BaseModel | list[Any]) -> bytes:
    return orjson.dumps(content, default=lambda model: model.model_dump(mode="json"))


def _answer(content: bytes) -> Response:
    return Response(content, headers={"Cache-Control": "no-cache"}, media_type="application/json")


def warm() -> None:
    """Build every answer of this module once; they do not change while the service runs."""
    for make in (_schema, _presets, _strategies, _catalogue, _templates):
        make()


@schema.get("/schema", operation_id="getSchema", response_model=JsonObject)
async def get_schema() -> Response:
    """JSON Schema of the scenario: title, description, unit, default, hard limits and soft_range of each field."""
    return _answer(_schema())


@schema.get("/presets", operation_id="getPresets", response_model=list[PresetAnswer])
async def get_presets() -> Response:
    """Named scenarios; the paper's first."""
    return _answer(_presets())


@schema.get("/strategies", operation_id="getStrategies", response_model=list[StrategyAnswer])
async def get_strategies() -> Response:
    """Every strategy: what it does, what it reads, how it is drawn."""
    return _answer(_strategies())


@schema.get("/catalogue", operation_id="getCatalogue", response_model=Catalogue)
async def get_catalogue() -> Response:
    """Signals, windows, statistics, stages, comfort, events, references: keys, labels and units."""
    return _answer(_catalogue())


@schema.get("/figures", operation_id="getFigures", response_model=Figures)
async def get_figures() -> Response:
    """Figure templates in the order of display: layout, and a trace without data for each strategy."""
    return _answer(_templates())
