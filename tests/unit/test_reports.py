"""Reports without a service: numbers in words, the scenario's tables, caveats, and text that wants to be markup."""

from collections.abc import Callable
from dataclasses import replace
from datetime import UTC, datetime
from typing import Any

import numpy as np
import pytest

from backend.outcome import Outcome, Sampling
from backend.runs.compute_run import compute_run
from backend.runs.reports import inputs
from backend.runs.reports.caveats import caveats
from backend.runs.reports.run import RunFacts, report
from sim_core.comparison import numbers
from sim_core.scenario import Scenario, dotted
from sim_core.strategies import STRATEGIES
from tests.html import check, read

HOSTILE = "</script><script>alert(1)</script><img src=x onerror=alert(1)>\"'&{{7*7}}"


FORMATS: dict[Callable[..., str], list[tuple[tuple[float, ...], str]]] = {
    numbers.significant: [
        ((0.0,), "0"),
        ((1e-12,), "0"),
        ((0.8982,), "0.898"),
        ((9.996,), "10.0"),
        ((-43.72,), "−43.7"),
        ((10543.0,), "10\u202f543"),
        ((6.4e-5,), "6.4×10⁻⁵"),
        ((2.5e9,), "2.5×10⁹"),
        ((float("nan"),), "–"),
    ],
    numbers.exact: [  # of inputs every digit
        ((1536.7,), "1536.7"),
        ((27000,), "27\u202f000"),
        ((64e-6,), "6.4×10⁻⁵"),
        ((1e-9,), "1×10⁻⁹"),
        ((0.1,), "0.1"),
        ((-0.06,), "−0.06"),
    ],
    numbers.percent: [  # a sign unless it is nothing, and an interval's half where that is not nothing
        ((-43.72,), "−43.7\u2009%"),
        ((0.04,), "0.0\u2009%"),
        ((-0.04,), "0.0\u2009%"),
        ((741.2,), "+741\u2009%"),
        ((1e6,), "> +9999\u2009%"),
        ((-43.7, 2.0), "−44 ± 2\u2009%"),
        ((0.1, 0.04), "+0.1\u2009%"),
        ((0.0, 0.0), "0.0\u2009%"),
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
    titles = {part.name: part.title for part in inputs.parts(scenario)}
    assert titles["road.bump"] == "Road: Bump"
    assert inputs.command(scenario, ["lv"]) == (
        "ridelab run --set road.bump.height=0.12 --set actuator.bandwidth=12 --set mpc.stage_weights.cruise=5,1,1 "
        "--strategy lv"
    )


@pytest.fixture(scope="module")
def outcomes() -> dict[str, Outcome]:
    """A smooth road with a bump a car jumps over: short, and with every caveat."""
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


def test_caveats_are_sentences_only_where_there_are_any(outcomes: dict[str, Outcome]) -> None:
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
    assert [text.partition(":")[0] for text in sentences] == [
        "Airborne",
        "Over travel",
        "Target speed not reached",
        "The road ends before the rear axle has left the bump",
        "Solver failures",
        "Solver fallbacks",
    ]
    assert "94\u00a0ms" in sentences[0]
    assert "1.6\u00a0mm" in sentences[1]
    assert "41.3\u00a0km/h" in sentences[2]
    assert "1 of 79" in sentences[4]
    real = caveats({**entry, "events": events}, {"tyre_lift_off": True, "bump_stop_clearance": 0.05})
    assert real[0] == "Airborne: a tyre is off the road for 94\u00a0ms."
    assert real[1].endswith("beyond its travel limit.")
    assert sentences[1].endswith("has no bump stops.")
    assert caveats({"status": "failed", "reason": "no controller"}, vehicle) == ["It could not run: no controller"]
    page = report(facts(outcomes), compressed=False).content.decode()
    airborne = outcomes["passive"].summary["events"]["airborne_ms"]
    assert airborne > 0
    assert f"for {airborne:.0f}\u00a0ms a tyre" in page


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


def test_even_with_every_strategy_it_fits_into_a_mail(outcomes: dict[str, Outcome]) -> None:
    assert outcomes["lv"].series is not None
    long = np.tile(outcomes["lv"].series, 40)
    all_of_them = dict.fromkeys(STRATEGIES, outcomes["lv"])
    longest = {name: replace(each, series=long) for name, each in all_of_them.items()}
    content = report(facts(longest), compressed=False).content
    assert 1e6 <= len(content) <= 170_000 * len(STRATEGIES)
