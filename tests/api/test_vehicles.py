"""Vehicles over HTTP: their sources, and half-cars from data sheets."""

from dataclasses import asdict

import httpx

from backend.http.openapi import EXAMPLES
from backend.library.models import VehicleAnswer
from sim_core.scenario import characteristics
from sim_core.scenario.data_sheet import DataSheet
from sim_core.scenario.vehicles import VEHICLES

SHEET = EXAMPLES["DataSheet"]


def test_every_vehicle_has_sources_and_is_one_of_a_scenario(client: httpx.Client) -> None:
    answered = [VehicleAnswer.model_validate(each) for each in client.get("/api/v1/vehicles").json()]
    assert {each.id: each.vehicle for each in answered} == {name: each.vehicle for name, each in VEHICLES.items()}
    assert all(each.sources and each.derived for each in answered)


def test_a_data_sheet_is_a_half_car(client: httpx.Client) -> None:
    answer = client.post("/api/v1/vehicles/from-data-sheet", json=SHEET)
    half_car = DataSheet.model_validate(SHEET).half_car()
    assert answer.json() == {"vehicle": half_car.model_dump(), "characteristics": asdict(characteristics(half_car))}
