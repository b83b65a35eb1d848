"""Two roads as a surveyor would hand them in: `python -m backend.roads.samples street > street.csv`.

`street` has two tracks, a climb of 2 % and a Watts hump in a class B road; `gravel` one track of a class C road with a
washboard and a pothole. docs/roads has both.
"""

import sys

import numpy as np

from sim_core import Bump, FloatArray, Road
from sim_core.road.profile import bump_height, road_profile

FLAT = Bump(height=0)
HUMP = Bump(shape="circular", height=0.075, width=3.7, start=100)
WASHBOARD = Bump(height=0.024, width=0.7, start=60, count=30, spacing=0.7)
POTHOLE = Bump(shape="trapezoid", height=-0.05, width=1.2, start=110)


def street() -> str:
    """Both wheel tracks, every 10 cm: alike in long waves, a third as rough again each by itself."""
    x = np.arange(0, 180.05, 0.1)
    common = _rough(x, 48e-6, 1) + bump_height(HUMP, x) + 0.02 * x + 31.4
    left, right = (common + _rough(x, 16e-6, seed) for seed in (2, 3))
    return _csv("distance [m],left [mm],right [mm]", x, 1000 * left, 1000 * right)


def gravel() -> str:
    """One track, every 5 cm."""
    x = np.arange(0, 150.025, 0.05)
    height = _rough(x, 256e-6, 4) + bump_height(WASHBOARD, x) + bump_height(POTHOLE, x)
    return _csv("distance [m],height [mm]", x, 1000 * height)


SAMPLES = {"street": street, "gravel": gravel}


def _rough(x: FloatArray, roughness: float, seed: int) -> FloatArray:
    return road_profile(Road(roughness=roughness, seed=seed, length=200, bump=FLAT)).height(x)


def _csv(head: str, *columns: FloatArray) -> str:
    lines = [",".join([f"{row[0]:.2f}", *(f"{value:.1f}" for value in row[1:])]) for row in zip(*columns, strict=True)]
    return "\n".join([head, *lines, ""])


if __name__ == "__main__":
    sys.stdout.write(SAMPLES[sys.argv[1]]())
