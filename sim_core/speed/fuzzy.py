"""Fuzzy speed controller: rules over speed error and distance to the bump (section 3.1), by default Table 1's.

Mamdani min/max inference and centroid, compiled (kernel/fuzzy.c); scikit-fuzzy's membership functions. A direct
evaluation by scikit-fuzzy takes about 10 ms.
"""

from functools import cache, lru_cache
from importlib.util import find_spec, module_from_spec, spec_from_file_location
from pathlib import Path
from types import ModuleType

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
    """

    def __init__(self, fuzzy: Fuzzy, error_steps: int, distance_steps: int, torque_steps: int) -> None:
        errors = np.linspace(0, SPEED_ERROR_MAX, error_steps + 1)
        distances = np.linspace(0, DISTANCE_MAX, distance_steps + 1)
        self._error = np.ascontiguousarray(memberships(fuzzy.speed_errors, errors).T)  # (samples, sets)
        self._distance = np.ascontiguousarray(memberships(fuzzy.distances, distances).T)
        self._torque = memberships(fuzzy.torques, np.linspace(0, 1, torque_steps + 1))  # (sets, samples)
        self._rules = _numbered(fuzzy)

    def share(self, speed_error_kmh: float, distance: float) -> float:
        """Torque share 0 to 1 at a speed error [km/h] and distance [m], both clipped to their universes."""
        errors = _between(self._error, *_place(speed_error_kmh, SPEED_ERROR_MAX, len(self._error)))
        distances = _between(self._distance, *_place(distance, DISTANCE_MAX, len(self._distance)))
        return float(self._shares(distances, errors[:, None])[0])

    def surface(self) -> FloatArray:
        """Torque shares 0 to 1 at every sample of the distance and of the speed error (distances, errors)."""
        errors = np.ascontiguousarray(self._error.T)
        return np.array([self._shares(distance, errors) for distance in self._distance])

    def _shares(self, distance: FloatArray, errors: FloatArray) -> FloatArray:
        """Torque shares (n,) at one distance's memberships (sets,) and n errors' (sets, n)."""
        shares = np.empty(errors.shape[1])
        binding.torque_shares(distance, errors, self._rules, self._torque, shares)
        return shares


class TorqueSurface(TorqueRules):
    """Table 1: braking torque as a share of its universe, on a grid of 0.25 km/h × 0.5 m.

    Every plan asks it, so that it is made once and interpolated. Its rows, one for each distance, are evaluated when
    they are first asked for: no drive needs all.
    """

    def __init__(self) -> None:
        super().__init__(Fuzzy(), 120, 160, 100)
        self._errors = np.ascontiguousarray(self._error.T)
        self._rows: dict[int, list[float]] = {}

    def share(self, speed_error_kmh: float, distance: float) -> float:
        """As `TorqueRules` says."""
        j, fx = _place(speed_error_kmh, SPEED_ERROR_MAX, len(self._error))
        i, fy = _place(distance, DISTANCE_MAX, len(self._distance))
        low, high = self._row(i), self._row(i + 1)
        first = low[j] + fx * (low[j + 1] - low[j])
        return first + fy * (high[j] + fx * (high[j + 1] - high[j]) - first)

    def _row(self, number: int) -> list[float]:
        """Shares at one distance, over the errors."""
        if number not in self._rows:
            self._rows[number] = self._shares(self._distance[number], self._errors).tolist()
        return self._rows[number]


@lru_cache(maxsize=8)
def torque_rules(fuzzy: Fuzzy) -> TorqueRules:
    """The rule base of a scenario; one of its own is within 0.1 % of scikit-fuzzy's."""
    return TorqueSurface() if fuzzy == Fuzzy() else TorqueRules(fuzzy, 3000, 8000, 1000)


def memberships(sets: tuple[FuzzySet, ...], universe: FloatArray) -> FloatArray:
    """Memberships (sets, n) over a universe (n,), by scikit-fuzzy."""
    functions, rows = _membership_functions(), []
    for each in sets:
        arguments = [each.corners] if each.function in ("trimf", "trapmf") else each.corners
        with np.errstate(over="ignore"):  # a steep bell or sigmoid is 0 or 1 where a power overflows
            rows.append(getattr(functions, each.function)(universe, *arguments))
    return np.array(rows)


@cache
def _membership_functions() -> ModuleType:
    """scikit-fuzzy's module of them by itself: the package would import its clustering, and with it most of SciPy."""
    package = find_spec("skfuzzy")
    folder = Path(package.origin).parent if package and package.origin else Path()
    spec = spec_from_file_location("sim_core.speed._membership_functions", folder / "membership" / "generatemf.py")
    if spec is None or spec.loader is None:
        raise ImportError("scikit-fuzzy is not installed")
    module = module_from_spec(spec)
    spec.loader.exec_module(module)
    return module


def _numbered(fuzzy: Fuzzy) -> NDArray[np.intc]:
    """Sets of distance and error, perhaps ANY, and of the torque (rules, 3)."""
    errors, distances, torques = (
        {each.name: place for place, each in enumerate(sets)}
        for sets in (fuzzy.speed_errors, fuzzy.distances, fuzzy.torques)
    )
    rows = [
        (
            distances.get(rule.condition.distance or "", ANY),
            errors.get(rule.condition.speed_error or "", ANY),
            torques[rule.then],
        )
        for rule in fuzzy.rules or TABLE_1
    ]
    return np.array(rows, dtype=np.intc)


def _place(value: float, end: float, samples: int) -> tuple[int, float]:
    """Before which of so many even samples from 0 to `end` a value lies, clipped, and how far behind it, 0 to 1."""
    place = min(max(value, 0.0), end) * ((samples - 1) / end)
    index = min(int(place), samples - 2)
    return index, place - index


def _between(table: FloatArray, index: int, share: float) -> FloatArray:
    """A row between two of a table."""
    row: FloatArray = table[index] + share * (table[index + 1] - table[index])
    return row
