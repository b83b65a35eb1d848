"""Reports without a service: numbers in words, the scenario's tables, caveats, and text that wants to be markup."""

from dataclasses import replace
from datetime import UTC, datetime
from typing import Any

import pytest

from backend.outcome import Outcome, Sampling
from backend.runs.compute_run import compute_run
from backend.runs.reports import inputs
from backend.runs.reports.caveats import caveats
from backend.runs.reports.run import RunFacts, report
from sim_core.comparison import numbers
from sim_core.scenario import Scenario, dotted
from tests import wording
from tests.html import check, read

HOSTILE = "</script><script>alert(1)</script><img src=x onerror=alert(1)>\"'&{{7*7}}"


@pytest.mark.parametrize("asked", wording.asked_in("reports"))
def test_numbers_and_caveats_as_a_report_shows_them(asked: list[Any]) -> None:
    """Of inputs every digit, of changes a sign unless it is nothing; caveats of events and a car where they matter."""
    form, *values = asked
    if form == "caveats":
        events, vehicle = values
        car = {"tyre_lift_off": False, "bump_stop_clearance": None, **vehicle}
        wording.check("reports", asked, caveats({"status": "ok", "arrival_speed_kmh": 41.26, "events": events}, car))
    else:
        wording.check("reports", asked, getattr(numbers, form)(*values))


def test_what_is_no_number_is_a_dash() -> None:
    assert numbers.significant(float("nan")) == "–"


def test_every_field_is_in_the_tables_and_what_differs_is_marked() -> None:
    changed = {"road.bump.height": 0.12, "mpc.stage_weights.cruise": [5, 1, 1], "actuator.bandwidth": 12}
    scenario = dotted.with_changes(Scenario().model_dump(mode="json"), changed)
    fields = [field for part in inputs.parts(scenario) for field in part.fields]
    whole = {name for name, field in dotted.fields().items() if not name.rpartition(".")[2].isdigit()}
    assert {field.name for field in fields} == whole
    marked = {field.name: (field.shown, field.paper) for field in fields if field.paper is not None}
    assert marked == {
        "road.bump.height": ("0.12\u00a0m", "0.1\u00a0m"),
        "mpc.stage_weights.cruise": ("5, 1, 1", "8, 1, 1"),
        "actuator.bandwidth": ("12\u00a0Hz", "none"),
    }


@pytest.fixture(scope="module")
def outcomes() -> dict[str, Outcome]:
    """A short road with a bump a car jumps over."""
    scenario = Scenario.model_validate({"road": {"length": 60, "bump": {"start": 40, "height": 0.15}}})
    return compute_run(scenario, {"lv": "a", "passive": "b"}, Sampling(200))


def facts(outcomes: dict[str, Outcome], **more: Any) -> RunFacts:
    entries = {
        name: {"status": "ok", "source": None, "compute_ms": 1.0, **outcome.summary}
        for name, outcome in outcomes.items()
    }
    answer = {
        "id": "a-run",
        "core_version": "1.2.3",
        "scenario": Scenario().model_dump(mode="json"),
        "strategies": entries,
        "comparison": {
            "cautions": [{"kind": "sag", "text": HOSTILE}, {"kind": "paper_sag", "text": "A sag as printed."}]
        },
        **more,
    }
    when = datetime(2026, 1, 2, 3, 4, tzinfo=UTC)
    return RunFacts(
        answer=answer,
        created_at=when,
        baseline="passive",
        against=None,
        changes={},
        outcomes=outcomes,
        axis="position",
        gone=None,
    )


def test_text_never_becomes_markup(outcomes: dict[str, Outcome]) -> None:
    scenario = Scenario().model_dump(mode="json")
    scenario["road"]["bump"]["shape"] = HOSTILE
    scenario["mpc"]["preview"] = HOSTILE
    summary = outcomes["lv"].summary
    entries = {
        HOSTILE: {"status": "failed", "compute_ms": 1.0, "reason": HOSTILE},
        "lv": {"status": "ok", "source": None, "compute_ms": 1.0, **summary},
    }
    shown = facts(outcomes, id=HOSTILE, core_version=HOSTILE, scenario=scenario, strategies=entries)
    plain = report(replace(shown, baseline=HOSTILE), compressed=False).content.decode()
    root = read(plain)
    check(root)
    assert len(list(root.all("script"))) == 3, "figures, plotly, and what draws them"
    assert not list(root.all("img"))
    assert root.text.count("alert(1)") >= 11, "it is there, as text"
    assert "A sag as printed." not in root.text, "the paper's own sag is no caution beside a result"
    assert "{{7*7}}" in next(root.all("h1")).text
