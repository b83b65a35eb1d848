"""What names the program that computes a result: whatever may change a number."""

import importlib.util
import sys
from pathlib import Path

import pytest

from sim_core import STRATEGIES, Controller, program
from sim_core.program import program as named
from tests.there import there


def test_it_is_named_by_version_c_and_osqp() -> None:
    for strategy in STRATEGIES.values():
        assert set(named(strategy)) == {"core", "kernel", "osqp", "controller"}


@pytest.mark.parametrize("part", ["DIGEST", "_osqp"])
def test_another_c_or_solver_is_another_program(part: str, monkeypatch: pytest.MonkeyPatch) -> None:
    before = named(STRATEGIES["lv"])
    monkeypatch.setattr(program, part, "another" if part == "DIGEST" else lambda: "0")
    assert named(STRATEGIES["lv"]) != before


def test_a_law_is_named_by_its_file(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    file = tmp_path / "my_law.py"

    def law(text: str) -> type[Controller]:
        file.write_text(text)
        spec = there(importlib.util.spec_from_file_location("my_law", file))
        module = importlib.util.module_from_spec(spec)
        monkeypatch.setitem(sys.modules, "my_law", module)
        there(spec.loader).exec_module(module)
        own: type[Controller] = module.Own
        return own

    text = "import sim_core\n\nclass Own(sim_core.Controller):\n    id = 'own'\n"
    first = named(law(text))
    assert named(law(text)) == first
    assert named(law(text + "    label = 'Own'\n")) != first
