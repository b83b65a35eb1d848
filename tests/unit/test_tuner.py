"""The tuner's own arithmetic: objectives by hand, fronts and volumes with known answers, weights as points and back."""

from collections.abc import Mapping
from dataclasses import replace
from typing import Any

import orjson
import pytest
from hypothesis import given
from hypothesis import strategies as st
from pydantic import ValidationError

from backend.job_run import JobRow
from backend.store.trials import StoredTrial
from backend.tunings import comparison, front, space
from backend.tunings.measure import Aims, Failure
from backend.tunings.models import TuningRequest
from backend.tunings.objectives import Limit, Objective, UndefinedObjectiveError
from backend.tunings.search import ask
from sim_core.scenario import Scenario, dotted
from tests import wording
from tests.there import there

AIMS = Aims(objectives=[Objective(kind="figure", figure="travel_time")], limits=[])
PAPER = Scenario().model_dump(mode="json")
SIGNALS = ("body_acceleration", "pitch_acceleration", "front_tyre_load", "rear_tyre_load")


def trial(number: int, *values: float, feasible: bool = True, **more: Any) -> StoredTrial:
    defaults = {"generation": 0, "weights": {}, "status": "ok", "reason": None, "limits": []}
    return StoredTrial(number=number, feasible=feasible, values=list(values), **(defaults | more))  # type: ignore[arg-type]  # any field


def summary(rms: tuple[float, ...], peak: tuple[float, ...] = (1, 1, 1, 1)) -> dict[str, Any]:
    window = {name: {"rms": r, "peak": p} for name, r, p in zip(SIGNALS, rms, peak, strict=True)}
    return {"metrics": {"rough_road": window, "bump": window, "whole": window}, "events": {"airborne_ms": 7.0}}


def test_eq_16_by_hand() -> None:
    ours, passive = summary((1, 2, 30, 40), (5, 6, 7, 8)), summary((2, 8, 60, 80), (10, 12, 14, 16))
    paper = Objective(kind="paper", q=(1, 2, 4), window="whole")
    # (1/2)² + 2 (2/8)² + 4 (30² + 40²)/(60² + 80²)
    assert paper.value(ours, passive) == pytest.approx(0.25 + 2 / 16 + 4 / 4, rel=1e-15)
    assert paper.model_copy(update={"kind": "peaks"}).value(ours, passive) == pytest.approx(7 / 4, rel=1e-15)
    assert paper.model_copy(update={"q": (1, 1, 1)}).value(passive, passive) == 3, "the passive car itself"
    airborne = Objective(kind="figure", figure="events.airborne_ms")
    assert airborne.value(ours, {}) == 7


def test_a_share_of_nothing_is_refused_where_it_counts() -> None:
    still = summary((0, 1, 1, 1))
    paper = Objective(kind="paper", window="rough_road")
    with pytest.raises(UndefinedObjectiveError, match="body acceleration is zero"):
        paper.value(summary((1, 1, 1, 1)), still)
    assert paper.model_copy(update={"q": (0, 1, 1)}).value(summary((1, 1, 1, 1)), still) == 2


def test_a_trial_is_the_mean_of_its_objectives_and_the_worst_of_its_limits() -> None:
    aims = replace(AIMS, limits=[Limit(figure="events.airborne_ms", at_most=8)])

    def row(position: int, travel_time: float, airborne: float) -> JobRow:
        summarised = {**summary((1, 1, 1, 1)), "travel_time": travel_time, "events": {"airborne_ms": airborne}}
        return JobRow(
            position=position,
            changes="{}",
            strategy="lv",
            status="ok",
            reason=None,
            core_version="1",
            summary=orjson.dumps(summarised).decode(),
            compute_ms=1.0,
        )

    runs = {1: aims.measured(row(0, 10, 0), {}), 2: aims.measured(row(1, 13, 9), {})}
    measured = aims.trial(4, 1, {"lqr.weights": [1, 1, 1]}, runs)
    assert (measured.values, measured.limits, measured.feasible, measured.status) == ([11.5], [9.0], False, "ok")
    assert aims.trial(4, 1, {}, {1: runs[1]}).feasible
    failed = aims.trial(4, 1, {}, {1: runs[1], 2: Failure(reason="too steep")})
    assert (failed.status, failed.reason, failed.feasible, failed.values) == (
        "failed",
        "Road 2: too steep",
        False,
        None,
    )


def test_best_and_knee_of_a_front() -> None:
    trials = [trial(0, 3, 3), trial(1, 1, 4), trial(2, 2, 2), trial(3, 4, 1), trial(4, 2, 2), trial(5, 2, 5)]
    trials += [trial(6, 0, 0, feasible=False)]
    members = front.front(trials)
    assert front.best(trials, 1) == trials[3]
    assert front.best([trials[6]], 0) is None
    # Scaled to the front's range: (0, 1), (1/3, 1/3), (1, 0).
    assert front.knee(members) == trials[2]
    assert front.knee([trial(0, 1)]) is None


@given(st.lists(st.tuples(st.integers(0, 5), st.integers(0, 5), st.integers(0, 5)), min_size=1, max_size=25))
def test_a_front_by_definition(points: list[tuple[int, int, int]]) -> None:
    trials = [trial(number, *point) for number, point in enumerate(points)]

    def dominates(one: tuple[int, ...], other: tuple[int, ...]) -> bool:
        return one != other and all(a <= b for a, b in zip(one, other, strict=True))

    expected = {point for point in points if not any(dominates(other, point) for other in points)}
    assert sorted(tuple(each.values or ()) for each in front.front(trials)) == sorted(expected)


def test_dominated_shares_with_known_answers() -> None:
    assert front.dominated_share([trial(0, 3)], [4]) == pytest.approx(0.25)
    assert front.dominated_share([trial(0, 2, 3), trial(1, 3, 1)], [4, 4]) == pytest.approx((2 * 1 + 1 * 3 - 1) / 16)
    assert front.dominated_share([trial(0, 1, 1, 1)], [2, 2, 2]) == pytest.approx(1 / 8)
    assert front.dominated_share([trial(0, 5, 1)], [4, 4]) == 0
    assert front.dominated_share([trial(0, 1, 1)], [0, 4]) is None
    assert front.dominated_share([trial(0, 1)], None) is None


@pytest.mark.parametrize("strategy", space.OURS)
def test_weights_are_points_and_points_weights(strategy: str) -> None:
    search = space.default_search(strategy)
    papers = space.paper_weights(strategy, search)
    point = there(space.point_of(papers, search, PAPER))
    assert list(point) == space.weights_in(strategy)
    assert space.weights_of(point, search, papers) == papers
    assert space.first_weights(PAPER, strategy, search) == [papers]


def test_what_is_not_searched_keeps_the_scenarios_value() -> None:
    other = Scenario.model_validate({"mpc": {"stage_weights": {"bump": [2, 2, 2]}, "deflection_weight": 5}})
    scenario = other.model_dump(mode="json")
    search = {"mpc.stage_weights.bump.2": (0.1, 10.0)}
    papers, own = space.first_weights(scenario, "lv", search)
    assert papers["mpc.stage_weights.bump"] == [1, 1, 6]
    assert own["mpc.stage_weights.bump"] == [2, 2, 2]
    assert space.point_of(papers, search, scenario) is None, "not in the searched space: bump.0 is held at 2"
    weights = space.weights_of({"mpc.stage_weights.bump.2": 9.99999}, search, own)
    assert weights["mpc.stage_weights.bump"] == [2, 2, 10]
    assert own["mpc.stage_weights.bump"] == [2, 2, 2]
    with_travel = {**search, "mpc.deflection_weight": (1.0, 4.0)}
    assert space.weights_of({"mpc.deflection_weight": 3.14159}, with_travel, own)["mpc.deflection_weight"] == 3.14
    assert space.weights_at(scenario, "lv", with_travel)["mpc.deflection_weight"] == 5
    assert "mpc.deflection_weight" not in own


def test_preview_horizon_and_times_are_searched_as_what_they_are() -> None:
    """A choice stays a choice and a number of steps whole; what is tried is the scenario's value again."""
    request = TuningRequest.model_validate(
        {
            "search": {"mpc.prediction_horizon": [25, 60], "mpc.sample_time": [0.005, 0.01]},
            "previews": ["obstacle", "lookahead"],
        }
    ).stored()
    ranges = space.ranges_of(request)
    papers = space.paper_weights("lv", ranges)
    assert (papers["mpc.preview"], papers["mpc.prediction_horizon"]) == ("lookahead", 30)
    trials = [trial(0, 1.0, weights=papers)]
    points = ask(request, trials, generation=0, count=12)
    tried = [space.weights_of(point, ranges, papers) for point in points]
    assert {each["mpc.preview"] for each in tried} == {"obstacle", "lookahead"}
    assert all(isinstance(each["mpc.prediction_horizon"], int) for each in tried)
    for weights, point in zip(tried, points, strict=True):
        back = there(space.point_of(weights, ranges, PAPER))
        assert back["mpc.sample_time"] == pytest.approx(point["mpc.sample_time"], rel=1e-2)
        Scenario.model_validate(dotted.with_changes(PAPER, weights))
    assert space.longest_run(request) == {"mpc.prediction_horizon": 60, "mpc.sample_time": 0.005}


def test_a_quantile_over_the_roads_is_what_is_minimised() -> None:
    aims = replace(AIMS, quantile=0.9)
    runs: dict[int, Mapping[str, float] | Failure] = {seed: {"objectives.0": float(seed)} for seed in range(1, 12)}
    assert aims.trial(0, 0, {}, runs).values == [10.0]
    assert AIMS.trial(0, 0, {}, runs).values == [6.0]
    compared = comparison.compared([trial(0, 10.0)], {0: ["paper"]}, {0: runs}, [*range(1, 12)], [1, 2], aims)
    assert compared[0].training["objectives.0"].quantile == 10.0


@pytest.mark.parametrize("body", wording.asked_in("tunings"), ids=str)
def test_what_cannot_be_tuned_is_refused_at_its_field(body: dict[str, Any]) -> None:
    with pytest.raises(ValidationError) as refused:
        TuningRequest.model_validate_json(orjson.dumps(body))
    wording.check("tunings", body, wording.errors_in(refused.value))


def roads(values: dict[int, float]) -> dict[int, Any]:
    return {seed: {"objectives.0": value} for seed, value in values.items()}


def test_a_verdict_is_by_the_interval_on_validation_roads() -> None:
    papers = roads({1: 1.0, 2: 1.2, 11: 1.0, 12: 1.2, 13: 1.1})
    # Better on every training road, by the same share on none of the validation roads.
    overfitted = roads({1: 0.5, 2: 0.6, 11: 1.4, 12: 0.9, 13: 1.1})
    better = roads({1: 0.9, 2: 1.08, 11: 0.9, 12: 1.07, 13: 1.0})
    trials = [trial(0, 1.1), trial(1, 0.55), trial(2, 0.99)]
    roles = {0: ["paper"], 1: ["best.0"], 2: ["scenario"]}
    points = comparison.compared(trials, roles, {0: papers, 1: overfitted, 2: better}, [1, 2], [11, 12, 13], AIMS)
    assert [point.verdict for point in points] == [None, ["unclear"], ["better"]]
    assert points[0].fresh["objectives.0"].change is None
    change = there(points[1].training["objectives.0"].change)
    assert change.value == pytest.approx(-50)
    # The validation roads by hand: the ratio of means is 3.4/3.3.
    change = there(points[1].fresh["objectives.0"].change)
    assert change.value == pytest.approx(100 * (3.4 / 3.3 - 1))
    assert points[1].fresh["objectives.0"].worst == 1.4


def test_against_zero_the_difference_decides() -> None:
    papers = roads({1: 0.0, 11: 0.0, 12: 0.0, 13: 0.0})
    worse = roads({1: 0.0, 11: 5.0, 12: 5.1, 13: 4.9})
    trials = [trial(0, 0.0), trial(1, 0.0)]
    points = comparison.compared(trials, {0: ["paper"], 1: ["best.0"]}, {0: papers, 1: worse}, [1], [11, 12, 13], AIMS)
    assert points[1].verdict == ["worse"]
    assert points[1].fresh["objectives.0"].change is None
