"""The reference pages of docs/ are what the code says: every field, preset, strategy, signal, erratum and formula.

And every public name of the core has an example that runs.
"""

import doctest
import os
import re
from collections import Counter
from collections.abc import Callable
from pathlib import Path

import pytest

import sim_core
from backend.paper import errata
from tests.docs import scenario_reference

ROOT = Path(__file__).parents[2]
BLOCK = re.compile(r"^```python\n(.*?)^```$", re.DOTALL | re.MULTILINE)
CONSTANTS_AND_TYPES = {"STRATEGIES", "FloatArray", "Preview", "SpeedPlan", "Weights"}  # they have no docstring
PARTS = set(sim_core.scenario.__all__) - {"Scenario"}  # Scenario's example shows how they make one
PUBLIC = sorted(set(sim_core.__all__) - CONSTANTS_AND_TYPES - PARTS)


@pytest.mark.parametrize(("page", "name"), [(scenario_reference.page, "scenario.md"), (errata.page, "errata.md")])
def test_a_reference_page_is_what_the_core_says(page: Callable[[], str], name: str) -> None:
    """UPDATE_DOCS=1 writes it."""
    path = ROOT / "docs/reference" / name
    if os.environ.get("UPDATE_DOCS"):
        path.write_text(page(), encoding="utf-8")
    assert path.read_text(encoding="utf-8") == page()


@pytest.mark.parametrize("name", ["README.md", "sim_core/README.md", "docs/explanation/physics.md"])
def test_the_python_blocks_of_a_page_run(name: str) -> None:
    """In order, each with the names of those before; a traceback has the page's lines. Those of physics.md compare."""
    path = ROOT / name
    page, names = path.read_text(encoding="utf-8"), dict[str, object](__name__="page")
    blocks = list(BLOCK.finditer(page))
    assert blocks
    for block in blocks:
        above = "\n" * page.count("\n", 0, block.start(1))
        exec(compile(above + block[1], str(path), "exec"), names)  # noqa: S102 - our own page


def test_a_symbol_has_one_meaning() -> None:
    page = (ROOT / "docs/reference/nomenclature.md").read_text(encoding="utf-8")
    rows = re.findall(r"^\| (?!symbol)([^|]+?) \|", page, re.MULTILINE)
    symbols = Counter(symbol for row in rows for symbol in row.split(", "))
    assert len(symbols) > 50
    assert [symbol for symbol, rows in symbols.items() if rows > 1] == []


def test_the_parts_of_a_scenario_are_public_in_the_package_itself() -> None:
    assert set(sim_core.scenario.__all__) < set(sim_core.__all__)


@pytest.mark.parametrize("name", [*PUBLIC, "sim_core"])
def test_a_public_name_has_an_example_that_runs(name: str) -> None:
    """Of a class in its own docstring; the package's shows the names that have none, constants and types."""
    public = getattr(sim_core, name, sim_core)
    finder = doctest.DocTestFinder(recurse=False)
    examples = [each for each in finder.find(public, name, globs={}) if each.examples]
    assert examples, f"sim_core.{name} has no example"
    said: list[str] = []
    failed = [doctest.DocTestRunner().run(each, out=said.append).failed for each in examples]
    assert not any(failed), "".join(said)
