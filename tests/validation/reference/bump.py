"""Bump shapes by their definitions."""

from typing import Any

import numpy as np
from numpy.typing import NDArray

from sim_core.scenario import Bump

Array = NDArray[np.floating[Any]]


def bump_height(bump: Bump, x: Array) -> Array:
    """Height of the bumps at x [m], each by its definition, added up."""
    return sum((_one(bump, x - number * bump.spacing) for number in range(bump.count)), np.zeros(np.shape(x)))


def _one(bump: Bump, x: Array) -> Array:
    if bump.shape == "kerb":
        return bump.height * np.sin(np.interp(x, [bump.start, bump.start + bump.width], [0, np.pi / 2])) ** 2
    s = (np.asarray(x, dtype=float) - bump.start) / bump.width
    inside = (s > 0) & (s < 1)
    s = np.clip(s, 0, 1)
    match bump.shape:
        case "cosine":
            shape = (1 - np.cos(2 * np.pi * s)) / 2
        case "half_sine":
            shape = np.sin(np.pi * s)
        case "circular":
            rise, half = abs(bump.height), bump.width / 2
            radius = (rise**2 + half**2) / (2 * rise) if rise else np.inf
            offset = (s - 0.5) * bump.width
            arc = np.sqrt(np.maximum(radius**2 - offset**2, 0)) - (radius - rise) if rise else 0 * s
            shape = arc / rise if rise else arc
        case "flat_top":
            ramp = np.minimum(np.minimum(s, 1 - s) / 0.25, 1)
            shape = (1 - np.cos(np.pi * ramp)) / 2
        case "trapezoid":
            shape = np.minimum(np.minimum(s, 1 - s) / 0.25, 1)
    return bump.height * shape * inside
