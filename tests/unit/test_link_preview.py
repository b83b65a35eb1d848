"""The preview of a link in chat programs, and that nothing in it can become markup."""

from datetime import UTC, datetime
from typing import Any

import pytest

from backend.links import preview
from backend.links.preview import Preview
from sim_core.scenario import Scenario
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


def test_a_preview_has_the_main_numbers() -> None:
    card = preview.of_run(run({"lv": entry(5.5, 2), "passive": entry(10, 8)}), {}, WHEN)
    assert card.title == "LV control against passive: 45 % less peak body acceleration on the bump"
    assert card.description == (
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
def test_the_preview_names_what_the_view_compares(view: dict[str, Any], title: str) -> None:
    members = {"lv": entry(5, 2), "lqr": entry(10, 3), "passive": entry(10, 8)}
    assert preview.of_run(run(members), view, WHEN).title == title


@pytest.mark.parametrize(("height", "road"), [(0.0, "measured road"), (0.1, "measured road, bump 0.10 m × 4 m")])
def test_a_measured_road_is_called_so(height: float, road: str) -> None:
    shown = run({}, height=height)
    shown["scenario"]["road"]["profile"] = "pwida6DsrD3-Rq1gNrUpPD"
    assert preview.of_run(shown, {}, WHEN).description.startswith(f"{road}, 50 → 22.5 km/h; ")


@pytest.mark.parametrize(
    "strategies", [{}, {"lv": {"status": "failed", "reason": "x"}}, {"lv": {"status": "ok", "metrics": {"other": {}}}}]
)
def test_a_run_without_those_figures_still_has_a_preview(strategies: dict[str, Any]) -> None:
    card = preview.of_run(run(strategies), {}, WHEN)
    assert card.title == "A stored run"
    assert "0.10 m" in card.description


def test_a_batch_tells_how_many_runs_over_what() -> None:
    fields = [
        {"name": "road.bump.height", "title": "Height", "unit": "m"},
        {"name": "speed.target_speed_kmh", "title": "Target speed", "unit": "km/h"},
    ]
    batch = {
        "state": "running",
        "total": 12000,
        "failed": 3,
        "strategies": ["lv", "passive"],
        "core_version": "0.1.0",
        "fields": fields,
    }
    card = preview.of_batch(batch, WHEN)
    assert card.title == "12 000 runs over bump height × target speed"
    assert card.description == (
        "12 000 runs over bump height × target speed: LV control, Passive; running; 3 failed; "
        "Ridelab core 0.1.0, 2026-11-21"
    )
    done = preview.of_batch({**batch, "state": "done", "failed": 0, "fields": fields * 3}, WHEN)
    assert done.title.endswith("× …")
    assert "done" not in done.description
    planning = preview.of_batch({**batch, "state": "planning", "total": None, "fields": None, "failed": 0}, WHEN)
    assert planning.title == "A sweep"
    assert planning.description == "A sweep: LV control, Passive; planning; Ridelab core 0.1.0, 2026-11-21"


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
