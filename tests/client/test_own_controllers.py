"""`ridelab new controller` writes a file that `ridelab check` likes; broken ones are told in words."""

import json
from pathlib import Path

import numpy as np
import pytest

from ridelab.cli import own
from sim_core import Scenario, check_controller, load_controllers, simulate
from tests.client.cli import Cli


@pytest.fixture
def file(cli: Cli, tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> Path:
    monkeypatch.chdir(tmp_path)
    assert cli("new", "controller", "my_law") == "my_law.py: ridelab check my_law.py tries it\n"
    return tmp_path / "my_law.py"


def test_a_new_controller_runs_and_nothing_is_wrong_with_it(cli: Cli, file: Path) -> None:
    assert cli("check", file).startswith("my_law (My law): nothing wrong was found\n")
    (checked,) = json.loads(cli("check", file, "--json"))
    assert checked == {"id": "my_law", "label": "My law", "faults": []}
    assert json.loads(cli("new", "controller", "other", "--json")) == {"file": "other.py", "id": "other"}


def test_the_linear_law_in_a_new_file_is_the_same_law(file: Path) -> None:
    text = file.read_text()
    (by_force,) = load_controllers(file).values()
    head, _, law = text.partition("    def force")
    comment = law.partition("In place of force:\n")[2]
    file.write_text(
        head.replace("import Controller", "import Controller, LinearLaw") + comment.replace("    # ", "    ")
    )
    (by_law,) = load_controllers(file).values()
    assert check_controller(by_law) == []
    first, second = (simulate(Scenario(), each).series["front_force"] for each in (by_force, by_law))
    np.testing.assert_allclose(first, second, atol=1e-6)  # [N]


def test_no_file_is_written_over_and_a_name_is_an_id(cli: Cli, file: Path) -> None:
    before = file.read_text()
    cli("new", "controller", "my_law", code=2)
    for name in ("My-law", "../law", "größe", "1law", ""):
        cli("new", "controller", name, code=2)
    assert file.read_text() == before
    assert [each.name for each in file.parent.iterdir()] == ["my_law.py"]


@pytest.mark.parametrize(
    ("law", "code", "said"),
    [
        ("return 1 / (seen.position < 110), 0.0", 1, "line 20: ZeroDivisionError"),
        ("import os; os._exit(0)", 2, "code 0"),
        ("while True: pass", 2, "after 3 s"),
        ("return globals().setdefault('arms', self.arms) * seen.state[5]", 1, "depends on the car of an earlier one"),
    ],
)
def test_a_broken_law_is_told_in_words(
    cli: Cli, file: Path, law: str, code: int, said: str, monkeypatch: pytest.MonkeyPatch
) -> None:
    if "while" in law:  # which no time is enough for
        monkeypatch.setattr(own, "LIMIT", 3.0)
    before, _, _ = file.read_text().partition("return")
    file.write_text(f"{before}{law}\n")
    printed = cli("check", file, code=code)
    assert said in printed + cli.error


@pytest.mark.parametrize("command", ["run", "compare paper paper", "robustness", "tune", "frequency", "fields"])
def test_a_service_elsewhere_is_brought_no_file(cli: Cli, file: Path, command: str) -> None:
    cli(*command.split(), "--controller", file, "--server", "http://127.0.0.1:9", code=2)
    assert "--controller: a service runs only the files that its operator named" in cli.error
