"""The manual as it is built: nothing from elsewhere, every page in its table of contents, every example in its file.

That no link is broken is seen in the sources (test_repository.py) and by the build itself.
"""

import re
import subprocess
import tomllib
from pathlib import Path
from zipfile import ZipFile

import pytest

from tests.servers.process import ROOT

ELSEWHERE = re.compile(
    r"""<(?:link|script|img|iframe|source)\b[^>]*\b(?:src|href)=["']?(?:https?:)?//|url\(['"]?(?:https?:)?//"""
)


@pytest.fixture(scope="module")
def built() -> Path:
    """The manual, as `make` has built it strictly from its sources."""
    manual = ROOT / "build/manual"
    sources = [file for folder in ("docs", "examples") for file in (ROOT / folder).rglob("*.*")]
    changed = max(path.stat().st_mtime for path in [ROOT / "zensical.toml", *sources])
    assert (manual / "index.html").stat().st_mtime >= changed, "make manual"
    return manual


def test_pages_and_styles_load_nothing_from_elsewhere(built: Path) -> None:
    files = [*built.rglob("*.html"), *built.rglob("*.css")]
    assert len(files) > 40
    assert [path for path in files if ELSEWHERE.search(path.read_text(encoding="utf-8"))] == []


def test_the_examples_that_its_commands_name_are_in_it(built: Path) -> None:
    named = {
        name
        for page in (ROOT / "docs").rglob("*.md")
        for name in re.findall(r"examples/[\w/-]+\.\w+", page.read_text())
    }
    assert len(named) >= 3
    tracked = subprocess.run(["git", "ls-files", "examples"], cwd=ROOT, capture_output=True, text=True, check=True)
    there = {each for each in ZipFile(built / "examples.zip").namelist() if not each.endswith("/")}
    assert named <= there == set(tracked.stdout.splitlines())


def test_the_table_of_contents_has_every_page() -> None:
    text = (ROOT / "zensical.toml").read_text()
    tomllib.loads(text)
    pages = {str(path.relative_to(ROOT / "docs")) for path in (ROOT / "docs").rglob("*.md")}
    decisions = {page for page in pages if page.startswith("decisions/0")}  # their own index lists them
    assert set(re.findall(r'"([\w/-]+\.md)"', text)) == pages - decisions
