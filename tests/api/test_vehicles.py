"""Vehicles over HTTP: their sources, and half-cars from data sheets."""

from dataclasses import asdict
from typing import Any

import httpx

from backend.http.openapi import EXAMPLES
from backend.library.models import VehicleAnswer
from sim_core.scenario import characteristics
from sim_core.scenario.data_sheet import DataSheet
from sim_core.scenario.vehicles import VEHICLES
from tests.api.conftest import ROAD

SHEET = EXAMPLES["DataSheet"]


def test_every_vehicle_has_sources_and_is_one_of_a_scenario(client: httpx.Client) -> None:
    answered = [VehicleAnswer.model_validate(each) for each in client.get("/api/v1/vehicles").json()]
    assert {each.id: each.vehicle for each in answered} == {name: each.vehicle for name, each in VEHICLES.items()}
    assert all(each.sources and each.derived for each in answered)


def test_a_data_sheet_is_a_half_car(client: httpx.Client) -> None:
    answer = client.post("/api/v1/vehicles/from-data-sheet", json=SHEET)
    half_car = DataSheet.model_validate(SHEET).half_car()
    assert answer.json() == {
        "vehicle": half_car.model_dump(),
        "characteristics": asdict(characteristics(half_car)),
        "cautions": [],
    }


def test_a_car_that_is_hardly_one_is_cautioned_in_every_answer(client: httpx.Client, run: dict[str, Any]) -> None:
    heavy = {"scenario": {"vehicle": {"body_mass": 2400}, "road": ROAD}, "strategies": ["passive"]}
    created = client.post("/api/v1/runs", json=heavy).json()
    live = client.post("/api/v1/live", json=heavy).json()
    again = client.get(f"/api/v1/runs/{created['id']}").json()
    assert [each["field"] for each in created["cautions"]] == ["vehicle.body_mass"]
    assert "568 mm at the front axle" in created["cautions"][0]["text"]
    assert created["cautions"] == live["cautions"] == again["cautions"]
    assert [(each["kind"], each["field"]) for each in run["cautions"]] == [("paper_sag", "vehicle.front_spring")]
    flat = client.post("/api/v1/vehicles/from-data-sheet", json={**SHEET, "front_frequency": 0.4}).json()
    assert [each["kind"] for each in flat["cautions"]] == ["sag", "body_frequency"]
