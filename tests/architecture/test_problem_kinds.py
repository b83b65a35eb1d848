"""The list of problem kinds against what the proxy says, and what docs/reference/api.md shows."""

import json
import re
from collections.abc import Iterator
from pathlib import Path

from backend.http.problem_types import KINDS, TYPES

ROOT = Path(__file__).parents[2]
ROW = re.compile(r"^\| `([a-z-]+)` \| ([\d, ]+) \| ([^|]+) \| ([^|]+) \| ([^|]+) \|$", re.MULTILINE)
PROXY = re.compile(r"http-error status (\d+) content-type application/problem\+json lf-string '(.*?)'")


def proxied() -> Iterator[tuple[int, dict[str, object]]]:
    """The problems that the proxy answers itself."""
    for status, text in PROXY.findall((ROOT / "backend" / "deploy" / "haproxy.cfg").read_text()):
        yield int(status), json.loads(text)


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
