"""Fuzzy speed controller: rules over speed error and distance to the bump (section 3.1), by default Table 1's.

Mamdani min/max inference and centroid, compiled (kernel/fuzzy.c); scikit-fuzzy's membership functions. A direct
evaluation by scikit-fuzzy takes about 10 ms.
"""

from dataclasses import dataclass
from functools import cache, lru_cache
from importlib.util import find_spec, module_from_spec, spec_from_file_location
from pathlib import Path
from types import ModuleType
from typing import Protocol

import numpy as np

from sim_core.arrays import FloatArray, IntArray
from sim_core.kernel import binding
from sim_core.scenario.fuzzy import DISTANCE_MAX, SPEED_ERROR_MAX, TABLE_1, Fuzzy, FuzzySet

ANY = -1  # in the place of a set that a rule does not ask for


class TorqueRules(Protocol):
    """What the speed plan asks for the braking torque."""

    def share(self, speed_error_kmh: float, distance: float) -> float:
        """Torque share 0 to 1 at a speed error [km/h] and distance [m], both clipped to their universes."""


@dataclass(frozen=True, slots=True, eq=False, kw_only=True)
class RuleBase:
    """Sets sampled over their universes, and rules.

    Attributes:
        error: Memberships of speed errors in their sets (samples, sets), from 0 to SPEED_ERROR_MAX.
        distance: The same of distances, from 0 to DISTANCE_MAX.
        torque: Memberships of torque shares (sets, samples), from 0 to 1.
        rules: Sets of distance and error, perhaps ANY, and of the torque (rules, 3).
    """

    error: FloatArray
    distance: FloatArray
    torque: FloatArray
    rules: IntArray

    @classmethod
    def of(cls, fuzzy: Fuzzy, error_steps: int, distance_steps: int, torque_steps: int) -> "RuleBase":
        """The scenario's, sampled in so many even steps."""
        errors = np.linspace(0, SPEED_ERROR_MAX, error_steps + 1)
        distances = np.linspace(0, DISTANCE_MAX, distance_steps + 1)
        return cls(
            error=np.ascontiguousarray(memberships(fuzzy.speed_errors, errors).T),
            distance=np.ascontiguousarray(memberships(fuzzy.distances, distances).T),
            torque=memberships(fuzzy.torques, np.linspace(0, 1, torque_steps + 1)),
            rules=_numbered(fuzzy),
        )

    def shares(self, distance: FloatArray, errors: FloatArray) -> FloatArray:
        """Torque shares (n,) at one distance's memberships (sets,) and n errors' (sets, n)."""
        shares = np.empty(errors.shape[1])
        binding.torque_shares(distance, errors, self.rules, self.torque, shares)
        return shares


class TorqueSurface:
    """Table 1: braking torque as a share of its universe, on a grid of 0.25 km/h × 0.5 m.

    Every plan asks it, so that it is made once and interpolated. Its rows, one for each distance, are evaluated when
    they are first asked for: no drive needs all.
    """

    def __init__(self) -> None:
        self._base = RuleBase.of(Fuzzy(), 120, 160, 100)
        self._errors = np.ascontiguousarray(self._base.error.T)
        self._rows: dict[int, list[float]] = {}

    def share(self, speed_error_kmh: float, distance: float) -> float:
        """See `TorqueRules`."""
        j, fx = _place(speed_error_kmh, SPEED_ERROR_MAX, len(self._base.error))
        i, fy = _place(distance, DISTANCE_MAX, len(self._base.distance))
        low, high = self._row(i), self._row(i + 1)
        first = low[j] + fx * (low[j + 1] - low[j])
        return first + fy * (high[j] + fx * (high[j + 1] - high[j]) - first)

    def _row(self, number: int) -> list[float]:
        """Shares at one distance, over the errors."""
        if number not in self._rows:
            self._rows[number] = self._base.shares(self._base.distance[number], self._errors).tolist()
        return self._rows[number]


class OwnRules:
    """A scenario's own rule base, evaluated where it is asked: within 0.1 % of scikit-fuzzy's."""

    def __init__(self, fuzzy: Fuzzy) -> None:
        self._base = RuleBase.of(fuzzy, 3000, 8000, 1000)

    def share(self, speed_error_kmh: float, distance: float) -> float:
        """See `TorqueRules`."""
        base = self._base
        errors = _between(base.error, *_place(speed_error_kmh, SPEED_ERROR_MAX, len(base.error)))
        distances = _between(base.distance, *_place(distance, DISTANCE_MAX, len(base.distance)))
        return float(base.shares(distances, errors[:, None])[0])


@lru_cache(maxsize=8)
def torque_rules(fuzzy: Fuzzy) -> TorqueRules:
    """The rule base of a scenario."""
    return TorqueSurface() if fuzzy == Fuzzy() else OwnRules(fuzzy)


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


def _numbered(fuzzy: Fuzzy) -> IntArray:
    """`RuleBase.rules`."""
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
