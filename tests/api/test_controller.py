"""The ECU's program over HTTP: `lv_hil` in runs and batches, its sources, its fit."""

import io
import zipfile
from typing import Any

import httpx
import psutil
import pytest

from backend.ecu.models import ControllerReport
from ridelab import Ridelab
from sim_core.scenario import Scenario
from tests.api.conftest import Service

SMALL: dict[str, Any] = {
    "road": {"length": 20, "bump": {"start": 10, "width": 3, "height": 0.05}},
    "speed": {"initial_speed_kmh": 50, "target_speed_kmh": 50},
    "mpc": {"prediction_horizon": 6, "control_horizon": 3},
}


def post(service: Service, path: str, scenario: dict[str, Any] | None = None) -> httpx.Response:
    return service.post(f"/api/v1/controller{path}", json={"scenario": scenario or SMALL})


def test_lv_hil_runs_the_program_in_a_process_of_its_own_which_is_gone_afterwards(service: Service) -> None:
    answer = service.run(["lv_hil", "lv"], SMALL)
    assert answer.status_code == 200
    entry = answer.json()["strategies"]["lv_hil"]
    assert entry["status"] == "ok"
    assert entry["events"]["ecu_held_commands"] == 0
    assert answer.json()["strategies"]["lv"]["events"]["ecu_held_commands"] is None
    names = [process.name() for process in psutil.Process().children(recursive=True)]
    assert not [name for name in names if name.startswith("ridelab_ecu")]


def test_the_archive_is_complete_and_the_same_every_time(service: Service) -> None:
    first = post(service, "")
    assert first.status_code == 200
    assert first.headers["content-type"] == "application/zip"
    assert first.headers["content-disposition"] == 'attachment; filename="ridelab-controller.zip"'
    with Ridelab(str(service.base_url)) as ridelab:
        assert ridelab.controller(SMALL) == first.content
    with zipfile.ZipFile(io.BytesIO(first.content)) as archive:
        names = {name.removeprefix("ridelab-controller/") for name in archive.namelist()}
        assert {"README.md", "Makefile", "ridelab_controller.c", "ridelab_tables.c", "host/ridelab_main.c"} <= names
        scenario = Scenario.model_validate_json(archive.read("ridelab-controller/scenario.json"))
    assert scenario == Scenario.model_validate(SMALL)


def test_the_drive_by_the_clock_is_withdrawn_and_says_what_to_use(service: Service) -> None:
    answer = post(service, "/realtime")
    assert (answer.status_code, answer.json()["type"]) == (410, "urn:problem-type:ridelab:withdrawn")
    assert "/api/v1/controller/report" in answer.json()["detail"]


def test_the_report_has_the_scenarios_own_controller_first(service: Service, monkeypatch: pytest.MonkeyPatch) -> None:
    answer = post(service, "/report")
    assert answer.status_code == 200
    ControllerReport.model_validate(answer.json(), strict=True)
    rows = answer.json()["rows"]
    assert (rows[0]["prediction_horizon"], rows[0]["control_horizon"], rows[0]["checked"]) == (6, 3, "all")
    assert rows[0]["fits"] is True
    assert len({(row["prediction_horizon"], row["checked"], row["iterations"]) for row in rows}) == len(rows)
    for row in rows:
        assert 0 < row["time"]["least"] <= row["time"]["most"]
        assert row["fits"] == (not row["reasons"])
    monkeypatch.setattr(service.services.workers, "call", None)
    assert post(service, "/report").json() == answer.json(), "it is not made again"
