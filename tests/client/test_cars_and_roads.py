"""Vehicle files, measured roads and the library's files, by the command."""

import json
from pathlib import Path

import pytest

from backend.http.openapi import EXAMPLES
from sim_core.comparison.vehicle_cautions import vehicle_cautions
from sim_core.scenario import Scenario, Vehicle
from sim_core.scenario.vehicles import VEHICLES
from tests.client.cli import Cli
from tests.client.conftest import RUN, Prepared


def test_a_vehicle_file_goes_round(cli: Cli, tmp_path: Path) -> None:
    van, own, run = tmp_path / "van.json", tmp_path / "own.json", tmp_path / "run.json"
    cli("vehicle", "van", "--out", van)
    assert json.loads(van.read_text())["sources"] == list(VEHICLES["van"].sources)
    by_name, by_file = (json.loads(cli("run", "--set", f"vehicle={which}", "--json")) for which in ("van", van))
    assert by_name["scenario"] == by_file["scenario"]
    assert by_name["scenario"]["vehicle"] == VEHICLES["van"].vehicle.model_dump()
    run.write_text(json.dumps(by_name))
    changed = cli("run", "--set", "vehicle.cg_height=1", "--set", f"vehicle={run}", "--json")
    assert json.loads(changed)["scenario"]["vehicle"] == {**VEHICLES["van"].vehicle.model_dump(), "cg_height": 1}
    (tmp_path / "sheet.json").write_text(json.dumps(EXAMPLES["DataSheet"]))
    cli("vehicle", "--sheet", tmp_path / "sheet.json", "--out", own)
    assert json.loads(own.read_text())["data_sheet"] == EXAMPLES["DataSheet"]


@pytest.mark.parametrize("mass", [2400, 1270])
def test_a_car_that_is_hardly_one_is_cautioned(cli: Cli, tmp_path: Path, mass: float) -> None:
    """The paper's own sag stands beside its vehicle, and not under each run of its scenario."""
    file = tmp_path / "car.json"
    file.write_text(json.dumps({"vehicle": {"body_mass": mass}}))
    said = [each.text for each in vehicle_cautions(Vehicle(body_mass=mass))]
    assert said
    assert all(f"Caution: {text}\n" in cli("vehicle", file) for text in said)
    run = cli("run", "--set", f"vehicle={file}", "-s", "passive")
    assert all((f"Caution: {text}\n" in run) == (mass == 2400) for text in said)


@pytest.mark.parametrize(
    ("length", "bump", "driven"),
    [
        (5, None, {"start": 5}),
        (2500, {"start": 2300.004, "width": 3.1, "height": 0.08}, {"start": 2300, "width": 3.1}),
        (60, {"start": 59, "width": 3, "height": 0.08}, {"start": 59, "width": 1}),
    ],
)
def test_the_scenario_of_a_road_can_be_driven(
    cli: Cli, prepared: Prepared, length: float, bump: dict[str, float] | None, driven: dict[str, float]
) -> None:
    prepared.answers[f"GET /roads/{RUN}"] = {"id": RUN, "length": length, "bumps": [bump] if bump else []}
    scenario = json.loads(cli("road", RUN, "--out", "-"))
    assert scenario == {"road": {"profile": RUN, "length": length, "bump": {"height": 0, **driven}}}
    assert Scenario.model_validate(scenario).road.has_bump == (bump is not None)


def test_a_measured_road_that_is_chosen_has_no_bump_of_height_0_where_none_was_placed(
    cli: Cli, prepared: Prepared
) -> None:
    cli("run", "paper", "--set", f"road.profile={RUN}", "--set", "road.bump.height=0", "-s", "passive")
    cli("run", "paper", "--set", f"road.profile={RUN}", "--set", "road.bump.height=0", "--set", "road.bump.start=40")
    unplaced, placed = (sent["scenario"]["road"]["bump"] for sent in prepared.bodies("POST /runs"))
    assert ("start" in unplaced, placed["start"]) == (False, 40)


def test_a_road_without_a_class_has_its_index_and_the_reason(cli: Cli, prepared: Prepared) -> None:
    measures = {
        "iri": {"tracks": [10.9], "mean": 10.9},
        "iso_class": None,
        "roughness": {"value": 1e-6, "low": 1e-8, "high": 1e-4},
        "waviness": {"value": 2, "low": -0.1, "high": 4.5},
    }
    text = "No ISO 8608 class: the road's spectrum is not a straight line"
    cautions = [{"kind": "spectrum", "text": text, "field": "road.profile", "strategy": None}]
    road = {"id": RUN, "length": 50, "bumps": [], "warnings": [], "cautions": cautions, **measures}
    prepared.answers[f"GET /roads/{RUN}"] = road
    said = cli("road", RUN)
    assert "IRI 10.90 m/km" in said
    assert f"Caution: {text}" in said
    assert "ISO 8608 class " not in said.replace(text, ""), "no class"


def test_a_librarys_file_is_driven_with_its_road(cli: Cli, prepared: Prepared, tmp_path: Path) -> None:
    """Where the scenario names a road that the service does not have, the file's own is sent to it."""
    prepared.answers["POST /roads"] = {"id": RUN}
    file = tmp_path / "street.json"
    there = {"road": {"profile": "A" * 22}, "estimation": {"kind": "kalman"}}
    file.write_text(json.dumps({"schema_version": 1, "label": "Street", "scenario": there, "measured_road": "a,b"}))
    cli("run", file, "-s", "passive")
    assert prepared.bodies("POST /roads") == [b"a,b"]
    (sent,) = prepared.bodies("POST /runs")
    assert sent["scenario"]["road"]["profile"] == RUN
    assert sent["scenario"]["estimation"] == {"kind": "kalman", "knows_preview": False}, "a file of core 0.3.0"
    file.write_text(json.dumps({"schema_version": 99, "scenario": there}))
    cli("run", file, "-s", "passive", code=2)
    assert "street.json: its schema version is 99" in cli.error
