"""What is drawn without a browser: the demonstration's plots of dots, and the forces of a file that was checked."""

import re

import numpy as np
import pytest

from sim_core import STRATEGIES, Scenario, simulate
from sim_core.check_file import _picture
from sim_core.demo import BEFORE, BEHIND, HEIGHT, WIDTH, lines, plot

# Rows of a character of Braille, left and right column: Unicode's dots 1, 2, 3, 7 and 4, 5, 6, 8.
LEFT, RIGHT = (0, 1, 2, 6), (3, 4, 5, 7)


def test_a_plot_has_each_value_at_its_height_and_place() -> None:
    values = np.sin(np.linspace(0, 9, 2 * WIDTH))
    drawn = plot(2 * values, 2.0)
    assert [len(line) for line in drawn] == [WIDTH] * HEIGHT
    bits = [[ord(character) - 0x2800 for character in line] for line in drawn]
    for column, value in enumerate(values):
        dots = RIGHT if column % 2 else LEFT
        rows = [4 * i + row for i in range(HEIGHT) for row in range(4) if bits[i][column // 2] >> dots[row] & 1]
        assert rows == [pytest.approx((1 - value) / 2 * (4 * HEIGHT - 1), abs=0.5)]


def test_the_demonstration_marks_the_bump_and_compares() -> None:
    scenario = Scenario()
    results = {name: simulate(scenario, name) for name in ("lv", "passive")}
    text = list(lines(scenario, results))
    (mark,) = (line for line in text if "~bump~" in line)
    per_metre = WIDTH / (BEFORE + BEHIND)
    begin, end = mark.index("~"), len(mark.rstrip())
    assert (begin, end) == pytest.approx(
        (BEFORE * per_metre, (BEFORE + scenario.road.bump.length) * per_metre), abs=0.5
    )
    assert any(re.search(r"Body acceleration \[m/s\^2\] +0\.898\d \(-85%\) +6\.19$", line) for line in text)


def test_the_picture_of_a_checked_law_has_its_forces() -> None:
    """From edge to edge; the greatest one, named in words, is as high as the margin lets it be, up on the body up."""
    series = simulate(Scenario(), "skyhook").series
    picture = _picture(STRATEGIES["skyhook"])
    forces = np.array([series["front_force"], series["rear_force"]])
    curves = [
        np.array([point.split(",") for point in points.split()], dtype=float)
        for points in re.findall(r'points="([^"]+)"', picture)
    ]
    assert f"greatest force {np.abs(forces).max():.0f} N" in picture
    for force, curve in zip(forces, curves, strict=True):
        assert (curve[0, 0], curve[-1, 0]) == (40, 760)
        np.testing.assert_allclose(150 - curve[:, 1], 110 * force / np.abs(forces).max(), atol=0.06)
