"""Without a service: names and single runs come from the core in the command's own process, as a service has them."""

import json
import os
from pathlib import Path
from typing import NoReturn

import pytest

from ridelab import Ridelab
from ridelab.cli.in_process import InProcess
from ridelab.cli.names import OURS, Names
from ridelab.cli.options import completes
from ridelab.cli.reporting import InputError, UnavailableError
from ridelab.cli.service import Services
from sim_core import Scenario, simulate
from tests.client.cli import Cli


def no_service(*_: object) -> NoReturn:
    raise UnavailableError("none is installed")


@pytest.fixture
def alone(capfdbinary: pytest.CaptureFixture[bytes], monkeypatch: pytest.MonkeyPatch, tmp_path: Path) -> Cli:
    """The command in an empty folder, where no service is named and none can be started."""
    monkeypatch.chdir(tmp_path)
    for name in ("XDG_CACHE_HOME", "XDG_DATA_HOME"):
        monkeypatch.setenv(name, str(tmp_path))
    for name in ("RIDELAB_SERVER", "RIDELAB_DATA_DIR", "RIDELAB_CONTROLLERS"):
        monkeypatch.delenv(name, raising=False)
    monkeypatch.setattr(Services, "at", no_service)
    return Cli(capfdbinary)


@pytest.mark.parametrize("path", ["/schema", "/catalogue", "/presets", "/vehicles"])
def test_names_are_the_services(ridelab: Ridelab, path: str) -> None:
    assert json.loads(json.dumps(InProcess(no_service).get(path))) == ridelab.get(path)


def test_a_run_is_computed_and_nothing_is_left_behind(alone: Cli, tmp_path: Path) -> None:
    run = json.loads(alone("run", "bump_only", "--set", "road.bump.height=12cm", "--strategy", "passive,lv", "--json"))
    assert (run["id"], list(run["strategies"])) == (None, ["lv", "passive"])
    peak = run["strategies"]["lv"]["metrics"]["bump"]["body_acceleration"]["peak"]
    assert peak == simulate(Scenario.model_validate(run["scenario"]), "lv").metrics["bump"]["body_acceleration"]["peak"]
    assert run["cautions"] == run["comparison"]["cautions"]
    assert list(tmp_path.iterdir()) == []


def test_the_demonstration_is_a_run_that_needs_no_service(alone: Cli, tmp_path: Path) -> None:
    text, answer = alone("demo"), json.loads(alone("demo", "--json"))
    assert text.startswith("A car at 50 km/h, a bump 0.1 m high and 4 m long, computed here.\n")
    assert list(answer) == ["lv", "lqr", "passive"]
    peak = simulate(Scenario(), "lv").metrics["bump"]["body_acceleration"]["peak"]
    assert answer["lv"]["metrics"]["bump"]["body_acceleration"]["peak"] == peak
    assert f"{peak:.4g} (-85." in text
    assert list(tmp_path.iterdir()) == []


@pytest.mark.usefixtures("alone")
def test_controllers_of_a_package_are_driven_by_a_service(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    (tmp_path / "laws-1.dist-info").mkdir()
    (tmp_path / "laws-1.dist-info" / "entry_points.txt").write_text("[ridelab.controllers]\nmine = laws\n")
    monkeypatch.syspath_prepend(str(tmp_path))
    with pytest.raises(UnavailableError):
        _ = Services(None, None).quick


def test_a_run_has_the_members_of_a_services(ridelab: Ridelab) -> None:
    ours, theirs = (each.run({}, ["passive"]) for each in (InProcess(no_service), ridelab))
    assert ours.answer.keys() == theirs.answer.keys()
    assert ours["passive"].figures().keys() == theirs["passive"].figures().keys()


def test_the_core_refuses_by_itself_and_what_it_cannot_answer_goes_to_a_service() -> None:
    core = InProcess(no_service)
    with pytest.raises(InputError, match=r"road\.bump\.height: "):
        core.run({"road": {"bump": {"height": 9}}}, ["passive"])
    with pytest.raises(InputError, match="Unknown strategy"):
        core.run({}, ["lvv"])
    with pytest.raises(UnavailableError):
        core.run({}, ["passive"], roads=2)


def test_the_shell_completes_this_versions_names_before_any_service_was_asked(
    alone: Cli, ridelab: Ridelab, monkeypatch: pytest.MonkeyPatch, tmp_path: Path
) -> None:
    """UPDATE_DOCS=1 writes them."""
    names = Names.of(ridelab)
    kinds = {key: list(getattr(names, key)) for key in ("fields", "strategies", "presets", "metrics")}
    kinds["vehicles"] = list(ridelab.vehicles())
    if os.environ.get("UPDATE_DOCS"):
        OURS.write_text(json.dumps(kinds, indent=0) + "\n", "utf-8")
    assert json.loads(OURS.read_text("utf-8")) == kinds
    assert alone.error == ""
    assert completes("strategies")("lv,skyh") == ["lv,skyhook"]
    assert completes("fields", "=")("road.bump.hei") == ["road.bump.height=", "road.bump.height=VALUE"]
    assert completes("fields", "=")("vehicle=va") == ["vehicle=van", "vehicle=van_loaded"]
    assert list(tmp_path.iterdir()) == []
