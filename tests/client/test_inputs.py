"""Differences between two runs, files, and addresses that are typed on the command line; no service needed."""

import json
import subprocess
import sys
from collections.abc import Callable
from pathlib import Path
from typing import Any

import pytest

import sim_core
from ridelab import Ridelab, __version__
from ridelab.cli import app, fields
from ridelab.cli.names import Names
from ridelab.cli.reporting import InputError, show_table
from ridelab.cli.service import Services
from ridelab.cli.targets import find
from sim_core.scenario import Estimation, Scenario
from tests import wording


@pytest.fixture
def services(ridelab: Ridelab) -> Services:
    services = Services(None, None)
    services.names = Names.of(ridelab)
    return services


@pytest.mark.parametrize(
    ("road", "changes", "swept", "length"),
    [
        ({"length": 130}, ["road.seed=2"], (), 130),
        ({"length": 130}, ["road.profile=A"], (), None),
        ({"length": 130}, ["road.profile=A", "road.length=90"], (), 90),
        ({"profile": "A", "length": 60}, ["road.seed=2"], (), 60),
        ({"length": 130}, [], ("road.profile",), None),
    ],
)
def test_a_measured_road_that_is_chosen_brings_its_length(
    services: Services, road: dict[str, Any], changes: list[str], swept: tuple[str, ...], length: float | None
) -> None:
    """None is no length: the service's answer has the road's."""
    assert fields.changed({"road": road}, changes, services, swept)["road"].get("length") == length


@pytest.fixture
def answer(outcomes: dict[str, dict[str, Any]]) -> dict[str, Any]:
    """A run as a file holds it."""
    units = {"travel_time": "s", "bump.pitch_acceleration.rms": "rad/s^2"}
    head = {"id": "i" * 22, "core_version": "0.1.0", "scenario": Scenario().model_dump(mode="json"), "units": units}
    return {**head, "strategies": outcomes}


def copy(answer: dict[str, Any]) -> Any:
    return json.loads(json.dumps(answer))


@pytest.fixture
def compare(
    answer: dict[str, Any], tmp_path: Path, capsys: pytest.CaptureFixture[str], monkeypatch: pytest.MonkeyPatch
) -> Callable[..., tuple[int, str]]:
    """`compare` of two files where no service answers: the exit code and what is printed.

    The files are a, b which is a second slower with passive dampers, c where three numbers differ, one with a strategy
    more, and another road.
    """
    monkeypatch.setenv("RIDELAB_SERVER", "http://127.0.0.1:9")  # nobody there
    monkeypatch.chdir(tmp_path)
    slower, more, road = copy(answer), copy(answer), copy(answer)
    slower["strategies"]["passive"]["travel_time"] += 1
    more["strategies"]["lqr"] = answer["strategies"]["lv"]
    other = copy(answer)
    bump = other["strategies"]["lv"]["metrics"]["bump"]
    bump["body_acceleration"]["peak"] *= 1.02
    bump["pitch_acceleration"]["rms"] *= 0.9
    other["strategies"]["lv"]["events"]["target_reached"] = False
    road["scenario"]["road"]["seed"] = 2
    for name, content in {"a": answer, "b": slower, "c": other, "more": more, "road": road}.items():
        (tmp_path / f"{name}.json").write_text(json.dumps(content), encoding="utf-8")

    def run(first: str, second: str, *words: str) -> tuple[int, str]:
        code = app.run(["compare", f"{first}.json", f"{second}.json", *words])
        printed = capsys.readouterr()
        return code, printed.out + printed.err

    return run


@pytest.mark.parametrize("asked", wording.asked_in("comparisons"))
def test_files_are_compared_without_a_service(compare: Callable[..., tuple[int, str]], asked: str) -> None:
    """With the exit code; what differs is named, the largest change first, and equal results say how much there was."""
    code, printed = compare(*asked.split())
    wording.check("comparisons", asked, [code, *printed.splitlines()])


def test_what_core_0_3_0_saved_has_the_filter_it_had(
    answer: dict[str, Any], services: Services, tmp_path: Path
) -> None:
    saved, file = copy(answer), tmp_path / "saved.json"
    saved["scenario"]["estimation"] = Estimation(kind="kalman").model_dump(mode="json", exclude={"knows_preview"})
    for content in (saved, saved["scenario"]):  # as `run --json` prints it, and `tune --out` writes it
        file.write_text(json.dumps(content), encoding="utf-8")
        assert find(str(file), services).scenario["estimation"]["knows_preview"] is False
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
    ("words", "said"),
    [
        ("run --server 127.0.0.1:9", "begins with http://"),
        ("sweep --grid road.seed=1 --detach", "--detach needs --server"),
    ],
)
def test_a_server_that_cannot_be_one_is_said(
    words: str, said: str, capsys: pytest.CaptureFixture[str], monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.delenv("RIDELAB_SERVER", raising=False)
    assert app.run(words.split()) == 2
    assert said in capsys.readouterr().err


def test_no_service_there_is_a_line_and_code_3(
    capsys: pytest.CaptureFixture[str], monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.setattr("ridelab.http.FIRST_PAUSE", 0.001)
    assert app.run(["run", "--server", "http://127.0.0.1:9"]) == 3
    assert capsys.readouterr().err.startswith("No answer from http://127.0.0.1:9: ")


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
    names, values = ("road.bump.height", ADDRESS, "LV as ECU code"), ["0.16 ± 0.004 (+0.6 ± 0.1 %)"] * 3
    show_table(["field", *metrics, "range"], [[name, *values, ["cosine", "half_sine"]] for name in names])
    printed = capsys.readouterr().out
    assert max(map(len, printed.splitlines())) <= 80
    words = [*names, "acceleration.", "cosine,", "half_sine", "0.16 ± 0.004", "(+0.6 ± 0.1 %)"]
    assert [word for word in words if word not in printed] == []


ADDRESS = "http://r/?a,b"
