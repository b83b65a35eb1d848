"""The manual as it is built: no broken link, nothing from elsewhere, every page in its table of contents."""

import re
import subprocess
import tomllib
from html.parser import HTMLParser
from pathlib import Path
from urllib.parse import unquote, urlsplit
from zipfile import ZipFile

import pytest

from tests.servers.process import ROOT


class Page(HTMLParser):
    """What a page names: `links` it follows, `loads` it needs, and `names` that an address may end with."""

    def __init__(self, path: Path) -> None:
        super().__init__()
        self.links: list[str] = []
        self.loads: list[str] = []
        self.names: set[str] = {""}
        self.feed(path.read_text(encoding="utf-8"))

    def handle_starttag(self, tag: str, attrs: list[tuple[str, str | None]]) -> None:
        values = {name: value for name, value in attrs if value is not None}
        self.names |= {values[name] for name in ("id", "name") if name in values}
        addresses = [values[name] for name in ("href", "src") if name in values]
        (self.links if tag == "a" else self.loads).extend(addresses)


@pytest.fixture(scope="module")
def built() -> Path:
    """The manual, as `make` has built it strictly from its sources."""
    manual = ROOT / "build/manual"
    sources = [file for folder in ("docs", "examples") for file in (ROOT / folder).rglob("*.*")]
    changed = max(path.stat().st_mtime for path in [ROOT / "zensical.toml", *sources])
    assert (manual / "index.html").stat().st_mtime >= changed, "make manual"
    return manual


def test_no_link_is_broken_and_nothing_comes_from_elsewhere(built: Path) -> None:
    pages = {path: Page(path) for path in built.rglob("index.html")}
    assert len(pages) > 40
    for path, page in pages.items():
        assert not [address for address in page.loads if urlsplit(address).netloc], path
        for address in [*page.links, *page.loads]:
            parts = urlsplit(address)
            if parts.scheme or parts.netloc or parts.path == "/":  # the lab's own page
                continue
            target = (path.parent / unquote(parts.path)).resolve() if parts.path else path
            target = target / "index.html" if target.is_dir() else target
            assert target.is_relative_to(built), f"{path}: {address}"
            assert target.is_file(), f"{path}: {address}"
            if target in pages:
                assert unquote(parts.fragment) in pages[target].names, f"{path}: {address}"


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


def test_styles_load_nothing_from_elsewhere(built: Path) -> None:
    styles = [path.read_text(encoding="utf-8") for path in built.rglob("*.css")]
    assert styles
    assert [address for style in styles for address in re.findall(r"url\(['\"]?(https?:|//)", style)] == []


def test_the_table_of_contents_has_every_page() -> None:
    text = (ROOT / "zensical.toml").read_text()
    tomllib.loads(text)
    pages = {str(path.relative_to(ROOT / "docs")) for path in (ROOT / "docs").rglob("*.md")}
    decisions = {page for page in pages if page.startswith("decisions/0")}  # their own index lists them
    assert set(re.findall(r'"([\w/-]+\.md)"', text)) == pages - decisions
