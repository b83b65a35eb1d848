"""What chat programs show of a link, and that nothing in it can become markup."""

from datetime import UTC, datetime
from html.parser import HTMLParser
from typing import Any

import pytest

from backend.runs.links import preview
from backend.runs.links.preview import Preview
from sim_core.scenario import Scenario

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


class Tags(HTMLParser):
    """Every tag, the title's text and what the metas say."""

    def __init__(self, text: str) -> None:
        super().__init__()
        self.tags: list[str] = []
        self.title = ""
        self.metas: dict[str, str] = {}
        self.feed(text)
        self.close()

    def handle_starttag(self, tag: str, attrs: list[tuple[str, str | None]]) -> None:
        self.tags.append(tag)
        values = dict(attrs)
        if tag == "meta" and "content" in values:
            self.metas[str(values.get("name") or values.get("property"))] = str(values["content"])

    def handle_data(self, data: str) -> None:
        if self.tags[-1:] == ["title"]:
            self.title += data.strip()


def test_the_numbers_that_matter_are_told() -> None:
    found = preview.of_run(run({"lv": entry(5.5, 2), "passive": entry(10, 8)}), {}, WHEN)
    assert found.title == "LV control against passive: 45 % less peak body acceleration on the bump"
    assert found.description == (
        "LV control against passive: 45 % less peak body acceleration, 75 % less peak pitch acceleration on the bump; "
        "bump 0.10 m × 4 m, 50 → 22.5 km/h; Ridelab core 0.1.0, 2026-11-21"
    )


@pytest.mark.parametrize(
    ("view", "title"),
    [
        ({"baseline": "lqr"}, "LV control against LQR: 50 % less peak body acceleration on the bump"),
        ({"baseline": "lv"}, "LQR against LV control: 100 % more peak body acceleration on the bump"),
        ({"strategies": ["lqr", "lv"]}, "LQR against passive: the same peak body acceleration on the bump"),
        ({"hidden": ["lv"]}, "LQR against passive: the same peak body acceleration on the bump"),
        (
            {"hidden": ["lv", "lqr", "passive"]},
            "LV control against passive: 50 % less peak body acceleration on the bump",
        ),
        ({"baseline": "speed_only"}, "LV control: peak body acceleration 5 m/s² on the bump"),
    ],
)
def test_what_is_told_is_what_the_view_compares(view: dict[str, Any], title: str) -> None:
    members = {"lv": entry(5, 2), "lqr": entry(10, 3), "passive": entry(10, 8)}
    assert preview.of_run(run(members), view, WHEN).title == title


@pytest.mark.parametrize(
    "strategies", [{}, {"lv": {"status": "failed", "reason": "x"}}, {"lv": {"status": "ok", "metrics": {"other": {}}}}]
)
def test_a_run_without_those_figures_still_has_a_preview(strategies: dict[str, Any]) -> None:
    found = preview.of_run(run(strategies), {}, WHEN)
    assert found.title == "A stored run"
    assert "0.10 m" in found.description


def test_a_batch_tells_how_many_runs_over_what() -> None:
    batch = {
        "state": "running",
        "total": 12000,
        "failed": 3,
        "strategies": ["lv", "passive"],
        "core_version": "0.1.0",
        "fields": [
            {"name": "road.bump.height", "title": "Height", "unit": "m"},
            {"name": "speed.target_speed_kmh", "title": "Target speed", "unit": "km/h"},
        ],
    }
    found = preview.of_batch(batch, WHEN)
    assert found.title == "12 000 runs over bump height × target speed"
    assert found.description == (
        "12 000 runs over bump height × target speed: LV control, Passive; running; 3 failed; "
        "Ridelab core 0.1.0, 2026-11-21"
    )
    done = preview.of_batch({**batch, "state": "done", "failed": 0, "fields": batch["fields"] * 3}, WHEN)
    assert done.title.endswith("× …")
    assert "done" not in done.description


def test_the_page_gets_one_title_one_description_and_a_card() -> None:
    found = Tags(preview.page(INDEX, Preview(title="45 % less", description="numbers")))
    assert found.title == "45 % less · Ridelab"
    assert found.metas["description"] == found.metas["og:description"] == "numbers"
    assert found.metas["og:title"] == "45 % less · Ridelab"
    assert found.metas["og:type"] == "website"
    assert found.metas["twitter:card"] == "summary"
    assert found.metas["robots"] == "noindex"
    assert "og:url" not in found.metas, "the service does not know its own address"
    assert found.tags.count("title") == 1
    assert found.tags.index("meta") < found.tags.index("title"), "the charset comes first"
    assert "script" in found.tags


def test_a_page_that_is_not_there_has_no_card() -> None:
    found = Tags(preview.page(INDEX, Preview(), shared=False))
    assert found.title == "There is no such link · Ridelab"
    assert not [name for name in found.metas if name.startswith(("og:", "twitter:"))]
    assert found.metas["robots"] == "noindex"


def test_hostile_text_stays_text() -> None:
    """No free text is accepted anywhere; were it, it would end up in names and versions."""
    members = {HOSTILE: entry(1, 1), "passive": entry(2, 2)}
    found = preview.of_run({**run(members), "core_version": HOSTILE}, {"baseline": "passive"}, WHEN)
    clean = Tags(preview.page(INDEX, Preview(title="a", description="b")))
    text = preview.page(INDEX, found)
    hostile = Tags(text)
    assert hostile.tags == clean.tags
    assert hostile.title == f"{found.title} · Ridelab"
    assert HOSTILE in hostile.metas["description"]
    assert HOSTILE in hostile.metas["og:title"]
    assert "<img" not in text
    assert "alert(1)</script>" not in text
