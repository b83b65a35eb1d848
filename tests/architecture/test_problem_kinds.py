"""The list of problem kinds is what the code raises, what the proxy says, and what docs/api.md shows."""

import ast
import json
import re
from collections.abc import Iterator
from pathlib import Path

from backend.problem_kinds import KINDS, OF_STATUS, TYPES

ROOT = Path(__file__).parents[2]
ROW = re.compile(r"^\| `([a-z-]+)` \| ([\d, ]+) \| ([^|]+) \| ([^|]+) \|$", re.MULTILINE)
PROXY = re.compile(r"http-error status (\d+) content-type application/problem\+json string '(.*?)'")


def raised() -> Iterator[tuple[str, int | None]]:
    """Each kind that backend/ names, and the status beside it where it is written there."""
    for path in sorted((ROOT / "backend").rglob("*.py")):
        for call in ast.walk(ast.parse(path.read_text(encoding="utf-8"))):
            if not isinstance(call, ast.Call):
                continue
            name = getattr(call.func, "id", getattr(call.func, "attr", ""))
            if name in ("ProblemError", "problem"):
                named = [item.value for item in call.keywords if item.arg == "kind"]
            elif name == "_refuse":  # of a connection: status and kind
                named = call.args[1:2]
            else:
                continue
            first = call.args[0] if call.args else None
            status = first.value if isinstance(first, ast.Constant) and isinstance(first.value, int) else None
            if not named and status is not None:
                yield OF_STATUS[status].name, status
            constants = [each.value for node in named for each in ast.walk(node) if isinstance(each, ast.Constant)]
            yield from ((value, status) for value in constants if isinstance(value, str))


def proxied() -> Iterator[tuple[int, dict[str, object]]]:
    """What the proxy answers itself."""
    for status, text in PROXY.findall((ROOT / "backend" / "deploy" / "haproxy.cfg").read_text()):
        yield int(status), json.loads(text)


def test_what_is_raised_is_listed() -> None:
    found = list(raised())
    assert len(found) > 30
    wrong = [(kind, status) for kind, status in found if kind not in KINDS]
    wrong += [(kind, status) for kind, status in found if status is not None and status not in KINDS[kind].statuses]
    assert not wrong


def test_what_is_listed_is_raised() -> None:
    by_framework = {OF_STATUS[status].name for status in (400, 404, 405, 422)}
    by_proxy = {str(content["type"]).removeprefix(TYPES) for _, content in proxied()}
    assert set(KINDS) == {kind for kind, _ in raised()} | by_framework | by_proxy


def test_the_proxys_problems_are_of_the_list() -> None:
    found = list(proxied())
    assert {status for status, _ in found} >= {400, 403, 408, 413, 429, 500, 502, 503, 504}
    for status, content in found:
        kind = KINDS[str(content["type"]).removeprefix(TYPES)]
        assert (content["status"], content["title"]) == (status, kind.title)
        assert status in kind.statuses
        assert content["detail"]
        assert content["errors"] == []


def test_the_page_shows_each_with_its_statuses_its_meaning_and_an_example() -> None:
    rows = ROW.findall((ROOT / "docs" / "api.md").read_text(encoding="utf-8"))
    shown = {name: (statuses, meaning) for name, statuses, meaning, _ in rows}
    listed = {kind.name: (", ".join(map(str, kind.statuses)), kind.meaning) for kind in KINDS.values()}
    assert shown == listed
    assert [name for name, *_ in rows] == list(KINDS)
    assert all(example.strip() for *_, example in rows)
