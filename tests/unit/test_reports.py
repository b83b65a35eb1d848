"""Reports without a service: numbers in words, the scenario's tables, caveats, and text that wants to be markup."""

from collections.abc import Callable
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
from tests.html import check, read

HOSTILE = "</script><script>alert(1)</script><img src=x onerror=alert(1)>\"'&{{7*7}}"


FORMATS: dict[Callable[..., str], list[tuple[tuple[float, ...], str]]] = {
    numbers.significant: [
        ((0.0,), "0"),
        ((0.8982,), "0.898"),
        ((-43.72,), "−43.7"),
        ((10543.0,), "10\u202f543"),
        ((6.4e-5,), "6.4×10⁻⁵"),
        ((float("nan"),), "–"),
    ],
    numbers.exact: [  # of inputs every digit
        ((1536.7,), "1536.7"),
        ((64e-6,), "6.4×10⁻⁵"),
        ((0.1,), "0.1"),
        ((-0.06,), "−0.06"),
    ],
    numbers.percent: [  # a sign unless it is nothing, and an interval's half where that is not nothing
        ((-43.72,), "−43.7\u2009%"),
        ((-0.04,), "0.0\u2009%"),
        ((1e6,), "> +9999\u2009%"),
        ((-43.7, 2.0), "−44 ± 2\u2009%"),
        ((0.1, 0.04), "+0.1\u2009%"),
        ((-0.2, 3.0), "0 ± 3\u2009%"),
        ((-12e3, 50.0), "< −9999 ± 50\u2009%"),
    ],
}


@pytest.mark.parametrize(("form", "cases"), FORMATS.items(), ids=[form.__name__ for form in FORMATS])
def test_numbers_as_a_report_shows_them(form: Callable[..., str], cases: list[tuple[tuple[float, ...], str]]) -> None:
    assert [form(*values) for values, _ in cases] == [shown for _, shown in cases]


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


def test_caveats_are_sentences_only_where_there_are_any() -> None:
    entry = {"status": "ok", "arrival_speed_kmh": 41.26, "events": {}}
    vehicle = {"tyre_lift_off": False, "bump_stop_clearance": None}
    minute = {"airborne_ms": 0.9, "travel_exceeded_mm": 0.007, "target_reached": None}
    assert caveats({**entry, "events": minute}, vehicle) == []
    for event, noteworthy in (("airborne_ms", 1.0), ("travel_exceeded_mm", 0.1)):
        assert len(caveats({**entry, "events": {**minute, event: noteworthy}}, vehicle)) == 1, event
    events = {
        "airborne_ms": 94.0,
        "travel_exceeded_mm": 1.57,
        "target_reached": False,
        "bump_complete": False,
        "qp_solves": 79,
        "qp_fallbacks": 3,
        "qp_failures": 1,
    }
    sentences = caveats({**entry, "events": events}, vehicle)
    said = ["94\u00a0ms", "1.6\u00a0mm", "41.3\u00a0km/h", "rear axle", "1 of 79", "3"]
    assert [number for number, sentence in zip(said, sentences, strict=True) if number not in sentence] == []
    real = caveats({**entry, "events": events}, {"tyre_lift_off": True, "bump_stop_clearance": 0.05})
    assert real[0] == "Airborne: a tyre is off the road for 94\u00a0ms."
    assert "bump stops" in sentences[1]
    assert "bump stops" not in real[1]


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
