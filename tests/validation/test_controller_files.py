"""Controllers from files are loaded, loaded again when saved, and refused in words; and those in examples/."""

import os
import re
import sys
from importlib.metadata import version
from pathlib import Path

import numpy as np
import pytest

import sim_core
from sim_core import Controller, Scenario, check_controller, controller_files, load_controllers, simulate
from sim_core.controller_files import VARIABLE, ControllerFileError
from sim_core.errors import UnknownNameError
from sim_core.kernel.library import DIGEST
from sim_core.program import program as named_program
from tests.validation.controllers import SHORT

EXAMPLES = Path(__file__).parents[2] / "examples" / "controllers"
TEXT = '''"""Mine."""
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
    file.write_text(TEXT)
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


def test_the_lqr_of_the_examples_is_ours() -> None:
    """Both are the same law in the same loop: only their order of rounding could differ."""
    ours, theirs = simulate(SHORT, "lqr"), simulate(SHORT, load_controllers(EXAMPLES / "my_lqr.py")["my_lqr"])
    for name, values in ours.series.items():
        scale = max(1.0, float(np.abs(values).max()))
        assert np.abs(theirs.series[name] - values).max() <= 1e-9 * scale, name


def test_a_saved_file_is_another_controller_and_another_program(file: Path) -> None:
    """So is one whose data are other ones."""
    before = mine(file)
    assert mine(file) is before
    file.write_text(TEXT.replace("1000.0", "3000.0"))
    after = mine(file)
    assert (before().damping, after().damping) == (1000.0, 3000.0)  # type: ignore[attr-defined]  # of the text above
    assert named_program(before)["controller"] != named_program(after)["controller"]
    file.write_text(TEXT)
    assert named_program(mine(file))["controller"] == named_program(before)["controller"]
    weights = file.with_name("weights.txt")
    weights.write_text("1")
    file.write_text(TEXT.replace("    damping:", "    files = ('weights.txt',)\n    damping:"))
    first = named_program(mine(file))
    weights.write_text("22")
    assert named_program(mine(file)) != first
    weights.unlink()
    with pytest.raises(ControllerFileError, match=r"weights\.txt"):
        mine(file)


def test_a_program_is_named_by_all_that_computes_its_results(file: Path) -> None:
    """A result of another core, other C or another solver is not taken for one of this program."""
    named = named_program(mine(file))
    assert named.pop("controller") == mine(file).file_digest
    assert named == {"core": sim_core.__version__, "kernel": DIGEST, "osqp": version("osqp")}


def test_files_and_folders_that_the_variable_names_are_strategies(
    file: Path, tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    with pytest.raises(UnknownNameError):
        simulate(SHORT, "mine")
    monkeypatch.setenv(VARIABLE, os.pathsep.join([str(EXAMPLES / "pid.py"), str(tmp_path)]))
    (tmp_path / "_notes.py").write_text("raise ValueError")  # no controller: it begins with an underscore
    assert simulate(SHORT, "mine").metrics == simulate(SHORT, mine(file)).metrics
    with pytest.raises(UnknownNameError, match=r"deflection_pid, mine$"):
        simulate(SHORT, "mien")
    (tmp_path / "other.py").write_text(TEXT)
    with pytest.raises(ControllerFileError, match=r"other\.py: .*mine\.py"):
        simulate(SHORT, "mine")
    assert simulate(SHORT, "passive").strategy == "passive"  # ours need none of those files


@pytest.mark.parametrize("named", ["my_laws", "my_laws:Mine"])
def test_a_package_names_its_own_by_an_entry_point(named: str, tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    (tmp_path / "my_laws.py").write_text(TEXT)
    (tmp_path / "my_laws-1.dist-info").mkdir()
    (tmp_path / "my_laws-1.dist-info" / "entry_points.txt").write_text(f"[{controller_files.GROUP}]\nlaws = {named}\n")
    monkeypatch.syspath_prepend(str(tmp_path))
    monkeypatch.delitem(sys.modules, "my_laws", raising=False)
    monkeypatch.setattr(controller_files, "_installed", controller_files._installed.__wrapped__)
    assert simulate(SHORT, "mine").metrics == simulate(SHORT, controller_files.load("entry point laws")["mine"]).metrics


@pytest.mark.parametrize(
    ("text", "said"),
    [
        ("import sim_core\nclass Mine(:", r"mine\.py, line 2: SyntaxError"),
        ("import no_such_module", r"mine\.py, line 1: ModuleNotFoundError"),
        ("import sys\nsys.exit(3)", r"mine\.py, line 2: It ends the program"),
        ("def deeper():\n    deeper()\ndeeper()", r"mine\.py, line 2: RecursionError"),
        ("ä = 'not in UTF-8'", r"mine\.py.*: SyntaxError"),
        ("from sim_core import Controller", r"mine\.py: it has no class derived from sim_core\.Controller"),
        (TEXT.replace('"mine"', "3"), r"mine\.py: the id of Mine is no text"),
        (TEXT + "class Again(Mine):\n    pass\n", r"mine\.py: two controllers have the id mine"),
        ("", r"none\.py: it cannot be read"),
    ],
)
def test_a_file_that_cannot_be_used_says_why(file: Path, text: str, said: str) -> None:
    file.write_text(text, encoding="latin-1")
    with pytest.raises(ControllerFileError, match=said):
        load_controllers(file if text else file.with_name("none.py"))


@pytest.mark.parametrize(
    ("body", "said"),
    [
        ("return 1 / 0, 0.0", r"mine\.py, line 12: ZeroDivisionError: "),
        ("import sys; sys.exit(1)", r"mine\.py, line 12: It ends the program"),
        ("return self.force(seen)", r"mine\.py, line 12: RecursionError"),
        ("self.damping += 1.0; return 0.0, 0.0", None),  # a run changes a copy of its own
    ],
)
def test_a_controller_that_fails_is_told_with_its_line(file: Path, body: str, said: str | None) -> None:
    file.write_text(TEXT.replace("return -self.damping * seen.state[4], -self.damping * seen.state[4]", body))
    sentences = check_controller(mine(file))
    assert [bool(said and re.search(said, sentence)) for sentence in sentences] == [True] * bool(said), sentences
