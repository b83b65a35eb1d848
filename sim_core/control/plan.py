"""What a controller that looks ahead plans at one control step, and which limits shape it."""

from dataclasses import dataclass

import numpy as np

from sim_core.arrays import FloatArray

_ROUNDING = 1e-9  # of a bound


@dataclass(frozen=True, slots=True, eq=False, kw_only=True)
class Limit:
    """A limit on the magnitude of one quantity: of a force or its change, or of a deflection.

    Attributes:
        name: The quantity, such as `front_force`, `rear_force_change` or `front_deflection`.
        unit: Its SI unit.
        bound: Its largest magnitude [unit].
        values: What it limits [unit]: now, or in every interval of the horizon (n,).
        multipliers: Lagrange multiplier of each value [1/unit]: by how much the cost falls where its bound alone is
            raised; positive at the upper bound, negative at the lower one (n,). None where nothing is minimised.
        force_without: Forces that would be commanded if this limit did not exist (2,) [N]; None where no solver finds
            them.
    """

    name: str
    unit: str
    bound: float
    values: FloatArray
    multipliers: FloatArray | None
    force_without: FloatArray | None

    @property
    def distance(self) -> float:
        """How far the value nearest to the bound is from it [unit]: 0 at it, to rounding, negative beyond."""
        distance = self.bound - float(np.abs(self.values).max())
        return 0.0 if abs(distance) < _ROUNDING * self.bound else distance

    @property
    def multiplier(self) -> float | None:
        """How much the cost falls where the bound is raised for all values [1/unit]."""
        return None if self.multipliers is None else float(np.abs(self.multipliers).sum())


@dataclass(frozen=True, slots=True, eq=False, kw_only=True)
class Plan:
    """What is planned over a horizon of n control steps.

    Attributes:
        states: The half-car's predicted state now and at the end of each step (n + 1, 8), as `Seen.state` orders it.
        forces: In each step, front and rear (n, 2) [N].
        cost: What is minimised, by its terms [1].
        limits: Those that the plan keeps.
        begins: In how many control steps, 1 where it is made for when its first command takes effect.

    Example:
        >>> from sim_core import Controller, Scenario
        >>> from sim_core.instant import instant
        >>> lv, lqr = (instant(Scenario(), name, position=50.0) for name in ("lv", "lqr"))
        >>> lv.plan.states.shape, lv.plan.forces.shape, lqr.plan
        ((31, 8), (30, 2), None)
    """

    states: FloatArray
    forces: FloatArray
    cost: dict[str, float]
    limits: tuple[Limit, ...]
    begins: int = 0
