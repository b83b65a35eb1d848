"""What results mean beside each other: changes, random variation, intervals over roads, and the verdict."""

from collections.abc import Mapping, Sequence
from itertools import permutations
from math import nan, sqrt
from statistics import fmean
from typing import Any

import pytest
from hypothesis import given
from hypothesis import strategies as st

from backend.means_over_roads import Numbers, means_and_changes, paired_changes
from sim_core import Comparison, Road, Scenario
from sim_core.catalogue import PAPER_METRICS
from sim_core.comparison.change import Change, change_on_one_road, change_over_roads, shown_alike
from sim_core.comparison.compare import compare_summaries
from sim_core.comparison.intervals import change_with_interval
from sim_core.comparison.numbers import significant
from sim_core.comparison.variation import one_road_resolution
from sim_core.strategies import STRATEGIES
from tests import wording

T_4 = 2.7764451  # Student's t at 97.5 %, 4 degrees of freedom (any table)


def change_between(values: Sequence[float], base: Sequence[float], variation: float) -> Change:
    if len(values) == 1:
        return change_on_one_road(values[0], base[0], variation=variation)
    return change_over_roads(change_with_interval(values, base), fmean(values), fmean(base))


def numbers(value: float) -> Numbers:
    return {"bump": {"body": {"rms": value, "peak": 2 * value}}, "comfort": {"dose": value**2}}


def test_the_interval_of_a_known_sample() -> None:
    """Mean 3, s² = 2.5: the half width is t·s/√5."""
    compared = means_and_changes({"lv": [numbers(value) for value in (1.0, 2.0, 3.0, 4.0, 5.0)]}, "lv")
    half = T_4 * sqrt(2.5 / 5)
    rms, peak = (compared.means["lv"]["bump"]["body"][statistic] for statistic in ("rms", "peak"))
    assert [rms.value, rms.low, rms.high] == pytest.approx([3, 3 - half, 3 + half], rel=1e-7)
    assert [peak.value, peak.low, peak.high] == pytest.approx([6, 6 - 2 * half, 6 + 2 * half], rel=1e-7)
    assert compared.means["lv"]["comfort"]["dose"].value == 11
    assert not compared.changes, "nothing is compared with itself"


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
    assert list(one_road_resolution("recording:" + 22 * "a").values()) == [7, 15], "what controls it is not known"


@pytest.mark.parametrize(
    ("value", "base", "scale", "variation", "change", "beyond"),
    [
        (0.92, 1.0, 1, 7, -8.0, True),
        (1.06, 1.0, 1, 7, 6.0, False),  # one road may do that
        (1.06, 1.0, 1, 0, 6.0, True),  # where nothing is random it does not
        (-1.5, -1.0, 1, 7, -50.0, True),
        (1.0004, 1.0, 1, 0, 0.04, False),  # shows as 0.0 %
        (123_456.0, 123_100.0, 1e-3, 0, 0.29, False),  # both show as 123 kN
        (0.0, 1.0, 1, 15, -100.0, True),
        (1.0, 0.0, 1, 15, None, True),  # nothing to compare with, and yet another value
        (1e-9, 0.0, 1, 0, None, False),  # what rounding leaves of zero
        (2e-9, 1e-9, 1, 0, None, False),
    ],
)
def test_a_change_on_one_road(
    value: float, base: float, scale: float, variation: float, change: float | None, beyond: bool
) -> None:
    found = change_on_one_road(value, base, scale=scale, variation=variation)
    assert found.change == (None if change is None else pytest.approx(change, abs=0.005))
    assert (found.low, found.high, found.beyond_variation) == (None, None, beyond)


@pytest.mark.parametrize(
    ("values", "base", "beyond"),
    [
        ([2.0, 3.0, 5.0], [1.0, 2.0, 3.0], True),  # the interval by hand is above
        ([1.0, 3.0, 2.0], [2.0, 1.0, 3.0], False),  # it contains zero
        ([0.0, 0.0, 0.0], [0.0, 0.0, 0.0], False),
        ([1.0, 2.0, 1.5], [0.0, 0.0, 0.0], True),
        ([1.001, 2.001, 3.001], [1.0, 2.0, 3.0], False),  # sure, and not to be seen in three digits
    ],
)
def test_a_change_over_roads_is_beyond_random_variation_where_its_interval_excludes_zero(
    values: list[float], base: list[float], beyond: bool
) -> None:
    found = change_between(values, base, variation=15)  # what one road resolves is of no account here
    assert found.beyond_variation is beyond
    assert (found.change is None) is (not any(base))


positive = st.floats(0.01, 100)


@given(st.lists(st.tuples(positive, positive), min_size=1, max_size=6), st.sampled_from([0.0, 7.0, 15.0]))
def test_seen_from_the_other_side_a_change_is_the_inverse(pairs: list[tuple[float, float]], variation: float) -> None:
    """1 + c/100 is a ratio, so that its logarithm changes sign; an interval turns over with it."""
    values, base = map(list, zip(*pairs, strict=True))
    one, other = (change_between(*each, variation=variation) for each in ((values, base), (base, values)))
    assert one.change is not None
    assert other.change is not None
    assert (1 + one.change / 100) * (1 + other.change / 100) == pytest.approx(1)
    # The change from the higher to the lower is the smaller one in percent, so one road resolves it later.
    lower, higher = (one, other) if one.change < 0 else (other, one)
    if len(pairs) == 1:
        assert higher.beyond_variation or not lower.beyond_variation


@given(st.floats(1e-12, 1e6), st.floats(0.98, 1.02) | st.floats(-2, 2))
def test_values_are_alike_where_the_same_digits_are_written(value: float, ratio: float) -> None:
    assert shown_alike(value, ratio * value) is (significant(value) == significant(ratio * value))


SMOOTH = Scenario(road=Road(roughness=0))
LABELS = {"lv": "LV control", "lqr": "LQR", "passive": "Passive", "skyhook": "Skyhook"}


def summaries(
    values: Mapping[str, Sequence[float]], speeds: Mapping[str, float | None]
) -> dict[str, list[dict[str, Any]]]:
    """On one road: of each strategy the paper's eight metrics."""
    found = {}
    for name, row in values.items():
        metrics: dict[str, Any] = {}
        for key, value in zip(PAPER_METRICS, row, strict=False):
            window, signal, statistic = key.split(".")
            metrics.setdefault(window, {}).setdefault(signal, {})[statistic] = value
        found[name] = [{"metrics": metrics, "comfort": {}, "arrival_speed_kmh": speeds.get(name, 20.0)}]
    return found


def compared(
    values: Mapping[str, Sequence[float]], speeds: Mapping[str, float | None] | None = None, *, is_random: bool = True
) -> Comparison:
    return compare_summaries(summaries(values, speeds or {}), "passive", Scenario() if is_random else SMOOTH)


# rough road: body, pitch, front tyre, rear tyre; then the same on the bump
LOW, HIGH = [1.0] * 8, [2.0] * 8


@pytest.mark.parametrize("asked", wording.asked_in("verdicts"), ids=str)
def test_the_verdict_names_no_loser_first_and_says_mixed_by_metric(asked: dict[str, Any]) -> None:
    """In whatever order results come; values of some metrics of some strategies, and speeds that are not 20 km/h."""
    values = asked["values"]
    found = {
        (verdict.text, verdict.mixed)
        for order in permutations(values)
        for verdict in [compared({name: values[name] for name in order}, asked.get("speeds")).verdict]
    }
    (said,) = found
    wording.check("verdicts", asked, list(said))


def test_where_nothing_is_random_every_difference_that_shows_counts() -> None:
    found = compared({"lv": LOW, "lqr": [1.05] * 4 + [1.0] * 4}, is_random=False)
    assert list(found.verdict.best.values()) == ["lv"] * 4 + [None] * 4
    assert found.verdict.text.startswith("LV control is best in 4 of 8 metrics; in the other 4 (peak ac")
    assert compared({}).verdict.best == {}
    alike = compared({"lv": LOW, "lqr": LOW}, is_random=False).verdict
    assert alike.text.startswith("No clear winner: LV control and LQR are equal in all 8 metrics.")
    assert "random" not in alike.text


metrics = st.lists(st.floats(0.0, 10.0).map(lambda value: round(value, 1)), min_size=8, max_size=8)


@given(st.fixed_dictionaries(dict.fromkeys(LABELS, metrics)), st.booleans())
def test_a_strategy_left_out_changes_no_others_numbers(values: dict[str, list[float]], is_random: bool) -> None:
    """And where one is best among all, it is best among fewer."""
    every = compared(values, is_random=is_random)
    for left_out in ("lv", "lqr", "skyhook"):
        fewer = compared({name: row for name, row in values.items() if name != left_out}, is_random=is_random)
        assert fewer.changes == {name: changes for name, changes in every.changes.items() if name != left_out}
        for metric, best in every.verdict.best.items():
            assert best in (None, left_out) or fewer.verdict.best[metric] == best
    for metric, best in every.verdict.best.items():
        if best not in (None, "passive"):
            change = every.changes[best][metric]
            assert change.beyond_variation
            assert change.change is None or change.change < 0


def test_a_recorded_drive_is_compared_and_wins_nothing() -> None:
    recording = "recording:" + 22 * "a"
    values = {recording: [0.5] * 8, "lv": LOW, "lqr": [1.5] * 8}
    found = compare_summaries(summaries(values, {}), recording, SMOOTH)
    assert found.baseline == recording
    assert found.changes["lv"][PAPER_METRICS[0]].change == 100
    assert set(found.verdict.best.values()) == {"lv"}
    assert "100\u2009% higher than with the recorded drive." in found.verdict.text, "no file's name is known"
    two = {recording: [0.5] * 8, "recording:" + 22 * "b": [0.6] * 8, "lv": LOW}
    text = compare_summaries(summaries(two, {recording: 30.0}), "lv", SMOOTH).verdict.text
    assert text.endswith(
        "LV control and recorded drive 2 meet the bump at 20.0\u00a0km/h, recorded drive 1 at 30.0\u00a0km/h."
    ), text
    beside = compare_summaries(summaries({recording: [0.5] * 8, "lv": LOW}, {"lv": 30.0}), "lv", SMOOTH).verdict.text
    assert beside.startswith("The recorded drive meets the bump"), beside
    # It was driven over a real road, so a small difference may be random whatever the scenario is.
    near = compare_summaries(summaries({recording: LOW, "lqr": [1.1] * 8}, {}), recording, SMOOTH)
    assert not near.changes["lqr"]["bump.body_acceleration.peak"].beyond_variation
    missing = summaries(values, {})
    missing[recording][0]["metrics"]["bump"] = {"body_acceleration": {"peak": nan}}
    assert PAPER_METRICS[4] not in compare_summaries(missing, recording, SMOOTH).changes["lv"]
