"""What `compare` says of the results of runs: by label or key, on one road and on several, and of other scenarios."""

from dataclasses import replace
from typing import Any

import pytest
from hypothesis import given
from hypothesis import strategies as st

from sim_core import Requirement, Road, Scenario, StrategyResult, compare, simulate
from sim_core.catalogue import PAPER_METRICS
from sim_core.comparison.numbers import significant
from sim_core.errors import RidelabError
from sim_core.strategies.passive import Passive


def test_results_of_the_core_are_compared_on_one_road_and_on_several() -> None:
    scenarios = [Scenario(road=Road(seed=seed)) for seed in (1, 2, 3)]
    results = {name: [simulate(each, name) for each in scenarios] for name in ("lqr", "passive")}
    single = compare({name: each[0] for name, each in results.items()})
    assert single.baseline == "passive"
    assert single.changes == compare({name: each[:1] for name, each in results.items()}).changes
    assert {"comfort.weighted_rms", "travel_time", *PAPER_METRICS} <= single.changes["lqr"].keys()
    several = compare(results, "lqr")
    change = several.changes["passive"]["bump.body_acceleration.peak"]
    assert change.low is not None
    assert change.high is not None
    assert change.low < (change.change or 0) < change.high
    assert "±" in several.verdict.text
    smooth = {name: replace(each[0], scenario=Scenario(road=Road(roughness=0))) for name, each in results.items()}
    assert "random" not in compare(smooth).verdict.text
    heavy = Scenario.model_validate({"vehicle": {"body_mass": 2400}})
    cautions = compare({"passive": [simulate(heavy, "passive")] * 2}).cautions
    assert [(each.kind, each.field) for each in cautions] == [("sag", "vehicle.body_mass")]
    loaded = Scenario.model_validate({"mismatch": {"body_mass": 1.5}})
    cautions = compare({"passive": simulate(loaded, "passive")}).cautions
    assert [(each.kind, each.field) for each in cautions][1:] == [("sag", "mismatch.body_mass")], "of the driven car"


def test_results_go_by_their_strategy_whatever_their_key_is() -> None:
    """`lv` as a key says nothing of what was driven: 10 % of a passive car's peak is not random."""
    result = simulate(Scenario(), "passive")

    def with_peak(peak: float) -> Any:
        bump = {**result.metrics["bump"], "body_acceleration": {"rms": 1.0, "peak": peak}}
        return replace(result, metrics={**result.metrics, "bump": bump})

    comparison = compare({"lv": with_peak(1.0), "hard": with_peak(0.9)}, "lv")
    assert comparison.changes["hard"]["bump.body_acceleration.peak"].beyond_variation
    assert comparison.verdict.best["bump.body_acceleration.peak"] == "hard"
    assert "10.0\u2009% lower than with lv" in comparison.verdict.text, "both are passive: their keys tell them apart"
    assert {each.kind for each in comparison.cautions} == {"paper_sag"}
    recording = replace(with_peak(0.5), strategy="recording:" + 22 * "a")
    recorded = compare({"drive": recording, "passive": result})
    assert set(recorded.verdict.best.values()) == {None}, "a recorded drive wins nothing"
    assert "drive" not in recorded.verdict.text


class Mine(Passive):
    """Is as the passive car, under another name."""

    id, label = "mine", "my controller"


@pytest.mark.parametrize("controller", [Mine, Mine()])
def test_a_controller_of_ones_own_goes_by_its_label(controller: Any) -> None:
    smooth = Scenario.model_validate({"road": {"roughness": 0}, "speed": {"policy": "constant"}})
    text = compare({"mine": simulate(smooth, controller), "lqr": simulate(smooth, "lqr")}, "mine").verdict.text
    assert "than with my controller." in text, text
    assert compare({"mine": simulate(smooth, controller)}).verdict.text.endswith("compare my controller with.")
    other = compare({"mine": simulate(Scenario(), controller), "passive": simulate(smooth, "passive")})
    assert any(each.text.startswith("My controller was driven on another") for each in other.cautions)


def test_a_road_without_a_bump_is_said_nothing_of_one() -> None:
    road = Scenario.model_validate({"road": {"length": 40, "bump": {"start": 60, "height": 0}}})
    assert not road.road.has_bump
    assert "bump" not in compare({name: simulate(road, name) for name in ("lqr", "passive")}).verdict.text


@pytest.mark.parametrize(
    ("other", "expected"),
    [
        ({"road": {"seed": 9, "length": 130, "bump": {"height": 0.08}}}, [("other_road", "road.seed")]),
        ({"vehicle": {"front_spring": 20_000}}, [("other_scenario", "vehicle.front_spring")]),
        ({"mpc": {"deflection_limit": 0.06}, "lqr": {"deflection_weight": 4}}, []),  # its own tuning
    ],
)
def test_results_of_other_roads_or_scenarios_are_cautioned(
    other: dict[str, Any], expected: list[tuple[str, str]]
) -> None:
    results = {"lv": simulate(Scenario(), "lv"), "passive": simulate(Scenario.model_validate(other), "passive")}
    found = [each for each in compare(results).cautions if each.kind.startswith("other")]
    assert [(each.kind, each.field) for each in found] == expected
    assert all(each.strategy == "lv" for each in found), "the baseline is what the others are compared with"
    assert all(str(each.field) in each.text and "than Passive" in each.text for each in found)
    several = compare({name: [each, each] for name, each in results.items()})
    assert [each.kind for each in several.cautions if each.kind.startswith("other")] == [kind for kind, _ in expected]


def test_what_cannot_be_compared_is_said() -> None:
    result = simulate(Scenario(), "passive")
    for results, baseline, message in (
        ({}, None, "at least one result"),
        ({"passive": result}, "lv", "The baseline is one of the results, passive: lv is none of them"),
        ({"passive": [result, result], "lv": [result]}, None, "2 of passive, 1 of lv"),
        ({"passive": []}, None, "0 of passive"),
    ):
        with pytest.raises(RidelabError, match=message):
            compare(results, baseline)


PEAK = "bump.body_acceleration.peak"
PASSIVE = simulate(Scenario(), "passive")


def result_with(strategy: str, value: float, seed: int = 1) -> StrategyResult:
    """Return a result whose every metric of the paper is that value, or a multiple of it."""
    metrics: dict[str, Any] = {}
    for number, key in enumerate(PAPER_METRICS, 1):
        window, signal, statistic = key.split(".")
        metrics.setdefault(window, {}).setdefault(signal, {})[statistic] = number * value
    scenario = Scenario(road=Road(seed=seed))
    return replace(PASSIVE, strategy=strategy, metrics=metrics, comfort={}, scenario=scenario)


def over_roads(strategy: str, values: list[float]) -> list[StrategyResult]:
    return [result_with(strategy, value, seed) for seed, value in enumerate(values, 1)]


def test_changes_against_another_run_are_of_the_same_strategy_and_paired_by_road() -> None:
    """Ratio of means by hand: before (1, 2, 3), after (2, 3, 5): 10/6; residuals (1/3, -1/3, 0), s = 1/3."""
    after, before = ([result_with("lqr", value)] for value in (0.9, 1.0))
    change = compare({"lqr": after, "lv": [result_with("lv", 1)]}, against={"lqr": before}).changes_against
    assert list(change) == ["lqr"], "the other run has no LV"
    assert change["lqr"][PEAK].change == pytest.approx(-10)
    assert change["lqr"][PEAK].beyond_variation, "one road tells 7 % of LQR"
    predictive = compare({"lv": result_with("lv", 0.9)}, against={"lv": result_with("lv", 1, seed=9)}).changes_against
    assert not predictive["lv"][PEAK].beyond_variation, "and 15 % of LV's peaks"
    paired = compare({"lqr": over_roads("lqr", [2, 3, 5])}, against={"lqr": over_roads("lqr", [1, 2, 3])})
    half = 100 * 4.3026527 * (1 / 3) / 3**0.5 / 2  # Student's t at 97.5 %, 2 degrees of freedom (any table)
    found = paired.changes_against["lqr"][PEAK]
    expected = [200 / 3, 200 / 3 - half, 200 / 3 + half]
    assert [found.change, found.low, found.high] == pytest.approx(expected, rel=1e-6)
    assert found.beyond_variation
    for others in ([result_with("lqr", 1)], [result_with("lqr", 1, seed) for seed in (1, 2, 4)]):
        with pytest.raises(RidelabError, match="same roads: those of lqr"):
            compare({"lqr": over_roads("lqr", [1, 2, 3])}, against={"lqr": others})


@pytest.mark.parametrize(
    ("limit", "expected"),
    [
        ({"max": 11.0}, ("pass", 10.0)),
        ({"max": 9.0}, ("fail", 10.0)),
        ({"max": 10.5}, ("uncertain", 10.0)),
        ({"min": 10.5}, ("uncertain", 10.0)),
        ({"max_change": -49.0}, ("pass", -50.0)),
        ({"max_change": -51.0}, ("fail", -50.0)),
    ],
)
def test_requirements_of_several_roads_pass_fail_or_are_uncertain(
    limit: dict[str, Any], expected: tuple[str, float]
) -> None:
    """Five times 1.8, 2.0 and 2.2, whose mean is known to 10 ± 2.48 on three roads; half of passive on each road."""
    wide, narrow = [1.8, 2.0, 2.2], [1.96, 2.0, 2.04]  # ± 0.50 about 10
    own = wide if expected[0] == "uncertain" else narrow
    results = {"passive": over_roads("passive", [2 * value for value in own]), "lqr": over_roads("lqr", own)}
    (result,) = compare(results, requirements=[Requirement(metric=PEAK, **limit)]).requirements
    assert (result.strategy, result.result) == ("lqr", expected[0])
    assert result.value == pytest.approx(expected[1])
    assert result.low is not None
    assert result.high is not None
    assert result.low <= expected[1] + 1e-9
    assert result.high >= expected[1] - 1e-9
    against = " against Passive" if "max_change" in limit else ""
    assert result.limit_text.endswith(against)
    assert result.value_text.endswith(f" ({significant(result.low)} to {significant(result.high)})")


values = st.lists(st.floats(0.5, 9).map(lambda value: round(value, 2)), min_size=1, max_size=3)
LIMITS = [Requirement(metric=PEAK, max=10), Requirement(metric=PEAK, max_change=-10)]


@given(st.permutations(["lv", "lqr", "skyhook", "passive"]), st.data())
def test_another_order_or_a_hidden_strategy_changes_nothing_that_is_said(order: list[str], data: st.DataObject) -> None:
    roads = data.draw(st.integers(1, 3))
    some = st.lists(st.floats(0.5, 9), min_size=roads, max_size=roads)
    results = {name: over_roads(name, data.draw(some)) for name in sorted(order)}
    against = {name: over_roads(name, data.draw(some)) for name in ("lv", "passive")}
    first = compare(results, "passive", LIMITS, against)
    turned = compare({name: results[name] for name in order}, "passive", LIMITS, against)
    assert (turned.changes, turned.changes_against) == (first.changes, first.changes_against)
    assert turned.verdict == first.verdict
    assert set(turned.requirements) == set(first.requirements)
    fewer = compare({name: results[name] for name in order if name != "skyhook"}, "passive", LIMITS, against)
    assert all(each == first.changes[name] for name, each in fewer.changes.items())
    assert fewer.changes_against == first.changes_against
    assert set(fewer.requirements) == {each for each in first.requirements if each.strategy != "skyhook"}


@given(values, st.data())
def test_a_against_b_is_the_reverse_of_b_against_a(one: list[float], data: st.DataObject) -> None:
    """Percentages are of another base, so that their factors are each other's inverse; the verdict is the same."""
    other = data.draw(st.lists(st.floats(0.5, 9), min_size=len(one), max_size=len(one)))
    results = {"a": over_roads("lqr", one), "b": over_roads("passive", other)}
    there, back = compare(results, "b"), compare(results, "a")
    pin = compare({"a": results["a"]}, against={"a": over_roads("lqr", other)}).changes_against["a"]
    ours = compare({"a": over_roads("lqr", other)}, against={"a": results["a"]}).changes_against["a"]
    for forth, reverse in ((there.changes["a"], back.changes["b"]), (pin, ours)):
        change, opposite = forth[PEAK].change or 0, reverse[PEAK].change or 0
        assert (1 + change / 100) * (1 + opposite / 100) == pytest.approx(1)
        assert change * opposite <= 0
    assert there.verdict.best == back.verdict.best
    assert there.verdict.mixed == back.verdict.mixed


def test_a_notebook_shows_verdict_changes_requirements_and_cautions() -> None:
    results = {"lv": result_with("lv", 0.5), "<b>": result_with("lqr", 0.95), "passive": result_with("passive", 1)}
    limits = [Requirement(metric=PEAK, max=3, strategies=["lv"])]
    comparison = compare(results, requirements=limits, against={"lv": result_with("lv", 0.4)})
    shown = comparison._repr_html_()
    assert comparison.verdict.text in shown
    assert "<td>LV control</td><td>−50.0\u2009%</td>" in shown
    assert "<td>&lt;b&gt;</td><td>−5.0\u2009%*</td>" in shown, "escaped, and not beyond random variation"
    assert "LV control, Body acceleration, peak, bump, at most 3\u00a0m/s²: pass, 2.50\u00a0m/s²" in shown
    assert "Change against the other run" in shown
    assert "<li>The body&#x27;s weight compresses" in shown
