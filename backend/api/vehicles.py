"""Vehicles with their sources, and half-cars from data sheets."""

from pydantic import Field

from backend.api import router
from backend.models import Answer
from sim_core.scenario import Vehicle
from sim_core.scenario.data_sheet import DataSheet
from sim_core.scenario.vehicles import VEHICLES

vehicles = router("schema")
data_sheets = router("schema", 400, 413, 415)


class VehicleAnswer(Answer):
    """A vehicle with its sources; one track of the car, as every half-car here."""

    id: str
    label: str
    description: str
    vehicle: Vehicle
    sources: list[str] = Field(description="Where its numbers are from")
    derived: list[str] = Field(description="How those follow that no source has")


class HalfCarAnswer(Answer):
    """The half-car that a data sheet makes."""

    vehicle: Vehicle


@vehicles.get("/vehicles", operation_id="getVehicles", response_model=list[VehicleAnswer])
async def get_vehicles() -> list[VehicleAnswer]:
    """Vehicles with their sources, as a scenario's `vehicle`."""
    return [VehicleAnswer.model_validate(preset) for preset in VEHICLES.values()]


@data_sheets.post("/vehicles/from-data-sheet", operation_id="makeHalfCar", response_model=HalfCarAnswer)
async def make_half_car(body: DataSheet) -> HalfCarAnswer:
    """The half-car of a whole car's data sheet: masses, axle loads, natural frequencies, damping ratios."""
    return HalfCarAnswer(vehicle=body.half_car())
