"""The reference pages of docs/ are what the code says: every field, preset, strategy, signal, erratum and formula.

And every public name of the core has an example that runs.
"""

import doctest
import io
import json
import os
import re
from collections import Counter
from collections.abc import Callable
from contextlib import redirect_stdout
from pathlib import Path
from typing import Any

import pytest

import sim_core
from backend.paper import errata
from sim_core.catalogue import COMFORT, EVENTS, METRIC_SIGNALS, RUN_FIGURES
from sim_core.scenario import SCHEMA_VERSION, dotted
from tests.docs import library_reference, scenario_reference
from tests.docs.drawing import chart
from tests.docs.sources import ROOT, with_cells_alone

BLOCK = re.compile(r"^```python\n(.*?)^```$(?:\n\nIt prints:\n\n```text\n(.*?)^```$)?", re.DOTALL | re.MULTILINE)
PRINTS = "\n\nIt prints:\n\n```text\n{}```"
FIGURE = re.compile(r"^!\[([^\]]*)\]\(([^)]+\.svg)\)$", re.MULTILINE)
GALLERY_LINK = re.compile(r"\]\(/\?gallery=([\w-]+)\)")
CONSTANTS_AND_TYPES = {"STRATEGIES", "FloatArray", "Preview", "SpeedPlan", "Weights"}  # they have no docstring
PARTS = set(sim_core.scenario.__all__) - {"Scenario"}  # Scenario's example shows how they make one
PUBLIC = sorted(set(sim_core.__all__) - CONSTANTS_AND_TYPES - PARTS)


REFERENCE = {
    "scenario.md": scenario_reference.page,
    "errata.md": errata.page,
    "library.md": library_reference.library,
    "client.md": library_reference.client,
}


@pytest.mark.parametrize(("name", "page"), REFERENCE.items())
def test_a_reference_page_is_what_the_code_says(name: str, page: Callable[[], str]) -> None:
    """UPDATE_DOCS=1 writes it."""
    compare(ROOT / "docs/reference" / name, page())


@pytest.mark.parametrize("name", with_cells_alone())
def test_the_python_blocks_of_a_page_run(name: str) -> None:
    """In order, each with the names of those before; a traceback has the page's lines. Those of explanations compare.

    What a page says that a block prints, it prints. A block that sets `curves` and `axes` is the figure above it; one
    that sets `scenario` too is the file named there. UPDATE_DOCS=1 writes all of these.
    """
    path = ROOT / name
    page, names = path.read_text(encoding="utf-8"), dict[str, object](__name__="page")
    assert BLOCK.search(page)

    def again(block: re.Match[str]) -> str:
        above = "\n" * page.count("\n", 0, block.start(1))
        for figure in ("curves", "axes", "scenario"):
            names.pop(figure, None)
        with redirect_stdout(io.StringIO()) as printed:
            exec(compile(above + block[1], str(path), "exec"), names)  # noqa: S102 - our own page
        if "curves" in names:
            compare_figure(path.parent, page[: block.start()], names)
        return f"```python\n{block[1]}```" + (PRINTS.format(printed.getvalue()) if block[2] is not None else "")

    compare(path, BLOCK.sub(again, page))


def compare_figure(folder: Path, above: str, names: dict[str, Any]) -> None:
    title, picture = FIGURE.findall(above)[-1]
    compare(folder / picture, chart(names["curves"], names["axes"], title))
    if isinstance(scenario := names.get("scenario"), sim_core.Scenario):
        name = GALLERY_LINK.findall(above)[-1]
        compare(folder / f"{name}.json", json.dumps(whole(scenario), indent=1) + "\n")


def whole(scenario: sim_core.Scenario) -> dict[str, Any]:
    """As the page saves it in a file: a measured road goes with its heights."""
    written = scenario.model_dump(mode="json")
    if scenario.road.profile is None:
        return written
    road = (ROOT / "docs/roads/street.csv").read_text(encoding="utf-8")
    return {"schema_version": SCHEMA_VERSION, "scenario": written, "measured_road": road}


def compare(path: Path, content: str) -> None:
    """Hold a file to what it should be, or write that with UPDATE_DOCS=1."""
    if os.environ.get("UPDATE_DOCS"):
        path.write_text(content, encoding="utf-8")
    assert path.read_text(encoding="utf-8") == content, f"{path.name} is another one: UPDATE_DOCS=1"


def test_every_name_with_a_question_mark_on_the_page_has_one_place_in_the_manual() -> None:
    """Those of ui/ManualLink.tsx: fields by their dotted names, weights by their row, metrics and strategies by theirs.

    Headings are places too: a browser goes to the first one of a name.
    """
    page = (ROOT / "docs/reference/scenario.md").read_text(encoding="utf-8")
    headings = [heading.lower().replace(" ", "-") for heading in re.findall(r"^#+ (.+)$", page, re.MULTILINE)]
    places = Counter(re.findall(r'<a id="([^"]+)"></a>', page)) + Counter(headings)
    fields = {re.sub(r"\.\d+$", "", name) for name in dotted.fields()}
    metrics = {*METRIC_SIGNALS, *COMFORT, *RUN_FIGURES, *EVENTS}
    assert [name for name in (*fields, *metrics, *sim_core.STRATEGIES, "strategies") if places[name] != 1] == []


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
