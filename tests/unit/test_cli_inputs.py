"""What is typed on the command line, and what differs between two runs; no service needed."""

import json
import math
import subprocess
import sys
from pathlib import Path
from typing import Any

import pytest

from backend.cli import app, fields
from backend.cli.differences import Tolerance, differences, inputs
from backend.cli.options import listed
from backend.cli.reporting import InputError
from backend.cli.services import Services
from backend.cli.tables import aligned, shown, with_unit
from backend.cli.targets import find
from backend.client import RunResult
from sim_core.scenario import Scenario
from sim_core.simulate import simulate


def sweep(**more: Any) -> dict[str, Any]:
    options: dict[str, Any] = {"grid": [], "ranges": [], "samples": None, "seed": 0, "points": None}
    return fields.sweep_of(**options | more)


def test_changes_are_set_in_what_is_given() -> None:
    given = {"road": {"length": 130}}
    wanted = fields.changed(
        given,
        [
            "road.bump.height=0.12",
            "mpc.preview=none",
            "speed.target_speed_kmh=20",
            "mpc.stage_weights.cruise=1,2,3",
            "mpc.stage_weights.brake.1 = 5",
            "lqr.weights=[3,2,1]",
            "actuator.bandwidth=null",
        ],
    )
    scenario = Scenario.model_validate(wanted)
    assert (scenario.road.length, scenario.road.bump.height, scenario.road.bump.width) == (130, 0.12, 4)
    assert scenario.mpc.preview == "none"
    assert scenario.mpc.stage_weights.cruise == (1, 2, 3)
    assert scenario.mpc.stage_weights.brake == (2, 5, 1)
    assert scenario.lqr.weights == (3, 2, 1)
    assert given == {"road": {"length": 130}}
    assert fields.changed(given, []) == given


@pytest.mark.parametrize(
    ("change", "said"),
    [
        ("road.bump.hight=1", "road.bump.hight: Unknown field; there are road.bump.shape, road.bump.height"),
        ("road.bump=1", "road.bump: Unknown field"),
        ("road.bump.height=high", "road.bump.height: Input should be a valid number"),
        ("road.bump.height=NaN", "road.bump.height: Input should be a finite number"),
        ("road.bump.height=9", "road.bump.height: Input should be less than or equal to 1"),
        ("road.seed=1.5", "road.seed: Input should be a valid integer"),
        ("mpc.stage_weights.cruise=1,x", "mpc.stage_weights.cruise: three weights are 8,1,1"),
        ("mpc.stage_weights.cruise=0,0,0", "mpc.stage_weights.cruise: At least one weight"),
        ("road.bump.height", "--set takes FIELD=VALUE, and road.bump.height is no such pair"),
        ("road.bump.height=", "--set takes FIELD=VALUE, and road.bump.height= is no such pair"),
    ],
)
def test_changes_that_cannot_be_made_name_the_field(change: str, said: str) -> None:
    with pytest.raises(InputError) as caught:
        fields.changed({}, [change])
    assert caught.value.lines[0].startswith(said)


def test_a_change_below_something_that_is_no_part() -> None:
    with pytest.raises(InputError, match=r"road\.length"):
        fields.changed({"road": 5}, ["road.length=120"])


def test_grids() -> None:
    assert sweep(grid=["road.bump.height=0.05:0.15:11"])["grid"]["road.bump.height"] == [
        0.05, 0.06, 0.07, 0.08, 0.09, 0.1, 0.11, 0.12, 0.13, 0.14, 0.15,
    ]  # fmt: skip
    found = sweep(
        grid=[
            "road.bump.height=0.1, 0.05",
            "road.seed=1:5:3",
            "mpc.preview=lookahead,none",
            "mpc.stage_weights.cruise=[8,1,1],[2,6,1]",
        ]
    )
    assert found == {
        "grid": {
            "road.bump.height": [0.1, 0.05],
            "road.seed": [1, 3, 5],
            "mpc.preview": ["lookahead", "none"],
            "mpc.stage_weights.cruise": [[8, 1, 1], [2, 6, 1]],
        }
    }
    assert all(isinstance(value, int) for value in found["grid"]["road.seed"])


def test_other_forms_of_a_sweep(tmp_path: Path) -> None:
    assert sweep(ranges=["road.bump.height=0.05:0.1", "road.seed=1:9"], samples=7, seed=3) == {
        "latin_hypercube": {"ranges": {"road.bump.height": [0.05, 0.1], "road.seed": [1, 9]}, "samples": 7, "seed": 3}
    }
    file = tmp_path / "points.json"
    file.write_text('[{"road.seed": 4}]', encoding="utf-8")
    assert sweep(points=file) == {"list": [{"road.seed": 4}]}


@pytest.mark.parametrize(
    ("options", "said"),
    [
        ({}, "one of --grid"),
        ({"grid": ["road.seed=1"], "ranges": ["road.seed=1:2"], "samples": 2}, "one of --grid"),
        ({"ranges": ["road.seed=1:2"]}, "--samples belong together"),
        ({"grid": ["road.seed=1"], "samples": 2}, "--samples belong together"),
        ({"grid": ["road.seed=1:2:4"]}, "road.seed: Input should be a valid integer"),
        ({"grid": ["road.bump.height=0:1:1"]}, "road.bump.height: LOW:HIGH:COUNT"),
        ({"grid": ["road.bump.height=0.05:0.15"]}, "road.bump.height: 0.05:0.15 is neither LOW:HIGH:COUNT, such as"),
        ({"grid": ["road.bump.height=0.05:0.15:0.01"]}, "nor values with commas"),
        ({"grid": ["road.bump.height=0.05:0.1:3,0.15"]}, "nor values with commas"),
        ({"grid": ["mpc.preview=none:lookahead"]}, "mpc.preview: Input should be"),
        ({"grid": ["road.bump.height=a:b:3"]}, "road.bump.height: a is not a number"),
        ({"grid": ["road.bump.height=0:nan:3"]}, "road.bump.height: Input should be a finite number"),
        ({"grid": ["road.seed=1", "road.seed=2"]}, "road.seed: given twice"),
        ({"ranges": ["road.seed=1"], "samples": 2}, "road.seed: a range is LOW:HIGH"),
    ],
)
def test_sweeps_that_cannot_be(options: dict[str, Any], said: str) -> None:
    with pytest.raises(InputError) as caught:
        sweep(**options)
    assert said in caught.value.lines[0]


def saved(scenario: Scenario, *strategies: str) -> dict[str, Any]:
    """A run as a file holds it."""
    entries = {
        name: {
            "status": "ok",
            "compute_ms": 1.0,
            **json.loads(json.dumps(simulate(scenario, name).summary(), default=dict)),
        }
        for name in strategies
    }
    return {
        "id": "i" * 22,
        "core_version": "0.1.0",
        "scenario": scenario.model_dump(mode="json"),
        "strategies": entries,
    }


@pytest.fixture(scope="module")
def answer() -> dict[str, Any]:
    return saved(Scenario.model_validate({"road": {"length": 115}}), "passive", "lv")


def copy(answer: dict[str, Any]) -> dict[str, Any]:
    again: dict[str, Any] = json.loads(json.dumps(answer))
    return again


EXACT = Tolerance(relative=0, absolute=0)


def test_every_figure_has_a_unit(answer: dict[str, Any]) -> None:
    run = RunResult.of(answer)
    for outcome in run:
        assert outcome.figures().keys() == run.units.keys()
    assert run["lv"].metrics["bump"]["body_acceleration"]["peak"] == run["lv"].figures()["bump.body_acceleration.peak"]
    assert run.units["bump.body_acceleration.peak"] == "m/s^2"
    assert run.units["arrival_speed_kmh"] == "km/h"


def test_differences_come_largest_first_and_within_the_tolerance_not_at_all(answer: dict[str, Any]) -> None:
    other = copy(answer)
    metrics = other["strategies"]["lv"]["metrics"]["bump"]
    metrics["body_acceleration"]["peak"] *= 1.02
    metrics["pitch_acceleration"]["rms"] *= 0.9
    other["strategies"]["lv"]["events"]["target_reached"] = False
    a, b = RunResult.of(answer), RunResult.of(other)
    assert differences(a, a, ["lv", "passive"], EXACT) == []
    found = differences(a, b, ["lv", "passive"], EXACT)
    assert [(item.strategy, item.figure) for item in found] == [
        ("lv", "events.target_reached"),
        ("lv", "bump.pitch_acceleration.rms"),
        ("lv", "bump.body_acceleration.peak"),
    ]
    assert [item.change for item in found] == pytest.approx([math.inf, -0.1, 0.02])
    assert found[1].unit == "rad/s^2"
    loose = differences(a, b, ["lv"], Tolerance(relative=0.05, absolute=0))
    assert [item.figure for item in loose] == ["events.target_reached", "bump.pitch_acceleration.rms"]
    assert (
        len(differences(a, b, ["lv"], Tolerance(relative=0, absolute=1e9))) == 1
    )  # true is not false at any tolerance


def test_a_strategy_that_failed_or_is_missing_is_a_difference(answer: dict[str, Any]) -> None:
    failed, missing = copy(answer), copy(answer)
    failed["strategies"]["lv"] = {"status": "failed", "compute_ms": 1.0, "reason": "No."}
    del missing["strategies"]["lv"]
    for other, status in ((failed, "failed"), (missing, "not run")):
        found = differences(RunResult.of(answer), RunResult.of(other), ["lv"], Tolerance(relative=9, absolute=9e9))
        assert ("status", "ok", status) in [(item.figure, item.a, item.b) for item in found]


@pytest.mark.parametrize(
    ("a", "b", "equal"), [(0.0, 0.0, True), (0.0, 1e-3, False), (-1.0, -1.01, True), (1, 1.02, False)]
)
def test_the_tolerance_is_of_a(a: float, b: float, equal: bool) -> None:
    assert Tolerance(relative=0.011, absolute=0).holds(a, b) is equal


def test_inputs_that_differ() -> None:
    a = Scenario().model_dump(mode="json")
    b = fields.changed(a, ["road.bump.height=0.12", "mpc.stage_weights.cruise=1,1,1"])
    assert inputs(a, a) == []
    assert inputs(a, b) == [("road.bump.height", 0.1, 0.12), ("mpc.stage_weights.cruise", [8, 1, 1], [1, 1, 1])]


def test_comparing_files_needs_no_service(
    answer: dict[str, Any], tmp_path: Path, capsys: pytest.CaptureFixture[str], monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.setenv("RIDELAB_SERVER", "http://127.0.0.1:9")  # nobody there
    other = copy(answer)
    other["strategies"]["passive"]["travel_time"] += 1
    a, b = tmp_path / "a.json", tmp_path / "b.json"
    a.write_text(json.dumps(answer), encoding="utf-8")
    b.write_text(json.dumps(other), encoding="utf-8")
    assert app.run(["compare", str(a), str(a)]) == 0
    assert "Equal within the tolerance" in capsys.readouterr().out
    assert app.run(["compare", str(a), str(b)]) == 1
    assert "travel_time [s]" in capsys.readouterr().out
    assert app.run(["compare", str(a), str(b), "--tolerance", "0.2"]) == 0
    assert app.run(["compare", str(a), str(b), "--tolerance-abs", "1.5"]) == 0
    assert app.run(["compare", str(a), str(b), "--strategy", "lv"]) == 0
    capsys.readouterr()
    assert app.run(["compare", str(a), str(b), "--json"]) == 1
    told = json.loads(capsys.readouterr().out)
    assert told["equal"] is False
    assert [(item["strategy"], item["figure"], item["unit"]) for item in told["differences"]] == [
        ("passive", "travel_time", "s")
    ]
    assert app.run(["compare", str(a), str(b), "--strategy", "lqr"]) == 2
    assert "it has no lqr, only passive, lv" in capsys.readouterr().err


@pytest.mark.parametrize(
    ("content", "said"),
    [
        ("{", "not valid JSON"),
        ("[1]", "has to be a JSON object"),
        ('{"road": {"seed": 1, "seed": 2}}', "same key twice"),
        ('{"road": {"length": NaN}}', "NaN"),
        ('{"strategies": {"lv": 1}, "scenario": {}}', "not a whole run"),
        ('{"id": "", "core_version": "", "scenario": [], "strategies": {}}', "not a whole run"),
        (
            '{"id": "", "core_version": "", "scenario": {}, "strategies": {"lv": {"status": "ok", "compute_ms": 1, '
            '"metrics": {"bump": {"speed": {"rms": 1}}}}}}',
            "not a whole run",
        ),
        (b"\xff", "not valid UTF-8"),
    ],
)
def test_files_that_are_no_scenario(content: str | bytes, said: str, tmp_path: Path) -> None:
    file = tmp_path / "it.json"
    file.write_bytes(content if isinstance(content, bytes) else content.encode())
    with Services(None, None) as services, pytest.raises(InputError, match=said) as caught:
        find(str(file), services)
    assert caught.value.lines[0].startswith(str(file))


@pytest.mark.parametrize(
    ("arguments", "said"),
    [
        (["run", "nothing"], "neither a file, nor a preset (paper,"),
        (["run", "http://127.0.0.1:9/docs/abc"], "ends with /r/ID or /s/ID"),
        (["run", "--strategy", "lv", "--baseline", "passive"], "--baseline: one of the strategies that run, lv"),
        (["run", "--server", "127.0.0.1:9"], "--server or RIDELAB_SERVER: A service's address begins with http://"),
        (["run", "--set", "road.bump.hight=1"], "road.bump.hight: Unknown field"),
        (["sweep"], "one of --grid, --latin-hypercube and --list"),
        (["sweep", "--grid", "road.seed=1", "--detach"], "--detach needs --server"),
        (
            ["sweep", "--grid", "road.seed=1", "--out", "x.xls"],
            "--out: The file's format has to be json, csv or parquet",
        ),
        (["sweep", "--grid", "road.seed=1", "--out", "none/x.csv"], "--out: there is no folder none"),
        (["export", "paper", "--out", "x.csv"], "export takes a stored run, batch or link"),
        (["export", "paper", "--out", "-"], "--format: The file's format has to be"),
        (["compare", "-", "-"], "Only one of A and B"),
    ],
)
def test_bad_input_is_a_line_and_code_2(
    arguments: list[str], said: str, capsys: pytest.CaptureFixture[str], monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.delenv("RIDELAB_SERVER", raising=False)
    assert app.run(arguments) == 2
    printed = capsys.readouterr()
    assert said in printed.err
    assert printed.out == ""


def test_no_service_there_is_a_line_and_code_3(
    capsys: pytest.CaptureFixture[str], monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.setattr("backend.client.http.FIRST_PAUSE", 0.001)
    assert app.run(["run", "--server", "http://127.0.0.1:9"]) == 3
    assert capsys.readouterr().err.startswith("No answer from http://127.0.0.1:9: ")


def test_every_command_tells_what_it_does(capsys: pytest.CaptureFixture[str]) -> None:
    assert app.run(["--help"]) == 0
    told = capsys.readouterr().out
    for name in ("serve", "run", "sweep", "compare", "open", "export"):
        assert name in told
        assert app.run([name, "--help"]) == 0
        assert f"ridelab {name}" in capsys.readouterr().out
    assert app.run(["--version"]) == 0
    assert capsys.readouterr().out.startswith("Ridelab ")


def test_names_with_commas_or_repeated() -> None:
    assert listed(["lv, lqr", "passive", "lv", ""]) == ["lv", "lqr", "passive"]
    assert listed(None) == []


def test_values_and_tables_as_text() -> None:
    assert [shown(value) for value in (True, False, None, 0.123456789, [8.0, 1, 1], "none", 3)] == [
        "yes", "no", "-", "0.123457", "8,1,1", "none", "3",
    ]  # fmt: skip
    assert [with_unit("a", unit) for unit in ("m", "1", "")] == ["a [m]", "a", "a"]
    assert list(aligned(["name", "x"], [["a", "10"]], left={0})) == ["name   x", "a     10"]


def test_the_client_needs_no_service_and_loads_quickly() -> None:
    code = (
        "import sys, backend.client, backend.cli\n"
        "heavy = {'numpy', 'scipy', 'pydantic', 'fastapi', 'uvicorn', 'sqlalchemy', 'plotly', 'distributed'}\n"
        "sys.exit(', '.join(heavy & set(sys.modules)) or 0)"
    )
    run = subprocess.run([sys.executable, "-c", code], capture_output=True, text=True, check=False)
    assert (run.returncode, run.stderr) == (0, "")
