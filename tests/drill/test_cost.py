"""Estimates against real cost: random scenarios within the sliders, every strategy, processor time of one core."""

import pytest

from benchmarks.cost import FACTOR, JUDGED, drawn, measure, report, within

DRAWS = 500


@pytest.mark.timeout(1200)
def test_estimates_are_within_a_factor_of_three_of_the_real_cost() -> None:
    runs = measure(drawn(JUDGED, number) for number in range(DRAWS))
    report(runs)
    assert FACTOR == 3
    assert within(runs) >= 0.9
    assert max(run.cost for run in runs) < 90, "nothing takes as long as a worker's task may"
