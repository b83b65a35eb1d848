"""Values typed on the command line, and differences between two runs; no service needed."""

import json
import math
import subprocess
import sys
from pathlib import Path
from typing import Any

import pytest

import sim_core
from ridelab import RunResult, __version__
from ridelab.cli import app, fields
from ridelab.cli.compare import Equal, differences, equal_within
from ridelab.cli.names import Names
from ridelab.cli.reporting import InputError, show_table
from ridelab.cli.service import Services
from ridelab.cli.targets import find
from ridelab.fields import limits_of, units_of
from sim_core.catalogue import METRICS
from sim_core.scenario import Estimation, Scenario
from sim_core.simulate import simulate

SCHEMA = Scenario.model_json_schema()
UNITS = units_of(SCHEMA)


@pytest.fixture
def services() -> Services:
    services = Services(None, None)
    paper = {"paper": Scenario().model_dump(mode="json")}
    services.names = Names(
        fields=UNITS,
        limits=limits_of(SCHEMA),
        strategies={},
        presets=paper,
        signals={},
        windows={},
        paper_signals=[],
        metrics={},
    )
    return services


def test_changes_are_set_in_what_is_given(services: Services) -> None:
    scenario_json = {"road": {"length": 130}}
    changes = {
        "road.bump.height": "12 cm",
        "speed.initial_speed_kmh": "10m/s",
        "road.seed": "4",
        "mpc.preview": "none",
        "mpc.stage_weights.cruise": "1,2,3",
        "mpc.stage_weights.brake.1 ": " 5",
        "lqr.weights": "1 1 6",
        "actuator.bandwidth": "null",
        "vehicle.tyre_lift_off": "1",
        "hook.semi_active": "off",
        "vehicle.front_damper_curve": "[[-1, -500], [1, 900]]",
        "fuzzy.rules": '[{"if": {"distance": "O"}, "then": "V"}]',
    }
    changed = fields.changed(scenario_json, [f"{name}={text}" for name, text in changes.items()], services)
    scenario = Scenario.model_validate(changed)
    assert (scenario.road.length, scenario.road.bump.height, scenario.road.seed) == (130, 0.12, 4)
    assert scenario.speed.initial_speed_kmh == 36
    assert (scenario.mpc.stage_weights.cruise, scenario.lqr.weights) == ((1, 2, 3), (1, 1, 6))
    assert [rule.then for rule in scenario.fuzzy.rules or ()] == ["V"]
    assert [force for _, force in scenario.vehicle.front_damper_curve or ()] == [-500, 900]
    assert (scenario.mpc.stage_weights.brake, scenario.actuator.bandwidth) == ((2, 5, 1), None)
    assert scenario.mpc.preview == "none"
    assert (scenario.vehicle.tyre_lift_off, scenario.hook.semi_active) == (True, False)
    assert scenario_json == {"road": {"length": 130}}
    assert fields.changed(scenario_json, [], services) == scenario_json


@pytest.mark.parametrize(
    ("road", "changes", "swept", "length"),
    [
        ({}, ["road.seed=2"], (), None),
        ({"length": 130}, ["road.seed=2"], (), 130),
        ({"length": 130}, ["road.profile=A"], (), None),
        ({"length": 130}, ["road.profile=A", "road.length=90"], (), 90),
        ({"profile": "A"}, ["road.seed=2"], (), None),
        ({"profile": "A", "length": 60}, ["road.seed=2"], (), 60),
        ({"length": 130}, [], ("road.profile",), None),
        ({"length": 130}, [], ("road.profile", "road.length"), 130),
        ({"length": 130}, ["road.seed=2"], ("road.seed",), 130),
    ],
)
def test_a_measured_road_that_is_chosen_brings_its_length(
    services: Services, road: dict[str, Any], changes: list[str], swept: tuple[str, ...], length: float | None
) -> None:
    """None is no length: the service's answer has the road's."""
    assert fields.changed({"road": road}, changes, services, swept)["road"].get("length") == length


def test_sweeps() -> None:
    grid = {
        "road.bump.height": ("5cm:150mm:5", [0.05, 0.075, 0.1, 0.125, 0.15]),
        "road.bump.width": ("0, 10cm, 50mm", [0, 0.1, 0.05]),
        "road.seed": ("1:5:3", [1, 3, 5]),
        "vehicle.tyre_lift_off": ("0,True", [False, True]),
        "mpc.preview": ("lookahead,none", ["lookahead", "none"]),
        "mpc.stage_weights.cruise": ("[8,1,1],[2,6,1]", [[8, 1, 1], [2, 6, 1]]),
    }
    parsed = fields.grid_of([f"{name}={text}" for name, (text, _) in grid.items()], UNITS)
    assert parsed == {name: values for name, (_, values) in grid.items()}
    assert all(isinstance(value, int) for value in parsed["road.seed"])
    ranges = fields.ranges_of(["road.bump.height=5cm:10 cm", "road.seed=1:9"], "--range", UNITS)
    assert ranges == {"road.bump.height": [0.05, 0.1], "road.seed": [1, 9]}


@pytest.fixture(scope="module")
def answer() -> dict[str, Any]:
    """A run as a file holds it."""
    scenario = Scenario.model_validate({"road": {"length": 115}})
    entries = {
        name: {
            "status": "ok",
            "compute_ms": 1.0,
            **json.loads(json.dumps(simulate(scenario, name).summary(), default=dict)),
        }
        for name in ("passive", "lv")
    }
    units = {"travel_time": "s", "bump.pitch_acceleration.rms": "rad/s^2"}
    head = {"id": "i" * 22, "core_version": "0.1.0", "scenario": scenario.model_dump(mode="json"), "units": units}
    return {**head, "strategies": entries}


def copy(answer: dict[str, Any]) -> Any:
    return json.loads(json.dumps(answer))


def tolerance(relative: float, absolute: float = 0) -> Equal:
    return equal_within([str(relative)], [str(absolute)])


def test_differences_come_largest_first_and_within_the_tolerance_not_at_all(answer: dict[str, Any]) -> None:
    other = copy(answer)
    metrics = other["strategies"]["lv"]["metrics"]["bump"]
    metrics["body_acceleration"]["peak"] *= 1.02
    metrics["pitch_acceleration"]["rms"] *= 0.9
    other["strategies"]["lv"]["events"]["target_reached"] = False
    a, b = RunResult.of(answer), RunResult.of(other)
    assert differences(a, a, ["lv", "passive"], tolerance(0), ["*"]) == []
    differing = differences(a, b, ["lv", "passive"], tolerance(0), ["*"])
    assert [(item.strategy, item.figure, item.worse) for item in differing] == [
        ("lv", "events.target_reached", True),
        ("lv", "bump.pitch_acceleration.rms", False),
        ("lv", "bump.body_acceleration.peak", True),
    ]
    assert [item.change for item in differing] == pytest.approx([math.inf, -0.1, 0.02])
    assert differing[1].unit == "rad/s^2"
    assert [item.worse for item in differences(b, a, ["lv"], tolerance(0), ["*"])] == [False, True, False]
    loose = differences(a, b, ["lv"], tolerance(0.05), ["*"])
    assert [item.figure for item in loose] == ["events.target_reached", "bump.pitch_acceleration.rms"]
    assert len(differences(a, b, ["lv"], tolerance(0, 1e9), ["*"])) == 1, "true is not false at any tolerance"
    assert [item.figure for item in differences(a, b, ["lv"], tolerance(0), ["bump.*.peak"])] == [
        "bump.body_acceleration.peak"
    ]


def test_comparing_files_needs_no_service(
    answer: dict[str, Any], tmp_path: Path, capsys: pytest.CaptureFixture[str], monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.setenv("RIDELAB_SERVER", "http://127.0.0.1:9")  # nobody there
    other = copy(answer)
    other["strategies"]["passive"]["travel_time"] += 1
    a, b = str(tmp_path / "a.json"), str(tmp_path / "b.json")
    Path(a).write_text(json.dumps(answer), encoding="utf-8")
    Path(b).write_text(json.dumps(other), encoding="utf-8")
    assert app.run(["compare", a, a]) == 0
    assert f"Equal within the tolerance: {2 * len(METRICS)} metrics of passive, lv" in capsys.readouterr().out
    assert app.run(["compare", a, b]) == 1
    assert "travel_time [s]" in capsys.readouterr().out
    for words, code in (
        ("--tolerance 0.2", 0),
        ("--tolerance travel_*=0.2", 0),
        ("--tolerance travel_*=0.2 --tolerance 1e-9", 1),
        ("--tolerance-abs comfort.*=9", 1),
        ("--tolerance-abs 1.5", 0),
        ("--strategy lv", 0),
        ("--metric bump.*,comfort.*", 0),
        ("--metric bmp.*", 2),
        ("--metric bump.*,bmp.*", 2),
        ("--metric=", 2),
        ("--tolerance comfrt.*=0.2", 2),
        ("--tolerance-abs comfrt.*=9", 2),
        ("--strategy=", 2),
        ("--worse", 1),
        ("--strategy lqr", 2),
        ("--tolerance travel_time=much", 2),
        ("--tolerance=-1", 2),
    ):
        assert app.run(["compare", a, b, *words.split()]) == code, words
    assert app.run(["compare", b, a, "--worse"]) == 0
    printed = capsys.readouterr()
    assert printed.out.endswith(f"Not worse beyond the tolerance: {2 * len(METRICS)} metrics of passive, lv\n")
    said = printed.err
    assert "it has no lqr, only passive, lv" in said
    assert "--metric: bmp.* fits no metric; their names begin with arrival_speed_kmh, bump, comfort, events," in said
    assert "--strategy: it names nothing" in said
    assert "--tolerance: travel_time=much is neither a number from 0 on nor PATTERN=NUMBER" in said
    assert app.run(["compare", a, b, "--json"]) == 1
    comparison = json.loads(capsys.readouterr().out)
    assert comparison["equal"] is False
    assert [(item["strategy"], item["figure"], item["unit"]) for item in comparison["differences"]] == [
        ("passive", "travel_time", "s")
    ]
    other["strategies"] = {**answer["strategies"], "lqr": answer["strategies"]["lv"]}
    Path(b).write_text(json.dumps(other), encoding="utf-8")
    assert [app.run(["compare", a, b, *words]) for words in ([], ["--worse"])] == [1, 0], "one strategy more"
    other = {**copy(answer), "scenario": {**answer["scenario"], "road": {**answer["scenario"]["road"], "seed": 2}}}
    Path(b).write_text(json.dumps(other), encoding="utf-8")
    capsys.readouterr()
    assert [app.run(["compare", a, b, *words]) for words in ([], ["--same-scenario"])] == [0, 1]
    assert capsys.readouterr().out.endswith("The scenarios differ in 1 field\n")


def test_what_core_0_3_0_saved_has_the_filter_it_had(
    answer: dict[str, Any], services: Services, tmp_path: Path
) -> None:
    saved, file = copy(answer), tmp_path / "saved.json"
    kalman = Estimation(kind="kalman").model_dump(mode="json", exclude={"knows_preview"})
    stored: dict[str, Any]
    for told, stored in ((False, kalman), (True, {**kalman, "knows_preview": True})):
        saved["scenario"]["estimation"] = stored
        for content in (saved, saved["scenario"]):  # as `run --json` prints it, and `tune --out` writes it
            file.write_text(json.dumps(content), encoding="utf-8")
            found = find(str(file), services)
            assert found.scenario["estimation"] == {**stored, "knows_preview": told}
            assert found.run is None or found.run.scenario == found.scenario
    typed = {"estimation": {"kind": "kalman"}}
    file.write_text(json.dumps(typed), encoding="utf-8")
    assert find(str(file), services).scenario == typed, "what a person wrote is today's"


@pytest.mark.parametrize(
    ("content", "said"),
    [
        ("{", "not valid JSON"),
        ('{"road": {"seed": 1, "seed": 2}}', "the same key twice, one of seed"),
        ('{"road": {"length": NaN}}', "NaN is no number"),
        ('{"id": "", "core_version": "", "scenario": [], "strategies": {}}', "not a whole run"),
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
        (["run", "http://127.0.0.1:9/docs/abc"], "ends with /r/ID or /s/ID"),
        (["run", "--server", "127.0.0.1:9"], "--server or RIDELAB_SERVER: A service's address begins with http://"),
        (["sweep", "--grid", "road.seed=1", "--detach"], "--detach needs --server"),
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
    monkeypatch.setattr("ridelab.http.FIRST_PAUSE", 0.001)
    assert app.run(["run", "--server", "http://127.0.0.1:9"]) == 3
    said = capsys.readouterr().err
    assert said.startswith("No answer from http://127.0.0.1:9: ")
    assert said.endswith("ridelab serve starts one\n")


def test_every_command_tells_what_it_does(capsys: pytest.CaptureFixture[str]) -> None:
    assert app.run(["--help"]) == 0
    printed = capsys.readouterr().out
    for name in (command.__name__.rstrip("_") for command in app.COMMANDS):
        assert name in printed
        assert app.run([name, "--help"]) == 0
        assert f"ridelab {name}" in capsys.readouterr().out
    assert app.run(["--version"]) == 0
    assert capsys.readouterr().out == f"Ridelab {__version__}\n"
    assert __version__ == sim_core.__version__


def test_the_client_loads_quickly() -> None:
    code = (
        "import sys, ridelab, ridelab.cli.app\n"
        "heavy = {'numpy', 'pandas', 'scipy', 'pydantic', 'sim_core', 'backend'}\n"
        "sys.exit(', '.join(heavy & set(sys.modules)) or 0)"
    )
    run = subprocess.run([sys.executable, "-c", code], capture_output=True, text=True, check=False, cwd=CLIENT)
    assert (run.returncode, run.stderr) == (0, "")


CLIENT = Path(__file__).parents[2] / "client"


def test_a_narrow_terminal_breaks_no_figure_and_no_name(
    monkeypatch: pytest.MonkeyPatch, capsys: pytest.CaptureFixture[str]
) -> None:
    monkeypatch.setenv("TERM", "dumb")  # of 80 columns
    monkeypatch.setattr(sys.stdout, "isatty", lambda: True)
    metrics = [f"rough_road.{signal}_acceleration.rms [m/s^2]" for signal in ("body", "pitch", "yaw")]
    show_table(["field", *metrics, "range"], [["road.bump.height", *["0.1458 (-64.0 %)"] * 3, ["cosine", "half_sine"]]])
    signals = ("Body acceleration [m/s^2]", "Pitch acceleration [rad/s^2]", "Front tyre dynamic load [N]")
    show_table(
        ["RMS on the rough road", *signals, "shown"],
        [["LV as ECU code", *["0.16 ± 0.004 (+0.6 ± 0.1 %)"] * 3, ADDRESS]],
    )
    printed = capsys.readouterr().out
    assert max(map(len, printed.splitlines())) <= 80
    words = ["road.bump.height", "0.1458", "(-64.0 %)", "acceleration.", "cosine,", "half_sine"]
    words += ["0.16 ± 0.004", "(+0.6 ± 0.1 %)", "LV as ECU code", ADDRESS]
    assert [word for word in words if word not in printed] == []
    show_table(["name", *metrics, *metrics], [[23 * "name", *["0.16 ± 0.004 (+0.6 ± 0.1 %)"] * 6]])
    printed = capsys.readouterr().out
    assert (23 * "name" in printed, printed.count("0.16 ± 0.004"), printed.count("(+0.6 ± 0.1 %)")) == (True, 6, 6)


ADDRESS = "http://r/?a,b"
