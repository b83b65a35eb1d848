"""Each command that README, manual and page name is one that there is, with options that it has.

What commands after a `$` print is in test_commands.py; those that only say what could be typed are read here.
"""

import re
import shlex
from collections.abc import Iterator
from typing import Any

import pytest
import typer.main
from typer.core import TyperGroup

from ridelab.cli.app import app
from tests.docs.sources import ROOT, pages

BY_NAME = re.compile(
    r"pip install(?: -\S+| '?[\w./*\[\]-]+'?)*? '?ridelab(?:-core|-server)?(?:\[\w+\])?'?(?![\w./*-])|--find-links"
)
BEGINS = r"(?:^|^\$ |[|&;] ?|\brun: |\b[A-Z_]{3,}(?:=\S+)? )"  # a line, or the command after another one or a variable
NAMED = re.compile(rf"{BEGINS}ridelab((?: (?:'[^']*'|\"[^\"]*\"|[^\s`|>;&'\"]+))+)")
CONTINUED = re.compile(r" *\\\n\s*")
PAGES = {name: text for name, text in pages().items() if name != "CHANGELOG.md" and "/decisions/" not in name}


def named(text: str) -> Iterator[list[str]]:
    """Return the words behind each `ridelab` that is code: in a block, or between backticks."""
    text = CONTINUED.sub(" ", text)
    blocks = re.findall(r"^```(?:console|yaml|text)\n(.*?)^```|^((?: {4}.*\n)+)", text, re.DOTALL | re.MULTILINE)
    prose = re.sub(r"^```\w*\n.*?^```", "", text, flags=re.DOTALL | re.MULTILINE)
    code = [part for pair in blocks for part in pair] + re.findall(r"`([^`]+)`", prose)
    for part in code:
        for line in part.splitlines():
            yield from (shlex.split(match[1]) for match in NAMED.finditer(line.strip()))


def faults(words: list[str]) -> Iterator[str]:
    """Return what of such a line there is not: the command, or one of its options."""
    command: Any = typer.main.get_command(app)
    while words and isinstance(command, TyperGroup) and words[0] in command.commands:
        command, words = command.commands[words[0]], words[1:]
    options = {spelling for each in command.params for spelling in (*each.opts, *each.secondary_opts)} | {"--help"}
    yield from (word for word in words if word.startswith("--") and word.partition("=")[0].rstrip("…,.") not in options)
    if isinstance(command, TyperGroup) and words and words[0].isalpha() and words[0].islower():
        yield words[0]


@pytest.mark.parametrize("name", [name for name, text in PAGES.items() if "ridelab " in text])
def test_a_command_that_a_page_names_is_there_with_its_options(name: str) -> None:
    wrong = [(fault, " ".join(words)) for words in named(PAGES[name]) for fault in faults(words)]
    assert wrong == []


def test_nobody_is_told_to_install_ours_by_names_that_anybody_may_take() -> None:
    """Files by their paths: the public index would be asked for the names, and nobody owns them there."""
    sources = [path for folder in ("client/ridelab", "backend", "sim_core") for path in (ROOT / folder).rglob("*.py")]
    texts = {**PAGES, **{str(path): path.read_text(encoding="utf-8") for path in sources}}
    assert [name for name, text in texts.items() if BY_NAME.search(text)] == []


def test_the_page_on_installing_names_every_platform_that_is_built() -> None:
    platforms = re.findall(
        r"(\w+):\S+-\S+", (ROOT / "Makefile").read_text().partition("PLATFORMS :=")[2].partition("\n\n")[0]
    )
    assert len(platforms) == 5
    assert [name for name in platforms if f"{name}.whl" not in PAGES["docs/how-to/install.md"]] == []
