"""A service on a machine without a C compiler: what needs one says so, all else works, and no failure is stored."""

from collections.abc import Iterator
from pathlib import Path
from typing import Any

import httpx
import pytest

from backend import digest
from backend.ecu.build import NO_COMPILER, NO_CROSS_COMPILER
from backend.paper import models
from backend.settings import Settings
from backend.store import StoredResult, StoredRun
from sim_core import __version__ as CORE_VERSION
from sim_core.scenario import SCHEMA_VERSION, Scenario
from tests.api.cli import Cli
from tests.api.conftest import Service, serve
from tests.html import check, read
from tests.servers.compilers import Bare
from tests.servers.reproduction import store_in

SMALL: dict[str, Any] = {
    "road": {"length": 20, "bump": {"start": 10, "width": 3, "height": 0.05}},
    "speed": {"initial_speed_kmh": 50, "target_speed_kmh": 50},
    "mpc": {"prediction_horizon": 6, "control_horizon": 3},
}
SCENARIO = SMALL


# Where it is not there yet, it is computed before the compilers are gone.
pytestmark = pytest.mark.usefixtures("reproduction")


def serve_on(machine: Bare, data: Path) -> Iterator[Service]:
    """Whatever builds and drives is a process of its own, with that machine's environment."""
    with pytest.MonkeyPatch.context() as patch:
        for name, value in machine.environment.items():
            patch.setenv(name, value)
        yield from serve(Settings(data_dir=data, workers=1, batch_workers=1))


@pytest.fixture(scope="module")
def bare(tmp_path_factory: pytest.TempPathFactory) -> Iterator[Service]:
    machine = Bare(tmp_path_factory.mktemp("machine"))
    yield from serve_on(machine, tmp_path_factory.mktemp("data"))


@pytest.fixture
def command(bare: Service, capfdbinary: pytest.CaptureFixture[bytes], monkeypatch: pytest.MonkeyPatch) -> Cli:
    monkeypatch.setenv("RIDELAB_SERVER", str(bare.client.base_url))
    return Cli(capfdbinary)


def test_in_a_run_the_strategy_fails_with_the_remedy(bare: Service, command: Cli, scenario: Path) -> None:
    run = bare.run(["lv_hil", "passive"], SMALL).json()
    assert run["strategies"]["passive"]["status"] == "ok"
    assert {key: run["strategies"]["lv_hil"][key] for key in ("status", "reason")} == {
        "status": "failed",
        "reason": NO_COMPILER,
    }
    assert bare.client.get(f"/api/v1/runs/{run['id']}").json()["strategies"].keys() == run["strategies"].keys()
    again = bare.run(["lv_hil", "passive"], SMALL).json()["strategies"]
    assert (again["lv_hil"]["cached"], again["passive"]["cached"]) == (False, True), "a compiler may come"
    assert bare.live(["lv_hil"], SMALL, points=50).json()["strategies"]["lv_hil"]["reason"] == NO_COMPILER
    assert f"LV as ECU code  failed: {NO_COMPILER}\n" in command("run", scenario, code=1)


def test_a_run_whose_results_were_removed_waits_for_a_compiler(bare: Service) -> None:
    """The failure is no result of the run: who asks again, here or where a compiler is, gets another try."""
    store = bare.app.state.store
    scenario = Scenario.model_validate({**SMALL, "road": {**SMALL["road"], "seed": 5}})
    keys = {name: digest.result_key(scenario, name) for name in ("passive", "lv_hil")}
    expired = [
        StoredResult(key=key, strategy=name, status="expired", summary={}, compute_ms=0) for name, key in keys.items()
    ]
    run = StoredRun(
        id=digest.run_id(scenario, keys),
        core_version=CORE_VERSION,
        schema_version=SCHEMA_VERSION,
        scenario=scenario.model_dump(mode="json"),
        results=tuple(expired),
    )
    store.runs.save(run)
    answer = bare.client.get(f"/api/v1/runs/{run.id}")
    assert (answer.status_code, answer.json()["type"]) == (503, "urn:problem-type:ridelab:ecu-unavailable")
    assert answer.json()["detail"] == f"{NO_COMPILER}."
    assert store.runs.load(run.id).results == run.results
    again = bare.run(["lv_hil", "passive"], scenario.model_dump(mode="json")).json()
    assert again["id"] != run.id, "tried again, and failed again"


@pytest.mark.parametrize(
    ("path", "arguments", "sentence"),
    [
        ("/report", ("controller", "--report"), NO_CROSS_COMPILER),
        ("/realtime", ("hil",), NO_COMPILER),
    ],
    ids=["report", "clock"],
)
def test_what_is_measured_is_refused_at_once(
    bare: Service, command: Cli, scenario: Path, path: str, arguments: tuple[str, ...], sentence: str
) -> None:
    """Nobody is asked to wait: the client would, and then ask again for nothing."""
    answer = bare.client.post(f"/api/v1/controller{path}", json={"scenario": SMALL})
    problem = answer.json()
    assert (answer.status_code, problem["type"]) == (503, "urn:problem-type:ridelab:ecu-unavailable")
    assert problem["detail"] == f"{sentence}."
    assert "retry-after" not in answer.headers
    name, *options = arguments
    assert not command(name, scenario, *options, code=3)
    assert f"{sentence}. (request " in command.error


@pytest.fixture(scope="module")
def simulated(bare: Service) -> None:
    """The results of the paper page's five simulated strategies are stored."""
    store_in(bare.app.state.store, ecu=False)


def paper(service: Service, path: str = "", **query: str) -> httpx.Response:
    answer = service.client.get(f"/api/v1/paper{path}", params=query)
    assert answer.status_code == 200, answer.text
    return answer


def by_verdict(cells: list[dict[str, Any]]) -> dict[str, int]:
    verdicts = [cell["verdict"] for cell in cells]
    return {verdict: verdicts.count(verdict) for verdict in verdicts}


@pytest.mark.usefixtures("simulated")
def test_of_the_paper_the_simulated_cells_stand(bare: Service, command: Cli) -> None:
    answer = paper(bare).json()
    models.PaperAnswer.model_validate(answer)
    missing = [cell for cell in answer["cells"] if cell["verdict"] == "unavailable"]
    assert answer["unavailable"] == {"cells": len(missing), "reason": NO_COMPILER}
    assert {(cell["table"], cell["strategy"]) for cell in missing} == {(9, "lv_hil"), (10, "lv_hil")}
    assert (len(answer["cells"]), len(missing), answer["total"]) == (48, 8, 40)
    for cell in missing:
        assert cell["our_value"] is cell["our_change"] is cell["ci"] is cell["certain"] is None
        assert cell["our_base"] > 0
        assert cell["without_preview"]["verdict"] == "unavailable"
    assert answer["counts"] | {"unavailable": 8} == by_verdict(answer["cells"])
    assert sum(answer["without_preview"]["counts"].values()) == 40
    lines = command("paper").splitlines()
    assert sum("not available" in line for line in lines[1:49]) == 8
    assert f"8 cells not available here. {NO_COMPILER}" in lines
    assert lines[-1].startswith(f"{answer['reached']} of 40 cells reached")


@pytest.mark.usefixtures("simulated")
def test_so_do_the_figures_and_the_report(bare: Service) -> None:
    for figure in paper(bare, "/figures").json()["figures"]:
        assert (f"LV as ECU code is not available here. {NO_COMPILER}." in figure["caption"]) == (figure["number"] > 18)
    page = read(paper(bare, "/report.html").text)
    check(page)
    assert next(page.all("h1")).text.endswith(" of 40 cells reached, 8 not available here")
    assert f"not counted. {NO_COMPILER}." in page.text
    judged = [row for row in page.all("tr") if row.attributes.get("data-verdict") == "unavailable"]
    assert [row.text.count("not available") for row in judged] == [2] * 8
