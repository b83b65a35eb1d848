"""Requests that are refused, each with its words: those of tests/data/refusals.json, which UPDATE_DOCS=1 writes."""

import json
import os
from pathlib import Path
from typing import Any

import httpx
import pytest

from tests.api.test_problems import check

FILE = Path(__file__).parents[1] / "data" / "refusals.json"


def refused(group: str) -> pytest.MarkDecorator:
    """Give the test each `case` of a group of the file."""
    cases = _read()[group]
    return pytest.mark.parametrize("case", cases, ids=[f"{group}-{number}" for number in range(len(cases))])


def check_refused(client: httpx.Client, case: dict[str, Any], **ids: str) -> httpx.Response:
    """Send a case's request, in which these words stand for ids, and check what its refusal says; return it.

    A body is what the case changes of its address's usual one.
    """
    known = json.loads(_with(ids, json.dumps({"usual": _read()["usual"], **case})))
    path, query = known["path"], known.get("query")
    if query is None:
        answer = client.post(f"/api/v1/{path}", json=known["usual"].get(path, {}) | known["body"])
    else:
        answer = client.get(f"/api/v1/{path}", params=query)
    check(answer, 422, str(answer.json()["type"]).rpartition(":")[2])
    errors = [f"{each.get('parameter') or each['pointer']}: {each['message']}" for each in answer.json()["errors"]]
    said = json.loads(_with({value: name for name, value in ids.items()}, json.dumps(errors)))
    if os.environ.get("UPDATE_DOCS"):
        _write(case, said)
    else:
        assert said == case["says"], said
    return answer


def _with(words: dict[str, str], text: str) -> str:
    for word, other in words.items():
        text = text.replace(word, other)
    return text


def _read() -> dict[str, Any]:
    content: dict[str, Any] = json.loads(FILE.read_text(encoding="utf-8"))
    return content


def _write(case: dict[str, Any], said: list[str]) -> None:
    """Write the file, each case on a line of its own, with these words for this one."""
    content = _read()
    parts = [f'"usual": {json.dumps(content.pop("usual"))}']
    for group, cases in content.items():
        written = [json.dumps({**each, "says": said} if each == case else each, ensure_ascii=False) for each in cases]
        parts.append(f'"{group}": [\n  ' + ",\n  ".join(written) + "\n]")
    FILE.write_text("{\n" + ",\n".join(parts) + "\n}\n", encoding="utf-8")
