"""A service on a machine without a C compiler does everything: nothing is compiled while it serves.

Nor did hardware in the loop drive the paper's roads there: its eight cells are not counted, the others stand.
"""

import json
import os
from collections.abc import Iterator
from pathlib import Path
from typing import Any

import httpx
import pytest

from backend.paper import models
from backend.store import Store
from tests.client.cli import Cli
from tests.html import check, read
from tests.servers.process import HANG_TIMEOUT, Api
from tests.servers.reproduction import store_without_ecu

REASON = "Nobody drove there"
pytestmark = pytest.mark.thorough  # a service of its own
SCENARIO: dict[str, Any] = {
    "road": {"length": 20, "bump": {"start": 10, "width": 3, "height": 0.05}},
    "speed": {"initial_speed_kmh": 50, "target_speed_kmh": 50},
    "mpc": {"prediction_horizon": 6, "control_horizon": 3},
}


@pytest.fixture(scope="module")
def bare(tmp_path_factory: pytest.TempPathFactory) -> Iterator[httpx.Client]:
    """Asks a service that is a process of its own: those that build and drive have that machine's environment."""
    folder = tmp_path_factory.mktemp("service")
    (folder / "data").mkdir()
    store = Store(f"sqlite:///{folder}/data/ridelab.sqlite")
    store.migrate()
    store_without_ecu(store, REASON)
    store.close()
    machine = tmp_path_factory.mktemp("machine")
    (machine / "sitecustomize.py").write_text('import sys\n\nsys.modules["ziglang"] = None\n')
    paths = [str(machine), *filter(None, [os.environ.get("PYTHONPATH")])]
    nothing = {"PATH": str(machine), "PYTHONPATH": os.pathsep.join(paths)}
    with Api(folder, RIDELAB_WORKERS="1", RIDELAB_BATCH_WORKERS="1", **nothing) as api:
        api.wait_until_ready()
        with httpx.Client(base_url=api.url, timeout=HANG_TIMEOUT) as client:
            yield client


@pytest.fixture
def command(bare: httpx.Client, capfdbinary: pytest.CaptureFixture[bytes], monkeypatch: pytest.MonkeyPatch) -> Cli:
    monkeypatch.setenv("RIDELAB_SERVER", str(bare.base_url))
    return Cli(capfdbinary)


def test_runs_the_report_and_fmus_need_none(bare: httpx.Client, command: Cli, tmp_path: Path) -> None:
    run = bare.post("/api/v1/runs", json={"scenario": SCENARIO, "strategies": ["lv_hil", "passive"]}).json()
    assert {name: each["status"] for name, each in run["strategies"].items()} == {"lv_hil": "ok", "passive": "ok"}
    assert bare.get("/api/v1/controller/compilers").raise_for_status().json() == {"report": None}
    scenario = tmp_path / "scenario.json"
    scenario.write_text(json.dumps(SCENARIO))
    assert "STM32F103" in command("controller", scenario, "--report")
    for kind in (["--vehicle"], ["--strategy", "lv"], ["--strategy", "lqr"]):
        command("fmu", scenario, *kind, "--platform", "linux64", "--out", tmp_path / "it.fmu")
        assert command.error == "Binaries for linux64\n"


def test_of_the_paper_the_simulated_cells_stand(bare: httpx.Client, command: Cli) -> None:
    answer = bare.get("/api/v1/paper").raise_for_status().json()
    models.PaperAnswer.model_validate(answer)
    missing = [cell for cell in answer["cells"] if cell["verdict"] == "unavailable"]
    assert answer["unavailable"] == {"cells": len(missing), "reason": REASON}
    assert {(cell["table"], cell["strategy"]) for cell in missing} == {(9, "lv_hil"), (10, "lv_hil")}
    assert (len(answer["cells"]), len(missing), answer["total"]) == (48, 8, 40)
    for cell in missing:
        assert cell["our_value"] is cell["our_change"] is cell["ci"] is cell["certain"] is None
        assert cell["our_base"] > 0
        assert cell["without_preview"]["verdict"] == "unavailable"
    assert sum(answer["counts"].values()) == sum(answer["without_preview"]["counts"].values()) == 40
    lines = command("paper").splitlines()
    assert sum("not available" in line for line in lines[1:49]) == 8
    assert f"8 cells not available here. {REASON}" in lines
    assert lines[-1].startswith(f"{answer['reached']} of 40 cells reached")

    page = read(bare.get("/api/v1/paper/report.html").raise_for_status().text)
    check(page)
    assert next(page.all("h1")).text.endswith(" of 40 cells reached, 8 not available here")
    assert f"not counted. {REASON}." in page.text
    judged = [row for row in page.all("tr") if row.attributes.get("data-verdict") == "unavailable"]
    assert [row.text.count("not available") for row in judged] == [2] * 8
