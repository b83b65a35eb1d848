"""Random runs over everything that may be typed; tests/drill/test_numbers.py tries 100,000 of them."""

import pytest

from tests.unit.random_runs import attack
from tests.unit.symmetries import LAWS, check


def test_every_number_is_one_or_the_run_is_refused() -> None:
    found = attack(seed=2, count=40)
    assert not found.not_finite
    assert found.ended > 30, "else nothing was tried"


@pytest.mark.thorough
def test_linear_runs_are_linear_and_the_same_everywhere_on_the_road() -> None:
    found = check(seed=2, count=12)
    assert not found.broken
    assert set(found.held) == LAWS, "else one was never tried"
