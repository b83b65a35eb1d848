"""The list of problem kinds is what the code raises, what the proxy says, and what docs/reference/api.md shows."""

import ast
import json
import re
from collections.abc import Iterator
from pathlib import Path

from backend.http.kinds import KINDS, OF_STATUS, TYPES

ROOT = Path(__file__).parents[2]
ROW = re.compile(r"^\| `([a-z-]+)` \| ([\d, ]+) \| ([^|]+) \| ([^|]+) \| ([^|]+) \|$", re.MULTILINE)
PROXY = re.compile(r"http-error status (\d+) content-type application/problem\+json lf-string '(.*?)'")


def raised() -> Iterator[str]:
    """Each kind that backend/ names: of a class of errors, of one error, or of an answer."""
    for path in sorted((ROOT / "backend").rglob("*.py")):
        for node in ast.walk(ast.parse(path.read_text(encoding="utf-8"))):
            named: list[ast.expr] = []
            if isinstance(node, ast.Call):
                name = getattr(node.func, "id", getattr(node.func, "attr", ""))
                if name.endswith("Error"):
                    named = [item.value for item in node.keywords if item.arg == "kind"]
                if name in ("RequestError", "problem") or getattr(node.func, "attr", "") == "_refuse":
                    named += node.args[:1]
            elif isinstance(node, ast.ClassDef) and node.name.endswith("Error"):
                fields = [each for each in node.body if isinstance(each, ast.Assign)]
                named = [each.value for each in fields if getattr(each.targets[0], "id", "") == "kind"]
            constants = [each.value for value in named for each in ast.walk(value) if isinstance(each, ast.Constant)]
            yield from (value for value in constants if isinstance(value, str))


def proxied() -> Iterator[tuple[int, dict[str, object]]]:
    """The problems that the proxy answers itself."""
    for status, text in PROXY.findall((ROOT / "backend" / "deploy" / "haproxy.cfg").read_text()):
        yield int(status), json.loads(text)


def test_what_is_raised_is_listed_and_what_is_listed_is_raised() -> None:
    by_framework = {OF_STATUS[status].name for status in (400, 404, 405, 422)}
    by_proxy = {str(content["type"]).removeprefix(TYPES) for _, content in proxied()}
    assert {*raised(), *by_framework, *by_proxy} == set(KINDS)


def test_the_proxys_problems_are_of_the_list() -> None:
    problems = list(proxied())
    assert {status for status, _ in problems} >= {400, 403, 408, 413, 429, 500, 502, 503, 504}
    for status, content in problems:
        kind = KINDS[str(content["type"]).removeprefix(TYPES)]
        assert (content["status"], content["title"]) == (status, kind.title)
        assert status in kind.statuses
        assert content["detail"]
        assert content["errors"] == []
        assert content["request_id"] == "%[unique-id]"


def test_the_page_shows_each_with_its_statuses_its_meaning_what_to_do_and_an_example() -> None:
    rows = ROW.findall((ROOT / "docs/reference/api.md").read_text(encoding="utf-8"))
    shown = {name: (statuses, meaning, remedy) for name, statuses, meaning, remedy, _ in rows}
    listed = {kind.name: (", ".join(map(str, kind.statuses)), kind.meaning, kind.remedy) for kind in KINDS.values()}
    assert shown == listed
    assert [name for name, *_ in rows] == list(KINDS)
    assert all(example.strip() for *_, example in rows)
