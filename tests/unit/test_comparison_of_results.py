"""What `compare` says of the results of runs: by label or key, on one road and on several, and of other scenarios."""

from dataclasses import replace
from typing import Any

import pytest

from sim_core import Road, Scenario, compare, simulate
from sim_core.catalogue import PAPER_METRICS
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
