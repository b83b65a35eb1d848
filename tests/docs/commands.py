"""Runs the commands and cells of a page in order, and compares what they print with what the page shows.

Which pages: those of README and manual that print a command, or ask a service. tests/architecture/test_documentation.py
runs the cells of the others.
"""

import io
import os
import re
import shlex
import subprocess
import sys
from collections.abc import Callable
from contextlib import closing, redirect_stderr, redirect_stdout
from difflib import SequenceMatcher
from pathlib import Path

import pytest

from ridelab import Ridelab
from ridelab.cli import app
from tests.client.cli import environment
from tests.docs.sources import ROOT
from tests.servers.programs import find

UPDATE = bool(os.environ.get("UPDATE_DOCS"))
ADDRESS = "http://127.0.0.1:8000"
BLOCK = re.compile(
    r"^```(console|python)\n(.*?)^```\n(?:\nIt prints:\n\n```text\n(.*?)^```\n)?", re.DOTALL | re.MULTILINE
)
WORD = r"(?:'[^']*'|[^\s'\"|<>&;$`*])+"
COMMAND = re.compile(rf"(ridelab(?: {WORD})+)( ?[|>;].*)?")  # and what a shell does with its output
LONGEST = 18  # lines of an output that a page shows; what follows is "..."
WIDEST = 240  # characters of a line
# What changes from run to run: random ids, times of day, how long something took, how often progress was heard of;
# and digits beyond those that every machine computes alike.
CHANGING: tuple[tuple[re.Pattern[str], str | Callable[[re.Match[str]], str]], ...] = (
    (re.compile(r"(?<![\w-])[\w-]{22}(?![\w-])"), "ID"),
    (re.compile(r'"request_id":"\w+"'), '"request_id":"ID"'),
    (re.compile(r" +[\d.]+ ms$", re.MULTILINE), " MS"),
    (re.compile(r"about [\d.]+ s$", re.MULTILINE), "about SECONDS"),
    (re.compile(r'_(cost|seconds)":[\d.e-]+'), '_SECONDS":SECONDS'),
    (re.compile(r"\d{4}-\d\d-\d\dT[\d:.]+(?:Z|\+00:00)"), "TIME"),
    (re.compile(r'("state":"cancelled",.*?"done":)\d+'), r"\1DONE"),
    (re.compile(r"(event: progress\ndata: .*\n)id: \d+\n\n"), ""),
    (re.compile(r"^id: \d+$", re.MULTILINE), "id: NUMBER"),
    (re.compile(r"\d+\.\d{7,}"), lambda match: f"{float(match[0]):.6g}"),
)


class Page:
    """A page's commands, run in one folder one after the other: Python and `ridelab` here, all else by a shell."""

    def __init__(self, name: str, address: str) -> None:
        self.path = ROOT / name
        self._address = address
        self._variables: dict[str, object] = {"__name__": "__main__"}  # which later cells go on with
        self._ids: dict[str, str] = {}  # of the last batch, run and link, for commands that name BATCH, RUN, SLUG

    def again(self) -> str:
        """The page with what its commands print now."""
        return BLOCK.sub(lambda match: self._block(*match.groups()), self.path.read_text(encoding="utf-8"))

    def _block(self, kind: str, text: str, _: str | None) -> str:
        if kind == "python":
            printed = Output()
            with redirect_stdout(printed), redirect_stderr(printed):
                exec(text.replace(ADDRESS, self._address), self._variables)  # noqa: S102 - ours
            return f"```python\n{text}```\n\nIt prints:\n\n```text\n{self._shown(printed.content)}```\n"
        commands = [line for line in text.splitlines() if line.startswith("$ ")]
        shown = "".join(f"{line}\n{self._shown(output(self._prepared(line[2:])))}" for line in commands)
        return f"```console\n{shown}```\n"

    def close(self) -> None:
        """Close the clients that its cells have made."""
        for each in self._variables.values():
            if isinstance(each, Ridelab):
                each.close()

    def _prepared(self, command: str) -> str:
        for word, name in self._ids.items():
            command = command.replace(word, name)
        return command.replace(ADDRESS, self._address)

    def _shown(self, printed: bytes) -> str:
        text = printed.decode()
        assert "Traceback" not in text, text
        if match := re.match(r'\{"id":"([\w-]{22})","(state)?', text) or re.search(r"/r/([\w-]{22})()", text):
            self._ids["BATCH" if match[2] else "RUN"] = match[1]
        if match := re.match(r'\{"slug":"([\w-]{22})"', text):
            self._ids["SLUG"] = match[1]
        lines = text.replace(self._address, ADDRESS).splitlines()
        cut = [line if len(line) <= WIDEST else f"{line[:WIDEST]}..." for line in lines[:LONGEST]]
        return "".join(f"{line.rstrip()}\n" for line in [*cut, *(["..."] if len(lines) > LONGEST else [])])


def output(line: str) -> bytes:
    """What a line prints: a first `ridelab` is run in this process, which has all imported, the rest by a shell."""
    match = COMMAND.fullmatch(line)
    if match is None:
        return shell(line)
    printed, said, code = Output(), Output(), 0
    command, rest = match.groups()
    with redirect_stdout(printed), redirect_stderr(said if rest else printed):
        code = app.run(shlex.split(command)[1:])
    return said.content + (shell(f"(cat; exit {code}){rest}", printed.content) if rest else printed.content)


class Output(io.TextIOWrapper):
    """A standard output that keeps what it gets."""

    def __init__(self) -> None:
        super().__init__(io.BytesIO(), write_through=True)

    @property
    def content(self) -> bytes:
        """All of it."""
        assert isinstance(self.buffer, io.BytesIO)
        return self.buffer.getvalue()


def shell(command: str, given: bytes = b"") -> bytes:
    """A shell line's output, with errors, so that a page without errors has none."""
    find("curl", package="curl")
    server = os.environ["RIDELAB_SERVER"]
    path = f"{Path(sys.executable).parent}{os.pathsep}{os.environ['PATH']}"
    variables = environment(PATH=path, PYTHONUNBUFFERED="1", RIDELAB_SERVER=server)
    words = ["sh", "-c", command]
    return subprocess.run(
        words, env=variables, check=False, input=given, stdout=subprocess.PIPE, stderr=subprocess.STDOUT
    ).stdout


def with_changed_lines(old: str, new: str) -> str:
    """Return the new text, with the old one's lines where only values differ that change from run to run."""
    before, after = old.splitlines(keepends=True), new.splitlines(keepends=True)
    comparable, again = ([without_changing_values(line) for line in lines] for lines in (before, after))
    for start, place, length in SequenceMatcher(None, comparable, again, autojunk=False).get_matching_blocks():
        after[place : place + length] = before[start : start + length]
    return "".join(after)


def without_changing_values(text: str) -> str:
    """Without what changes from run to run."""
    for pattern, word in CHANGING:
        text = pattern.sub(word, text)
    return text


def check(name: str, address: str, folder: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    """Compare a page with what its commands print now, or write that into it.

    Args:
        name: Its path in the repository.
        address: Of the service that its commands ask.
        folder: Where its commands write.
        monkeypatch: Of the test.
    """
    monkeypatch.chdir(folder)
    (folder / "examples").symlink_to(ROOT / "examples")
    monkeypatch.setenv("RIDELAB_SERVER", address)
    page = Page(name, address)
    with closing(page):
        again = page.again()
    if UPDATE:
        written = with_changed_lines(page.path.read_text(encoding="utf-8"), again)
        page.path.write_text(written, encoding="utf-8")
    assert without_changing_values(page.path.read_text(encoding="utf-8")) == without_changing_values(again)
