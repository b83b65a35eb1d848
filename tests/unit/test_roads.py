"""Several roads: means, intervals and paired changes against known answers."""

from math import sqrt

import pytest

from sim_core.scenario import Scenario
from sim_core.simulate import simulate
from sim_core.study.roads import Numbers, compare, drive, seeded

T_4 = 2.7764451  # Student's t at 97.5 %, 4 degrees of freedom (any table)


def numbers(value: float) -> Numbers:
    return {"bump": {"body": {"rms": value, "peak": 2 * value}}, "comfort": {"dose": value**2}}


def test_the_interval_of_a_known_sample() -> None:
    """Mean 3, s² = 2.5: the half width is t·s/√5."""
    compared = compare({"lv": [numbers(value) for value in (1.0, 2.0, 3.0, 4.0, 5.0)]}, "lv")
    half = T_4 * sqrt(2.5 / 5)
    rms, peak = (compared.means["lv"]["bump"]["body"][statistic] for statistic in ("rms", "peak"))
    assert [rms.value, rms.low, rms.high] == pytest.approx([3, 3 - half, 3 + half], rel=1e-7)
    assert [peak.value, peak.low, peak.high] == pytest.approx([6, 6 - 2 * half, 6 + 2 * half], rel=1e-7)
    assert compared.means["lv"]["comfort"]["dose"].value == 11
    assert not compared.changes, "nothing is compared with itself"


def test_a_change_is_that_of_the_means_and_exact_where_pairs_keep_their_ratio() -> None:
    base = [1.0, 2.0, 4.0, 9.0]
    compared = compare({"a": [numbers(0.6 * value) for value in base], "b": [numbers(value) for value in base]}, "b")
    change = compared.changes["a"]["bump"]["body"]["rms"]
    assert [change.value, change.low, change.high] == pytest.approx([-40, -40, -40], abs=1e-9)
    assert list(compared.changes) == ["a"]


def test_roads_follow_the_scenarios_seed_and_every_strategy_drives_them() -> None:
    scenario = Scenario.model_validate({"road": {"seed": 5, "length": 120}})
    roads = seeded(scenario, 3)
    assert [road.road.seed for road in roads] == [5, 6, 7]
    assert roads[0] == scenario
    results_by_strategy = drive(scenario, ("lqr", "passive"), 3)
    for name, driven in results_by_strategy.items():
        results = [simulate(road, name) for road in roads]
        assert driven == [{**result.metrics, "comfort": result.comfort} for result in results]
        assert len({result.travel_time for result in results}) == 1, "no road changes how long it takes"
        assert len({each["bump"]["body_acceleration"]["peak"] for each in driven}) == 3
