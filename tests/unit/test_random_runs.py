"""Random runs over everything that may be typed.

With THOROUGH=1 there are DRILL_SCENARIOS (100,000, by DRILL_SEED) cheap ones and a two hundredth as many expensive
ones.
"""

import os

import numpy as np
import pytest

from benchmarks.cost import warm_up
from tests.unit.random_runs import attack

SCENARIOS = int(os.environ.get("DRILL_SCENARIOS", "100000"))
SEED = int(os.environ.get("DRILL_SEED", "1"))


def test_every_number_is_one_or_the_run_is_refused() -> None:
    found = attack(seed=2, count=40)
    assert not found.not_finite
    assert found.ended > 30, "else nothing was tried"


@pytest.mark.thorough
@pytest.mark.timeout(7200)
@pytest.mark.parametrize("dear", [False, True], ids=["cheap", "expensive"])
def test_no_run_of_very_many_costs_more_than_its_bound(dear: bool) -> None:
    warm_up()
    found = attack(SEED, SCENARIOS // 200 if dear else SCENARIOS, dear=dear)
    print(f"\nseed {SEED}: {found.ended} ended, {found.refused.total()} were refused: {dict(found.refused)}")
    ratios = np.quantile(found.ratios, [0.01, 0.5, 0.99, 1])
    print(f"cost over estimate at 1, 50, 99, 100 %: {ratios.round(2).tolist()}")
    assert not found.not_finite, found.not_finite
    assert not found.over, found.over
