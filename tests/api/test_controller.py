"""The ECU's program over HTTP: `lv_hil` in runs and batches, its sources, its fit, a drive by the clock."""

import asyncio
import io
import threading
import time
import zipfile
from concurrent.futures import ThreadPoolExecutor
from dataclasses import dataclass
from typing import Any

import httpx
import psutil
import pytest

from backend.ecu.models import ControllerReport, RealtimeReport
from backend.ecu.realtime import drive_by_clock
from ridelab import Ridelab
from sim_core.scenario import Scenario
from tests.api.conftest import Service
from tests.servers.process import HANG_TIMEOUT

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


@dataclass(frozen=True)
class Driven:
    """A drive by the clock: its report, how long it took [s], and the answer to who asked for a report meanwhile."""

    report: dict[str, Any]
    seconds: float
    meanwhile: httpx.Response


@pytest.fixture(scope="module")
def driven(service: Service) -> Driven:
    workers, begun, may_drive = service.services.workers, threading.Event(), threading.Event()
    original = workers.call

    async def held(function: Any, *arguments: Any, **options: Any) -> Any:
        if function is drive_by_clock:
            begun.set()
            await asyncio.to_thread(may_drive.wait)
        return await original(function, *arguments, **options)

    with (
        pytest.MonkeyPatch.context() as patch,
        ThreadPoolExecutor(1) as thread,
        Ridelab(str(service.base_url)) as ridelab,
    ):
        patch.setattr(workers, "call", held)
        drive = thread.submit(ridelab.realtime, SMALL)
        assert begun.wait(HANG_TIMEOUT)
        meanwhile, begin = post(service, "/report"), time.monotonic()
        may_drive.set()
        return Driven(report=drive.result(), seconds=time.monotonic() - begin, meanwhile=meanwhile)


def test_a_drive_by_the_clock_takes_as_long_as_the_drive(driven: Driven) -> None:
    report = driven.report
    RealtimeReport.model_validate(report, strict=True)
    assert driven.seconds > report["steps"] * report["deadline"]
    assert report["steps"] > 150
    in_time = sum(report["latency"]["counts"]) if report["latency"] else 0
    assert in_time + report["misses"] == report["steps"] == sum(report["wake_up"]["counts"])


def test_one_at_a_time(driven: Driven) -> None:
    assert driven.meanwhile.status_code == 429
    assert int(driven.meanwhile.headers["retry-after"]) > 0


@pytest.mark.usefixtures("driven")
def test_the_report_has_the_scenarios_own_controller_first(service: Service, monkeypatch: pytest.MonkeyPatch) -> None:
    answer = post(service, "/report")
    assert answer.status_code == 200, "the drive has ended"
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


def test_a_drive_that_would_take_too_long_is_refused(service: Service) -> None:
    answer = post(service, "/realtime", {"road": {"length": 1500}})
    assert answer.status_code == 422
    assert "at most 60 s" in answer.json()["detail"]
