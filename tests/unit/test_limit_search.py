"""The search for a limit by itself, on functions with a closed-form answer."""

import math
from collections.abc import Callable

import pytest
from hypothesis import given
from hypothesis import strategies as st

from backend.runs.solve.limit_search import MAX_VALUES, Axis, alike, bracket, next_indices

Function = Callable[[float], float]


def search(axis: Axis, limit: float, function: Function) -> dict[int, float]:
    bounds: dict[int, float] = {}
    while indices := next_indices(axis, limit, bounds):
        assert not set(indices) & set(bounds), "nothing is tried twice"
        bounds |= {index: function(axis.value(index)) for index in indices}
    assert len(bounds) <= MAX_VALUES
    return bounds


def solved(low: float, high: float, limit: float, function: Function, *, whole: bool = False) -> tuple[float, float]:
    axis = Axis.of(low, high, whole=whole)
    below, above = bracket(axis, limit, search(axis, limit, function))
    assert below is not None
    return axis.value(below), axis.value(above)


@pytest.mark.parametrize(
    ("low", "high", "limit", "function", "expected"),
    [
        (0, 0.2, 5, lambda x: 61.2 * x, (0.0816, 0.0817)),  # 5/61.2 = 0.081699
        (10, 60, 5, lambda x: x**2 / 100, (22.36, 22.37)),  # sqrt(500) = 22.3607
        (10.3, 60, 5, lambda x: x**2 / 100, (22.36, 22.37)),
        (10, 60, 0.5, lambda x: math.exp(x) / 1e15, (33.84, 33.85)),  # ln(5e14) = 33.8456
        (10, 60, 0, lambda x: max(0.0, x - 31.237), (31.23, 31.24)),  # a plateau at the limit, such as of events
        (10, 60, 0, lambda x: float(x > 31.237), (31.23, 31.24)),  # a jump
        (10, 60, 1, lambda x: 0.0 if x < 31.237 else math.inf, (31.23, 31.24)),  # beyond it there is no metric
        (-0.15, 0.2, -0.05, lambda x: x, (-0.05, -0.0499)),
        (0, 1024e-6, 1, lambda x: 7000 * x, (142e-6, 143e-6)),
        (0.3, 0.9, 1, lambda x: x, (0.9, 0.9)),  # all of it keeps the limit
        (10, 60, 0.5, lambda x: math.cos(x / 5), (57.59, 57.6)),  # 55 π/3 = 57.596; before it 25 π/3 = 26.18
    ],
)
def test_the_bracket_of_a_known_function(
    low: float, high: float, limit: float, function: Function, expected: tuple[float, float]
) -> None:
    assert solved(low, high, limit, function) == expected


@pytest.mark.parametrize(
    ("low", "high", "limit", "share", "function", "expected"),
    [
        (0, 0.2, 5, 0.15, lambda x: 61.2 * x, 0.08),  # 0.0694 to 0.0940 are alike: steps of 0.01
        (0, 0.2, 5, 0.07, lambda x: 61.2 * x, 0.081),  # 0.0760 to 0.0874
        (0, 0.2, 5, 0.001, lambda x: 61.2 * x, 0.0816),  # all digits tried
        (10, 60, 5, 0.15, lambda x: x**2 / 100, 22),  # 20.6 to 24.0
        (10, 60, 5, 0.0, lambda x: x**2 / 100, 22.36),
        (14, 60, 4.9, 0.9, lambda x: 4 + x / 20, 14),  # not below the range: nearly all of it is alike
        (10, 60, 0.5, 0.15, lambda x: float(x > 31.237), 31.23),  # a jump
        (10, 60, 1, 0.15, lambda x: 0.0 if x < 31.237 else math.inf, 31.23),
        (-0.15, 0.2, -0.05, 0.2, lambda x: x, -0.05),  # -0.06 to -0.04
        (-0.15, 0.2, -0.0512, 0.2, lambda x: x, -0.06),  # down, not towards 0
    ],
)
def test_a_value_has_as_many_digits_as_the_metrics_resolution_leaves_it(
    low: float, high: float, limit: float, share: float, function: Function, expected: float
) -> None:
    axis = Axis.of(low, high, whole=False)
    bounds = search(axis, limit, function)
    best, _ = bracket(axis, limit, bounds)
    assert best is not None
    first, last = alike(limit, bounds, best, share)
    assert axis.resolved(best, last - first) == expected


def test_whole_numbers_stay_whole_and_few_are_all_tried() -> None:
    assert solved(1, 200, 7, lambda x: x / 10, whole=True) == (70, 71)
    assert solved(1, 5, 0.3, lambda x: x / 10, whole=True) == (3, 4)


@given(
    st.floats(-100, 100),
    st.floats(1e-3, 1e4),
    st.floats(0, 1),
    st.sampled_from([1, 3, 0.2]),
)
def test_every_rising_metric_is_bracketed_within_a_thousandth(
    low: float, width: float, at: float, power: float
) -> None:
    high = low + width
    root = low + at * width
    below, above = solved(low, high, 0, lambda x: math.copysign(abs(x - root) ** power, x - root) - 1e-300)
    assert below <= root <= above or above == high
    assert above - below <= width / 1000 * (1 + 1e-6)
