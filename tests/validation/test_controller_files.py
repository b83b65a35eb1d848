"""Controllers from files are loaded, loaded again when saved, and refused in words; and those in examples/."""

import os
import re
import sys
from pathlib import Path

import numpy as np
import pytest

from sim_core import Bump, Controller, Road, Scenario, check_controller, controller_files, load_controllers, simulate
from sim_core.controller_files import VARIABLE, ControllerFileError
from sim_core.errors import UnknownNameError
from sim_core.program import program

EXAMPLES = Path(__file__).parents[2] / "examples" / "controllers"
SHORT = Scenario(road=Road(length=60, bump=Bump(start=30)))
LAW = '''"""Mine."""
import sim_core


class Mine(sim_core.Controller):
    """Damps the body."""

    id, label = "mine", "Mine"
    damping: float = sim_core.option(1000.0, unit="N s/m", ge=0, le=20_000)

    def force(self, seen):
        return -self.damping * seen.state[4], -self.damping * seen.state[4]
'''


@pytest.fixture(autouse=True)
def as_in_a_library(monkeypatch: pytest.MonkeyPatch) -> None:
    """This process may have been a service's."""
    monkeypatch.setattr(controller_files, "_find", controller_files.load_all)


@pytest.fixture
def file(tmp_path: Path) -> Path:
    file = tmp_path / "mine.py"
    file.write_text(LAW)
    return file


def mine(file: Path) -> type[Controller]:
    return load_controllers(file)["mine"]


@pytest.mark.parametrize(
    ("name", "metric"),
    [
        ("my_lqr", "body_acceleration"),
        ("preview_proportional", "body_acceleration"),
        ("deflection_pid", "front_deflection"),
        ("neural_net", "body_acceleration"),
    ],
)
def test_an_example_has_no_fault_and_makes_smaller_what_it_is_for(
    name: str, metric: str, monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.setenv(VARIABLE, str(EXAMPLES))
    assert check_controller(name) == []
    uncontrolled, own = (simulate(Scenario(), each).metrics["bump"][metric]["peak"] for each in ("speed_only", name))
    assert own < 0.97 * uncontrolled


def test_the_examples_are_short() -> None:
    assert all(15 <= len(file.read_text().splitlines()) <= 40 for file in EXAMPLES.glob("*.py"))


def test_the_lqr_of_the_examples_is_ours() -> None:
    """Both are the same law in the same loop: only their order of rounding could differ."""
    ours, theirs = simulate(SHORT, "lqr"), simulate(SHORT, load_controllers(EXAMPLES / "my_lqr.py")["my_lqr"])
    for name, values in ours.series.items():
        scale = max(1.0, float(np.abs(values).max()))
        assert np.abs(theirs.series[name] - values).max() <= 1e-9 * scale, name


def test_the_preview_of_the_examples_is_worth_something() -> None:
    law = load_controllers(EXAMPLES / "preview_proportional.py")["preview_proportional"]
    with_preview, without = simulate(SHORT, law), simulate(SHORT, law(gain=0.0))
    assert with_preview.comfort["weighted_rms"] < without.comfort["weighted_rms"]


def test_a_saved_file_is_another_law_and_another_program(file: Path) -> None:
    before = mine(file)
    assert mine(file) is before
    file.write_text(LAW.replace("1000.0", "3000.0"))
    after = mine(file)
    assert (before().damping, after().damping) == (1000.0, 3000.0)  # type: ignore[attr-defined]  # of the text above
    assert program(before)["controller"] != program(after)["controller"]
    file.write_text(LAW)
    assert program(mine(file))["controller"] == program(before)["controller"]


def test_a_file_that_a_law_reads_is_part_of_the_law(file: Path) -> None:
    weights = file.with_name("weights.txt")
    weights.write_text("1")
    file.write_text(LAW.replace("    damping:", "    files = ('weights.txt',)\n    damping:"))
    before = program(mine(file))
    weights.write_text("22")
    assert program(mine(file)) != before
    weights.unlink()
    with pytest.raises(ControllerFileError, match=r"weights\.txt: it cannot be read"):
        mine(file)


def test_files_and_folders_that_the_variable_names_are_strategies(
    file: Path, tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    with pytest.raises(UnknownNameError):
        simulate(SHORT, "mine")
    monkeypatch.setenv(VARIABLE, os.pathsep.join([str(EXAMPLES / "pid.py"), str(tmp_path)]))
    (tmp_path / "_notes.py").write_text("raise ValueError")  # no controller: it begins with an underscore
    assert simulate(SHORT, "mine").metrics == simulate(SHORT, mine(file)).metrics
    with pytest.raises(UnknownNameError, match=r"passive, deflection_pid, mine$"):
        simulate(SHORT, "mien")
    (tmp_path / "other.py").write_text(LAW)
    with pytest.raises(ControllerFileError, match=r"other\.py: .*mine\.py has a controller of the id mine too"):
        simulate(SHORT, "mine")
    assert simulate(SHORT, "passive").strategy == "passive"  # ours need none of those files


@pytest.mark.parametrize("named", ["my_laws", "my_laws:Mine"])
def test_a_package_names_its_own_by_an_entry_point(named: str, tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    (tmp_path / "my_laws.py").write_text(LAW)
    (tmp_path / "my_laws-1.dist-info").mkdir()
    (tmp_path / "my_laws-1.dist-info" / "entry_points.txt").write_text(f"[{controller_files.GROUP}]\nlaws = {named}\n")
    monkeypatch.syspath_prepend(str(tmp_path))
    monkeypatch.delitem(sys.modules, "my_laws", raising=False)
    monkeypatch.setattr(controller_files, "_installed", controller_files._installed.__wrapped__)
    assert simulate(SHORT, "mine").metrics == simulate(SHORT, controller_files.load("entry point laws")["mine"]).metrics


@pytest.mark.parametrize(
    ("text", "said"),
    [
        ("import sim_core\nclass Mine(:", r"mine\.py, line 2: SyntaxError: invalid syntax"),
        ("import no_such_module", r"mine\.py, line 1: ModuleNotFoundError: No module named 'no_such_module'"),
        ("\n\n1 / 0", r"mine\.py, line 3: ZeroDivisionError: division by zero"),
        ("import sys\nsys.exit(3)", r"mine\.py, line 2: It ends the program: leave out sys\.exit"),
        ("def deeper():\n    deeper()\ndeeper()", r"mine\.py, line 2: RecursionError"),
        ("ä = 'not in UTF-8'", r"mine\.py.*: SyntaxError"),
        ("from sim_core import Controller", r"mine\.py: it has no class derived from sim_core\.Controller with an id"),
        (LAW.replace('"mine"', "3"), r"mine\.py: the id of Mine is no text"),
        (LAW + "class Again(Mine):\n    pass\n", r"mine\.py: two controllers have the id mine"),
    ],
)
def test_a_file_that_cannot_be_used_says_why(file: Path, text: str, said: str) -> None:
    file.write_text(text, encoding="latin-1")
    with pytest.raises(ControllerFileError, match=said):
        load_controllers(file)


def test_a_file_that_is_not_there_says_so(tmp_path: Path) -> None:
    with pytest.raises(ControllerFileError, match=r"none\.py: it cannot be read: No such file"):
        load_controllers(tmp_path / "none.py")


@pytest.mark.parametrize(
    ("body", "said"),
    [
        ("return 1 / 0, 0.0", r"mine\.py, line 12: ZeroDivisionError: "),
        ("import sys; sys.exit(1)", r"mine\.py, line 12: It ends the program: leave out sys\.exit"),
        ("return self.force(seen)", r"mine\.py, line 12: RecursionError"),
    ],
)
def test_a_law_that_fails_is_told_with_its_line(file: Path, body: str, said: str) -> None:
    file.write_text(LAW.replace("return -self.damping * seen.state[4], -self.damping * seen.state[4]", body))
    (sentence,) = check_controller(mine(file))
    assert re.search(said, sentence), sentence


def test_what_a_run_changes_of_its_copy_is_nobody_elses(file: Path) -> None:
    file.write_text(LAW.replace("return -", "self.damping += 1.0; return -"))
    assert check_controller(mine(file)) == []
