"""The preview of a link in chat programs, and that nothing in it can become markup."""

from datetime import UTC, datetime
from typing import Any

import pytest

from backend.links import preview
from backend.links.preview import Preview
from sim_core.scenario import Scenario
from tests import wording
from tests.html import read

WHEN = datetime(2026, 11, 21, 23, 59, tzinfo=UTC)
INDEX = """<!doctype html>
<html lang="en">
  <head>
    <meta charset="utf-8" />
    <meta name="description" content="A what-if laboratory." />
    <title>Ridelab</title>
    <script type="module" src="/assets/index.js"></script>
  </head>
  <body><div id="root"></div></body>
</html>
"""
HOSTILE = "</title><script>alert(1)</script>\"><img src=x onerror=alert(2)>&lt;' \u2028 \\1"


def entry(body: float, pitch: float, window: str = "bump") -> dict[str, Any]:
    metrics = {window: {"body_acceleration": {"peak": body}, "pitch_acceleration": {"peak": pitch}}}
    return {"status": "ok", "metrics": metrics}


def run(strategies: dict[str, Any], **road: Any) -> dict[str, Any]:
    scenario = Scenario().model_dump(mode="json")
    scenario["road"]["bump"] |= road
    return {"core_version": "0.1.0", "scenario": scenario, "strategies": strategies}


def head(text: str) -> tuple[list[str], dict[str, str]]:
    """Its titles, and what its metas say."""
    root = read(text)
    metas = [each.attributes for each in root.all("meta") if "content" in each.attributes]
    tags = {str(each.get("name") or each.get("property")): str(each["content"]) for each in metas}
    return [each.text for each in root.all("title")], tags


MEMBERS = {"lv": entry(5, 2), "lqr": entry(10, 3), "passive": entry(10, 8)}
MEASURED = run({}, height=0.1)
MEASURED["scenario"]["road"]["profile"] = "pwida6DsrD3-Rq1gNrUpPD"
LEVEL = run({}, height=0.0)
LEVEL["scenario"]["road"]["profile"] = "pwida6DsrD3-Rq1gNrUpPD"
FIELDS = [
    {"name": "road.bump.height", "title": "Height", "unit": "m"},
    {"name": "speed.target_speed_kmh", "title": "Target speed", "unit": "km/h"},
]
BATCH = {"state": "done", "total": 12000, "failed": 0, "strategies": ["lv", "passive"], "core_version": "0.1.0"}
FAILED = {"status": "failed", "reason": "x"}
CARDS = {
    "a run": preview.of_run(run(MEMBERS), {}, WHEN),
    "against LQR": preview.of_run(run(MEMBERS), {"baseline": "lqr"}, WHEN),
    "against LV": preview.of_run(run(MEMBERS), {"baseline": "lv"}, WHEN),
    "of some strategies": preview.of_run(run(MEMBERS), {"strategies": ["lqr", "lv"]}, WHEN),
    "with LV hidden": preview.of_run(run(MEMBERS), {"hidden": ["lv"]}, WHEN),
    "with all hidden": preview.of_run(run(MEMBERS), {"hidden": ["lv", "lqr", "passive"]}, WHEN),
    "against what did not run": preview.of_run(run(MEMBERS), {"baseline": "speed_only"}, WHEN),
    "a measured road": preview.of_run(LEVEL, {}, WHEN),
    "a bump on a measured road": preview.of_run(MEASURED, {}, WHEN),
    "without strategies": preview.of_run(run({}), {}, WHEN),
    "failed": preview.of_run(run({"lv": FAILED}), {}, WHEN),
    "without these metrics": preview.of_run(run({"lv": {"status": "ok", "metrics": {"other": {}}}}), {}, WHEN),
    "a batch that runs": preview.of_batch({**BATCH, "fields": FIELDS, "state": "running", "failed": 3}, WHEN),
    "a batch over many fields": preview.of_batch({**BATCH, "fields": FIELDS * 3}, WHEN),
    "a batch that is planned": preview.of_batch({**BATCH, "state": "planning", "total": None, "fields": None}, WHEN),
}


@pytest.mark.parametrize("shared", CARDS)
def test_a_preview_names_what_the_view_compares_with_its_main_numbers(shared: str) -> None:
    wording.check("link_previews", shared, [CARDS[shared].title, CARDS[shared].description])


def test_the_page_gets_one_title_one_description_and_a_card() -> None:
    titles, metas = head(preview.page(INDEX, Preview(title="45 % less", description="numbers")))
    assert titles == ["45 % less · Ridelab"]
    assert metas["description"] == metas["og:description"] == "numbers"
    assert metas["og:title"] == "45 % less · Ridelab"
    assert (metas["og:type"], metas["twitter:card"], metas["robots"]) == ("website", "summary", "noindex")
    assert "og:url" not in metas, "the service does not know its own address"


def test_a_page_that_is_not_there_has_no_card() -> None:
    titles, metas = head(preview.page(INDEX, Preview(), shared=False))
    assert titles == ["There is no such link · Ridelab"]
    assert not [name for name in metas if name.startswith(("og:", "twitter:"))]
    assert metas["robots"] == "noindex"


def test_hostile_text_stays_text() -> None:
    """No free text is accepted anywhere; were it, it would end up in names and versions."""
    members = {HOSTILE: entry(1, 1), "passive": entry(2, 2)}
    card = preview.of_run({**run(members), "core_version": HOSTILE}, {"baseline": "passive"}, WHEN)
    text = preview.page(INDEX, card)
    titles, metas = head(text)
    assert titles == [f"{card.title} · Ridelab"]
    assert HOSTILE in metas["description"]
    assert HOSTILE in metas["og:title"]
    assert not list(read(text).all("img"))
    assert len(list(read(text).all("script"))) == 1
