"""docs/cli.md, docs/api.md and docs/robustness.md: what they show is what the commands print, run here again in order.

`UPDATE_DOCS=1 python -m pytest tests/api/test_cli_docs.py` prints the outputs into the pages anew.
"""

import os
import re
import subprocess
import sys
from collections.abc import Callable
from pathlib import Path

import httpx
import pytest

ROOT = Path(__file__).parents[2]
UPDATE = bool(os.environ.get("UPDATE_DOCS"))
ADDRESS = "http://127.0.0.1:8000"
BLOCK = re.compile(
    r"^```(console|python)\n(.*?)^```\n(?:\nIt prints:\n\n```text\n(.*?)^```\n)?", re.DOTALL | re.MULTILINE
)
LONGEST = 18  # lines of an output that a page shows; what follows is "..."
WIDEST = 240  # characters of a line
# What changes from run to run: random ids, times of day, how long something took, how often progress was heard of;
# and digits beyond those that every machine computes alike.
CHANGING: tuple[tuple[re.Pattern[str], str | Callable[[re.Match[str]], str]], ...] = (
    (re.compile(r"(?<![\w-])[\w-]{22}(?![\w-])"), "ID"),
    (re.compile(r'"request_id":"\w+"'), '"request_id":"ID"'),
    (re.compile(r" +[\d.]+ ms$", re.MULTILINE), " MS"),
    (re.compile(r"about [\d.]+ s$", re.MULTILINE), "about SECONDS"),
    (re.compile(r'"estimated_seconds":[\d.e-]+'), '"estimated_seconds":SECONDS'),
    (re.compile(r"\d{4}-\d\d-\d\dT[\d:.]+(?:Z|\+00:00)"), "TIME"),
    (re.compile(r'("state":"cancelled",.*?"done":)\d+'), r"\1DONE"),
    (re.compile(r"(event: progress\ndata: .*\n)id: \d+\n\n"), ""),
    (re.compile(r"^id: \d+$", re.MULTILINE), "id: NUMBER"),
    (re.compile(r"\d+\.\d{7,}"), lambda found: f"{float(found[0]):.6g}"),
)
# What the pages' curl commands need of curl, so that a machine without it can run them too.
CURL = f"""#!{sys.executable}
import argparse, httpx
parser = argparse.ArgumentParser()
parser.add_argument("-s", action="store_true", required=True)
parser.add_argument("-H", action="append", default=[])
parser.add_argument("-d")
parser.add_argument("-X")
parser.add_argument("url")
options = parser.parse_args()
headers = dict(header.split(": ", 1) for header in options.H)
method = options.X or ("GET" if options.d is None else "POST")
print(httpx.request(method, options.url, headers=headers, content=options.d, timeout=60).text, end="")
"""


class Page:
    """A page's commands, run in one folder one after the other."""

    def __init__(self, name: str, address: str, folder: Path) -> None:
        self.path = ROOT / "docs" / name
        self._address, self._folder = address, folder
        self._ids: dict[str, str] = {}  # of the last batch, run and link, for commands that name BATCH, RUN, SLUG
        if not UPDATE:
            shim = folder / "curl"
            shim.write_text(CURL, encoding="utf-8")
            shim.chmod(0o755)

    def again(self) -> str:
        """The page with what its commands print now."""
        return BLOCK.sub(lambda found: self._block(*found.groups()), self.path.read_text(encoding="utf-8"))

    def _block(self, kind: str, text: str, _: str | None) -> str:
        if kind == "python":
            printed = self._run([sys.executable, "-c", text.replace(ADDRESS, self._address)])
            return f"```python\n{text}```\n\nIt prints:\n\n```text\n{printed}```\n"
        commands = [line for line in text.splitlines() if line.startswith("$ ")]
        shown = "".join(f"{line}\n{self._run(['bash', '-c', self._prepared(line[2:])])}" for line in commands)
        return f"```console\n{shown}```\n"

    def _prepared(self, command: str) -> str:
        for word, name in self._ids.items():
            command = command.replace(word, name)
        return command.replace(ADDRESS, self._address)

    def _run(self, command: list[str]) -> str:
        run = subprocess.run(
            command,
            cwd=self._folder,
            env={
                **os.environ,
                "PATH": os.pathsep.join([str(self._folder), str(Path(sys.executable).parent), os.environ["PATH"]]),
                "PYTHONPATH": str(ROOT),
                "RIDELAB_SERVER": self._address,
            },
            stdout=subprocess.PIPE,
            stderr=subprocess.STDOUT,
            text=True,
            check=False,
        )
        assert "Traceback" not in run.stdout, run.stdout
        if found := re.match(r'\{"id":"([\w-]{22})","(state)?', run.stdout) or re.search(
            r"/r/([\w-]{22})()", run.stdout
        ):
            self._ids["BATCH" if found[2] else "RUN"] = found[1]
        if found := re.match(r'\{"slug":"([\w-]{22})"', run.stdout):
            self._ids["SLUG"] = found[1]
        lines = run.stdout.replace(self._address, ADDRESS).splitlines()
        cut = [line if len(line) <= WIDEST else f"{line[:WIDEST]}..." for line in lines[:LONGEST]]
        return "".join(f"{line.rstrip()}\n" for line in [*cut, *(["..."] if len(lines) > LONGEST else [])])


def lasting(text: str) -> str:
    """Without what changes from run to run."""
    for pattern, word in CHANGING:
        text = pattern.sub(word, text)
    return text


@pytest.mark.parametrize("name", ["cli.md", "api.md", "robustness.md"])
def test_a_page_shows_what_its_commands_print(name: str, client: httpx.Client, tmp_path: Path) -> None:
    page = Page(name, str(client.base_url).rstrip("/"), tmp_path)
    again = page.again()
    if UPDATE:
        page.path.write_text(again, encoding="utf-8")
    assert lasting(page.path.read_text(encoding="utf-8")) == lasting(again)
