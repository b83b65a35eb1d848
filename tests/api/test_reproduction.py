"""The reproduction that tests of the paper page take from tests/data is what this core computes."""

import numpy as np
import pytest

from tests.results import SAME
from tests.servers.reproduction import computed, distinct, rows


def numbers(part: object) -> list[float]:
    """All numbers in it, in order."""
    if isinstance(part, dict):
        part = list(part.values())
    if isinstance(part, list):
        return [number for each in part for number in numbers(each)]
    return [float("nan") if part is None else float(str(part))]


@pytest.mark.parametrize("every", [21, pytest.param(1, marks=pytest.mark.thorough)])
def test_rows_of_each_strategy_under_each_set_of_interpretations_are_what_this_core_computes(every: int) -> None:
    """One in so many, of 20 roads: so another road each time."""
    for row in distinct()[::every]:
        stored, ours = numbers(rows()[row.key]), numbers(computed(row))
        np.testing.assert_allclose(ours, stored, rtol=SAME, err_msg=f"{row.strategy} {row.changes}: UPDATE_DOCS=1")
