"""The reproduction that tests of the paper page take from tests/data is what this core computes."""

import numpy as np

from tests.results import SAME
from tests.servers.reproduction import computed, distinct, rows


def numbers(part: object) -> list[float]:
    """All numbers in it, in order."""
    if isinstance(part, dict):
        part = list(part.values())
    if isinstance(part, list):
        return [number for each in part for number in numbers(each)]
    return [float("nan") if part is None else float(str(part))]


def expect_same(every: int) -> None:
    """Of all rows, strategy by strategy and road by road, one in so many is computed anew."""
    for row in distinct()[::every]:
        stored, ours = numbers(rows()[row.key]), numbers(computed(row))
        np.testing.assert_allclose(ours, stored, rtol=SAME, err_msg=f"{row.strategy} {row.changes}: UPDATE_DOCS=1")


def test_a_row_of_each_strategy_under_each_set_of_readings() -> None:
    expect_same(21)  # of 20 roads, so another road each time
