"""Fuzzy speed controller: Table 1's rules over speed error and distance to the bump (section 3.1).

Mamdani min/max inference, five even triangles each, centroid. One direct scikit-fuzzy evaluation takes about
10 ms, so its memberships make a surface once and a run interpolates.
"""

from functools import lru_cache

import numpy as np

from sim_core.arrays import FloatArray
from sim_core.kernel import binding

SETS = "OSMLV"  # very low, medium-low, medium, medium-high, very high
# Rows: distance to the bump O to V; columns: speed error O to V; entries: braking torque (Table 1).
RULES = ("OMLVV", "OMLVV", "OSMLL", "OSMML", "OSSMM")
SPEED_ERROR_MAX = 30.0  # universe [0, 30] km/h
DISTANCE_MAX = 80.0  # universe [0, 80] m
_ERROR_STEPS, _DISTANCE_STEPS, _TORQUE_STEPS = 120, 160, 100


def even_triangles(universe: FloatArray) -> FloatArray:
    """Memberships (5, n) of five even triangles over a universe (n,); the outer two are halves."""
    import skfuzzy  # takes a third of a second: a process that only plans never needs it

    peaks = np.linspace(universe[0], universe[-1], len(SETS))
    width = peaks[1] - peaks[0]
    return np.array([skfuzzy.trimf(universe, [peak - width, peak, peak + width]) for peak in peaks])


class TorqueSurface:
    """Table 1: braking torque as a share of its universe, on a grid of 0.25 km/h × 0.5 m.

    Its rows, one for each distance, are evaluated when they are first asked for: no drive needs all. By the C of
    kernel/fuzzy.c.
    """

    def __init__(self) -> None:
        self._error = even_triangles(np.linspace(0, SPEED_ERROR_MAX, _ERROR_STEPS + 1))
        self._distance = even_triangles(np.linspace(0, DISTANCE_MAX, _DISTANCE_STEPS + 1)).T
        self._torque = even_triangles(np.linspace(0, 1, _TORQUE_STEPS + 1))
        self._rules = np.array([SETS.index(conclusion) for row in RULES for conclusion in row], dtype=np.intc)
        self._rows: dict[int, list[float]] = {}

    def share(self, speed_error_kmh: float, distance: float) -> float:
        """Torque share 0 to 1 at a speed error [km/h] and distance [m], both clipped to their universes."""
        column = min(max(speed_error_kmh, 0.0), SPEED_ERROR_MAX) * (_ERROR_STEPS / SPEED_ERROR_MAX)
        row = min(max(distance, 0.0), DISTANCE_MAX) * (_DISTANCE_STEPS / DISTANCE_MAX)
        i, j = min(int(row), _DISTANCE_STEPS - 1), min(int(column), _ERROR_STEPS - 1)
        fy, fx = row - i, column - j
        low, high = self._row(i), self._row(i + 1)
        first = low[j] + fx * (low[j + 1] - low[j])
        return first + fy * (high[j] + fx * (high[j + 1] - high[j]) - first)

    def _row(self, number: int) -> list[float]:
        """Shares at one distance, over the errors."""
        if number not in self._rows:
            distance, shares = np.ascontiguousarray(self._distance[number]), np.empty(_ERROR_STEPS + 1)
            binding.torque_shares(distance, self._error, self._rules, self._torque, shares)
            self._rows[number] = shares.tolist()
        return self._rows[number]


@lru_cache(maxsize=1)
def torque_surface() -> TorqueSurface:
    """The one surface of a process."""
    return TorqueSurface()
