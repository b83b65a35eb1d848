"""Requests that are refused, each with its words: those of api_refusals and own_refusals in tests/data/wording."""

import json
from typing import Any

import httpx

from backend.http.openapi import EXAMPLES
from tests import wording
from tests.api import tuning
from tests.api.test_problems import SOLVE, check

# What an address is asked for where a case does not say otherwise.
USUAL: dict[str, dict[str, Any]] = {
    "runs": {"strategies": ["lqr", "passive"]},
    "live": {"strategies": ["lv"]},
    "frequency": {"strategies": ["lqr"]},
    "batches": {"strategies": ["lv"]},
    "tunings": tuning.REQUEST,
    "solve": SOLVE,
    "vehicles/from-data-sheet": EXAMPLES["DataSheet"],
    "links": {"run_id": "RUN"},
}


def check_refused(client: httpx.Client, file: str, asked: Any, **ids: str) -> httpx.Response:
    """Ask what a case of the file asks, in which these words stand for ids, and check what is said; return it."""
    known = json.loads(_with(ids, json.dumps(asked)))
    if "query" in known:
        answer = client.get(f"/api/v1/{known['path']}", params=known["query"])
    else:
        usual = json.loads(_with(ids, json.dumps(USUAL.get(asked["path"], {}))))
        answer = client.post(f"/api/v1/{known['path']}", json=usual | known["body"])
    check(answer, 422, str(answer.json()["type"]).rpartition(":")[2])
    said = [f"{each.get('parameter') or each['pointer']}: {each['message']}" for each in answer.json()["errors"]]
    wording.check(file, asked, json.loads(_with({value: name for name, value in ids.items()}, json.dumps(said))))
    return answer


def _with(words: dict[str, str], text: str) -> str:
    for word, other in words.items():
        text = text.replace(word, other)
    return text
