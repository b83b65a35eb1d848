"""tests/README.md names every folder of tests and every fixture that several files share."""

import ast
import re
from pathlib import Path

TESTS = Path(__file__).parents[1]
PAGE = (TESTS / "README.md").read_text(encoding="utf-8")


def test_every_shared_fixture_is_on_the_page_and_no_other() -> None:
    files = [*TESTS.glob("*/conftest.py"), *TESTS.glob("*/fixtures.py")]
    shared = {
        node.name
        for file in files
        for node in ast.parse(file.read_text(encoding="utf-8")).body
        if isinstance(node, ast.FunctionDef) and any("fixture" in ast.unparse(each) for each in node.decorator_list)
    }
    rows = re.findall(r"^\| (`[^|]*`) \|", PAGE, re.MULTILINE)
    assert set(re.findall(r"`(\w+)`", " ".join(rows))) == shared


def test_every_folder_is_on_the_page() -> None:
    (table,) = re.findall(r"^\| folder .*?\n\n", PAGE, re.MULTILINE | re.DOTALL)
    named = {name for row in table.strip().splitlines()[2:] for name in row.split("|")[1].strip().split(", ")}
    assert named == {path.name for path in TESTS.iterdir() if path.is_dir() and path.name != "__pycache__"}
