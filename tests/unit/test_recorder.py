"""What is measured of a run while it is driven, against its definition in NumPy."""

from typing import Any

import numpy as np
import pytest
from numpy.random import default_rng

from sim_core.arrays import FloatArray
from sim_core.kernel import binding
from sim_core.kernel.record import SIGNALS, WEIGHTING, Recorder

STATIC = 1.5  # load at which the tyres of `recorder` are in the air
LAYOUT = binding.road_layout(-1.0, 100.0, "cosine", (1, 2.0, 0.0, 0.5, 3.0, 2.5))  # no kink


def recorder(fine: int, steps: int, ends: FloatArray, **changed: Any) -> Recorder:
    """Of a drive whose first step is not on record, over a road without kinks."""
    instants = fine * steps + 1
    right: dict[str, Any] = {
        "fine": fine,
        "first": 1,
        "ends": ends,
        "max_chord_deviation": np.zeros(len(ends)),
        "weighted_samples": fine * (steps - 1) + 1,
        "weighting": np.zeros(WEIGHTING),
        "tyres": np.array([[1.0, 1.0], [-np.inf, -np.inf], [-STATIC, -STATIC]]),
        "clearance": np.full((2, 2), np.inf),
        "road": (np.zeros(50), LAYOUT),
        "position": np.zeros((2, instants)),
        "height": np.zeros((2, instants)),
        "kinks": np.array([np.inf]),
    }
    return Recorder(**(right | changed))


def measured(table: FloatArray, ends: FloatArray, **changed: Any) -> Recorder:
    """Samples of held commands (commands, fine + 1, 10), measured."""
    result = recorder(table.shape[1] - 1, len(table) + 1, ends, **changed)
    for step, samples in enumerate(table):
        result.samples[:] = samples
        result.record(1 + step)
    return result


def in_section(kind: str, signal: FloatArray, first: float, last: float) -> tuple[float, float]:
    """Integral and peak of a signal (commands, fine + 1) from one place to another, fine step after fine step."""
    fine, integral, peak = signal.shape[1] - 1, 0.0, 0.0
    for step in range(int(first), int(np.ceil(last))):
        command, row = divmod(step, fine)
        a, b = signal[command, row : row + 2]
        low, high = max(first - step, 0.0), min(last - step, 1.0)
        over_step = {"square": (a**2 + b**2) / 2, "line": (a**2 + a * b + b**2) / 3}
        integral += (high - low) * over_step[kind]
        peak = max(peak, abs(a + low * (b - a)), abs(a + high * (b - a)))
    return integral, peak


SECTIONS = [
    [[0, 0.5], [0.5, 3.25], [3.25, 8]],
    [[0, 1], [1, 1], [1, 7.75]],
    [[0.25, 0.5], [0.5, 2.75], [2.75, 6]],
]


@pytest.mark.parametrize("ends", SECTIONS, ids=str)
@pytest.mark.parametrize("fine", [1, 4])
def test_sections_are_the_sum_of_their_fine_steps(fine: int, ends: list[list[float]]) -> None:
    """Wherever they end: at a sample or between two, under a command or where it changes, both ends under one."""
    table, places = default_rng(fine).normal(size=(8, fine + 1, SIGNALS)), fine * np.array(ends)
    result = measured(table, places)
    for place, kind in enumerate(["line", "line", *["square"] * 6]):
        expected = [in_section(kind, table[:, :, 2 + place], *section) for section in places.tolist()]
        found = np.transpose([result.integrals[:, place], result.peaks[:, place]])
        np.testing.assert_allclose(found, expected, rtol=1e-12, atol=1e-15)


def test_what_is_not_finite_shows_in_its_section_alone() -> None:
    table = np.ones((4, 3, SIGNALS))
    table[3, 1, 2] = np.nan
    result = measured(table, np.array([[0.0, 6.0], [6.0, 8.0]]))
    np.testing.assert_array_equal(result.integrals[:, 0], [6.0, np.nan])
    np.testing.assert_array_equal(result.integrals[:, 1], [6.0, 2.0])
