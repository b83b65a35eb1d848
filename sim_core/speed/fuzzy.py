"""Fuzzy speed controller: rules over speed error and distance to the bump (section 3.1), by default Table 1's.

Mamdani min/max inference and centroid, compiled (kernel/speed.c); scikit-fuzzy's membership functions. A direct
evaluation by scikit-fuzzy takes about 10 ms.
"""

from functools import cache, lru_cache
from importlib.metadata import distribution
from runpy import run_path
from typing import Any

import numpy as np
from numpy.typing import NDArray

from sim_core.arrays import FloatArray
from sim_core.kernel import binding
from sim_core.scenario.fuzzy import DISTANCE_MAX, SPEED_ERROR_MAX, TABLE_1, Fuzzy, FuzzySet

ANY = -1  # in the place of a set that a rule does not ask for


class TorqueRules:
    """A rule base, its sets sampled over their universes, evaluated where it is asked.

    Args:
        fuzzy: The scenario's.
        error_steps: Even steps of the speed error's universe.
        distance_steps: Of the distance's.
        torque_steps: Of the torque's.
        interpolates: Whether it is evaluated at these samples alone, and between them interpolated.
    """

    def __init__(
        self, fuzzy: Fuzzy, error_steps: int, distance_steps: int, torque_steps: int, *, interpolates: bool = False
    ) -> None:
        self._errors = np.linspace(0, SPEED_ERROR_MAX, error_steps + 1)
        self._distances = np.linspace(0, DISTANCE_MAX, distance_steps + 1)
        self.prepared = binding.fuzzy_rules(
            np.ascontiguousarray(memberships(fuzzy.speed_errors, self._errors).T),
            SPEED_ERROR_MAX,
            np.ascontiguousarray(memberships(fuzzy.distances, self._distances).T),
            DISTANCE_MAX,
            _numbered(fuzzy),
            memberships(fuzzy.torques, np.linspace(0, 1, torque_steps + 1)),
            interpolates=interpolates,
        )

    def share(self, speed_error_kmh: float, distance: float) -> float:
        """Return the torque share 0 to 1 at a speed error [km/h] and distance [m], both clipped to their universes."""
        return binding.torque_share(self.prepared, speed_error_kmh, distance)

    def surface(self) -> FloatArray:
        """Return torque shares 0 to 1 at every sample of the distance and of the speed error (distances, errors)."""
        errors = self._errors.tolist()
        return np.array([[self.share(error, distance) for error in errors] for distance in self._distances.tolist()])


@lru_cache(maxsize=8)
def torque_rules(fuzzy: Fuzzy) -> TorqueRules:
    """Return a scenario's rule base: Table 1 on a grid of 0.25 km/h x 0.5 m, its own within 0.1 % of scikit-fuzzy's."""
    if fuzzy == Fuzzy():
        return TorqueRules(fuzzy, 120, 160, 100, interpolates=True)
    return TorqueRules(fuzzy, 3000, 8000, 1000)


def memberships(sets: tuple[FuzzySet, ...], universe: FloatArray) -> FloatArray:
    """Return memberships (sets, n) over a universe (n,), by scikit-fuzzy."""
    functions, rows = _membership_functions(), []
    for each in sets:
        arguments = [each.corners] if each.function in ("trimf", "trapmf") else each.corners
        with np.errstate(over="ignore"):  # a steep bell or sigmoid is 0 or 1 where a power overflows
            rows.append(functions[each.function](universe, *arguments))
    return np.array(rows)


@cache
def _membership_functions() -> dict[str, Any]:
    """Return those of scikit-fuzzy by name, from their own file: its package imports most of SciPy, for 0.8 s."""
    return run_path(str(distribution("scikit-fuzzy").locate_file("skfuzzy/membership/generatemf.py")))


def _numbered(fuzzy: Fuzzy) -> NDArray[np.intc]:
    """Return the sets of distance and error, perhaps ANY, and of the torque, by number (rules, 3)."""
    errors, distances, torques = (
        {each.name: place for place, each in enumerate(sets)}
        for sets in (fuzzy.speed_errors, fuzzy.distances, fuzzy.torques)
    )
    rows = []
    for rule in fuzzy.rules or TABLE_1:
        asked = rule.condition
        distance, error = distances.get(asked.distance or "", ANY), errors.get(asked.speed_error or "", ANY)
        rows.append((distance, error, torques[rule.then]))
    return np.array(rows, dtype=np.intc)
