"""Several roads: means, intervals and paired changes against known answers."""

from math import sqrt

import pytest

from backend.means_over_roads import Numbers, compare, one_road_resolution, paired_changes
from sim_core.strategies import STRATEGIES

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


def test_a_change_against_another_scenario_is_paired_by_road() -> None:
    """Ratio of means by hand: b = (1, 2, 3), a = (2, 3, 5), r = 10/6; residuals a − r·b = (1/3, −1/3, 0), s = 1/3.

    The half width is t·s/√3 over the base's mean 2; of independent means it would be eight times as wide.
    """
    driven = {"lv": [numbers(value) for value in (2.0, 3.0, 5.0)], "lqr": [numbers(1.0)] * 3}
    against = {"lv": [numbers(value) for value in (1.0, 2.0, 3.0)], "passive": [numbers(1.0)] * 3}
    changes = paired_changes(driven, against)
    assert list(changes) == ["lv"], "what both have"
    t_2 = 4.3026527
    half = 100 * t_2 / 3 / sqrt(3) / 2
    for statistic in ("rms", "peak"):
        change = changes["lv"]["bump"]["body"][statistic]
        middle = 100 * (10 / 6 - 1)
        assert [change.value, change.low, change.high] == pytest.approx([middle, middle - half, middle + half])
    with pytest.raises(ValueError, match="as many"):
        paired_changes(driven, {"lv": against["lv"][:2]})


def test_one_road_resolves_less_of_predictive_peaks() -> None:
    """The table of docs/explanation/luck.md."""
    resolved = {name: list(one_road_resolution(name).values()) for name in STRATEGIES}
    assert resolved["lv"] == resolved["lv_hil"] == [7, 15]
    assert resolved["lqr"] == resolved["passive"] == [7, 7]
