"""DRILL_SCENARIOS random cheap runs (100,000, by DRILL_SEED) over all hard limits, and shares of them.

A two hundredth as many dear ones, and a hundredth as many that have to hold laws. Pieces of several seeds add up.
"""

import os

import numpy as np
import pytest

from benchmarks.cost import warm_up
from tests.unit.random_runs import attack
from tests.unit.symmetries import LAWS, check

SCENARIOS = int(os.environ.get("DRILL_SCENARIOS", "100000"))
SEED = int(os.environ.get("DRILL_SEED", "1"))


@pytest.mark.timeout(7200)
@pytest.mark.parametrize("dear", [False, True], ids=["cheap", "dear"])
def test_every_number_is_finite_and_no_run_costs_more_than_its_bound(dear: bool) -> None:
    warm_up()
    found = attack(SEED, SCENARIOS // 200 if dear else SCENARIOS, dear=dear)
    print(f"\nseed {SEED}: {found.ended} ended, {found.refused.total()} were refused: {dict(found.refused)}")
    ratios = np.quantile(found.ratios, [0.01, 0.5, 0.99, 1])
    print(f"cost over estimate at 1, 50, 99, 100 %: {ratios.round(2).tolist()}; most: {found.most_of}")
    assert not found.not_finite, found.not_finite
    assert not found.over, found.over


@pytest.mark.timeout(7200)
def test_linear_runs_are_linear_and_the_same_everywhere_on_the_road() -> None:
    found = check(SEED, max(40, SCENARIOS // 100))
    print(f"\nseed {SEED}: held {dict(found.held)}, worst {found.worst}; {found.left_out} left out")
    assert not found.broken, found.broken
    assert set(found.held) == LAWS
