"""What there is to choose from, as the core declares it, and what may be refused; and half-cars from data sheets."""

from fastapi import Response

from backend.api.routing import router
from backend.json_types import JsonObject
from backend.library import answers
from backend.library.models import Catalogue, HalfCarAnswer, PresetAnswer, ProblemAnswer, StrategyAnswer, VehicleAnswer
from backend.models import Figures
from sim_core.comparison.vehicle_cautions import vehicle_facts
from sim_core.scenario.data_sheet import DataSheet

library = router("schema")
data_sheets = router("schema", 400, 413, 415)


def _answer(content: bytes) -> Response:
    return Response(content, headers={"Cache-Control": "no-cache"}, media_type="application/json")


@library.get("/schema", operation_id="getSchema", response_model=JsonObject)
async def get_schema() -> Response:
    """JSON Schema of the scenario: title, description, unit, default, hard limits and soft_range of each field."""
    return _answer(answers.schema())


@library.get("/presets", operation_id="getPresets", response_model=list[PresetAnswer])
async def get_presets() -> Response:
    """Named scenarios; the paper's first."""
    return _answer(answers.presets())


@library.get("/strategies", operation_id="getStrategies", response_model=list[StrategyAnswer])
async def get_strategies() -> Response:
    """Every strategy: what it does, what it reads, how it is drawn."""
    return _answer(answers.strategies())


@library.get("/catalogue", operation_id="getCatalogue", response_model=Catalogue)
async def get_catalogue() -> Response:
    """Signals, windows, statistics, stages, comfort, events, references: keys, labels and units."""
    return _answer(answers.catalogue())


@library.get("/figures", operation_id="getFigures", response_model=Figures)
async def get_figures() -> Response:
    """Figure templates in the order of display: layout, and a trace without data for each strategy."""
    return _answer(answers.figure_templates())


@library.get("/vehicles", operation_id="getVehicles", response_model=list[VehicleAnswer])
async def get_vehicles() -> Response:
    """Vehicles with their sources, as a scenario's `vehicle`."""
    return _answer(answers.vehicles())


@library.get("/problems", operation_id="getProblems", response_model=list[ProblemAnswer])
async def get_problems() -> Response:
    """Every kind of problem that the service answers with: what happened, and what to do about it."""
    return _answer(answers.problems())


@data_sheets.post("/vehicles/from-data-sheet", operation_id="makeHalfCar", response_model=HalfCarAnswer)
async def make_half_car(body: DataSheet) -> HalfCarAnswer:
    """The half-car of a whole car's data sheet: masses, axle loads, natural frequencies, damping ratios."""
    car = body.half_car()
    return HalfCarAnswer(vehicle=car, **vehicle_facts(car))
