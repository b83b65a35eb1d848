"""Vehicles over HTTP, by the client and at the command line: their sources, files, data sheets."""

import json
from pathlib import Path

import httpx

from backend.api.vehicles import VehicleAnswer
from backend.http.openapi import EXAMPLES
from ridelab import Ridelab
from sim_core.scenario.data_sheet import DataSheet
from sim_core.scenario.vehicles import VEHICLES
from tests.api.cli import Cli

SHEET = EXAMPLES["DataSheet"]


def test_every_vehicle_has_sources_and_is_one_of_a_scenario(client: httpx.Client) -> None:
    answered = [VehicleAnswer.model_validate(each) for each in client.get("/api/v1/vehicles").json()]
    assert {each.id: each.vehicle for each in answered} == {name: each.vehicle for name, each in VEHICLES.items()}
    assert all(each.sources and each.derived for each in answered)


def test_a_data_sheet_is_a_half_car_and_a_bad_one_names_its_field(client: httpx.Client) -> None:
    answer = client.post("/api/v1/vehicles/from-data-sheet", json=SHEET)
    assert answer.json() == {"vehicle": DataSheet.model_validate(SHEET).half_car().model_dump()}
    for change, pointer in (
        ({"front_axle_load": 60}, "/front_axle_load"),
        ({"rear_frequency": 9}, "/rear_frequency"),
        ({"wheelbase": None}, "/wheelbase"),
        ({"colour": 1}, "/colour"),
    ):
        refused = client.post("/api/v1/vehicles/from-data-sheet", json={**SHEET, **change})
        assert refused.status_code == 422, change
        assert [place["pointer"] for place in refused.json()["errors"]] == [pointer]


def test_a_vehicle_file_goes_round(cli: Cli, client: httpx.Client, tmp_path: Path) -> None:
    van, own, run = tmp_path / "van.json", tmp_path / "own.json", tmp_path / "run.json"
    cli("vehicle", "van", "--out", van)
    assert json.loads(van.read_text())["sources"] == list(VEHICLES["van"].sources)
    by_name, by_file = (
        json.loads(cli("run", "paper", "-s", "passive", "--set", f"vehicle={which}", "--json"))
        for which in ("van", van)
    )
    assert by_name["id"] == by_file["id"]
    assert by_name["scenario"]["vehicle"] == VEHICLES["van"].vehicle.model_dump()
    run.write_text(json.dumps(by_name))
    changed = cli("run", "paper", "-s", "passive", "--set", "vehicle.cg_height=1", "--set", f"vehicle={run}", "--json")
    assert json.loads(changed)["scenario"]["vehicle"] == {**VEHICLES["van"].vehicle.model_dump(), "cg_height": 1}

    (tmp_path / "sheet.json").write_text(json.dumps(SHEET))
    cli("vehicle", "--sheet", tmp_path / "sheet.json", "--out", own)
    with Ridelab(str(client.base_url)) as ridelab:
        assert json.loads(own.read_text())["vehicle"] == ridelab.half_car(SHEET)
        assert list(ridelab.vehicles()) == list(VEHICLES)


def test_what_is_no_vehicle_is_said(cli: Cli, tmp_path: Path) -> None:
    (tmp_path / "empty.json").write_text("{}")
    for words, said in (
        (
            ("run", "paper", "--set", "vehicle=vann"),
            "vehicle: vann is neither a file nor a vehicle (small_car, sedan,",
        ),
        (
            ("run", "paper", "--set", f"vehicle={tmp_path / 'empty.json'}"),
            "empty.json: this file has no member vehicle",
        ),
        (("vehicle", "--out", "a.json"), "--out needs a VEHICLE or --sheet FILE"),
        (("vehicle", "--sheet", tmp_path / "empty.json"), "front_axle_load: Field required"),
    ):
        cli(*words, code=2)
        assert said in cli.error
