"""Fuzzy speed controller: Table 1's rules over speed error and distance to the bump (section 3.1).

Mamdani min/max inference, five even triangles each, centroid. One direct scikit-fuzzy evaluation takes about
10 ms, so its memberships make the whole surface once and a run interpolates.
"""

from dataclasses import dataclass
from functools import lru_cache

import numpy as np
import skfuzzy

from sim_core.arrays import FloatArray

SETS = "OSMLV"  # very low, medium-low, medium, medium-high, very high
# Rows: distance to the bump O to V; columns: speed error O to V; entries: braking torque (Table 1).
RULES = ("OMLVV", "OMLVV", "OSMLL", "OSMML", "OSSMM")
SPEED_ERROR_MAX = 30.0  # universe [0, 30] km/h
DISTANCE_MAX = 80.0  # universe [0, 80] m
_ERROR_STEPS, _DISTANCE_STEPS, _TORQUE_STEPS = 120, 160, 100
_ROWS = 8  # of the surface at a time: what they need stays in a processor's cache


def even_triangles(universe: FloatArray) -> FloatArray:
    """Memberships (5, n) of five even triangles over a universe (n,); the outer two are halves."""
    peaks = np.linspace(universe[0], universe[-1], len(SETS))
    width = peaks[1] - peaks[0]
    return np.array([skfuzzy.trimf(universe, [peak - width, peak, peak + width]) for peak in peaks])


@dataclass(frozen=True, slots=True, eq=False)
class TorqueSurface:
    """Braking torque as a share of its universe, on an even grid (distance, speed error)."""

    table: tuple[tuple[float, ...], ...]

    def share(self, speed_error_kmh: float, distance: float) -> float:
        """Torque share 0 to 1 at a speed error [km/h] and distance [m], both clipped to their universes."""
        column = min(max(speed_error_kmh, 0.0), SPEED_ERROR_MAX) * (_ERROR_STEPS / SPEED_ERROR_MAX)
        row = min(max(distance, 0.0), DISTANCE_MAX) * (_DISTANCE_STEPS / DISTANCE_MAX)
        i, j = min(int(row), _DISTANCE_STEPS - 1), min(int(column), _ERROR_STEPS - 1)
        fy, fx = row - i, column - j
        low, high = self.table[i], self.table[i + 1]
        first = low[j] + fx * (low[j + 1] - low[j])
        return first + fy * (high[j] + fx * (high[j + 1] - high[j]) - first)


@lru_cache(maxsize=1)
def torque_surface() -> TorqueSurface:
    """Table 1 evaluated on a grid of 0.25 km/h × 0.5 m."""
    error = even_triangles(np.linspace(0, SPEED_ERROR_MAX, _ERROR_STEPS + 1))
    distance = even_triangles(np.linspace(0, DISTANCE_MAX, _DISTANCE_STEPS + 1))
    torque_universe = np.linspace(0, 1, _TORQUE_STEPS + 1)
    torque = even_triangles(torque_universe)

    fired = np.zeros((len(SETS), distance.shape[1], error.shape[1]))  # how strongly each torque set is concluded
    for s, row in enumerate(RULES):
        for v, conclusion in enumerate(row):
            strength = np.minimum(distance[s][:, None], error[v][None, :])
            index = SETS.index(conclusion)
            fired[index] = np.maximum(fired[index], strength)

    # Between two neighbouring peaks of the torque only their two sets are concluded at all.
    weight = np.ones_like(torque_universe)
    weight[[0, -1]] = 0.5  # trapezoids
    moments = np.stack([weight * torque_universe, weight], axis=1)
    between = _TORQUE_STEPS // (len(SETS) - 1)
    centroid = np.empty(fired.shape[1:])
    for first in range(0, len(centroid), _ROWS):
        rows = slice(first, first + _ROWS)
        sums = np.zeros((*centroid[rows].shape, 2))
        for low in range(len(SETS) - 1):
            part = slice(low * between, (low + 1) * between + (low == len(SETS) - 2))
            concluded = np.minimum(fired[low, rows, :, None], torque[low, part])
            other = np.minimum(fired[low + 1, rows, :, None], torque[low + 1, part])
            sums += np.maximum(concluded, other, out=concluded) @ moments[part]
        centroid[rows] = sums[..., 0] / sums[..., 1]
    return TorqueSurface(tuple(map(tuple, centroid.tolist())))
