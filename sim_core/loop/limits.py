"""In which control steps a linear law holds, because none of its limits binds.

A bound in single precision rules most steps out: by Cauchy and Schwarz a row of the law's limits comes, on the preview
of a step, to no more than its norm times the preview's. Steps near a limit are judged by the rows themselves.
"""

from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from sim_core.arrays import BoolArray, FloatArray
from sim_core.caching import cached
from sim_core.loop.preview import Forecast, flattened
from sim_core.vehicle.half_car import DISTURBANCES
from sim_core.vehicle.model import LAW_INPUTS, LinearLaw

WITHIN = 1 - 1e-9  # of a limit: so that rounding does not pass it
_BOUND_MARGIN = 0.99  # of a limit; the bound is in single precision, whose rounding is 1e-6 of the terms added
_MIN_BOUND_STEPS = 128  # so few cross the bump or follow a limit: most are near one, and the bound rules few out


@dataclass(frozen=True, slots=True, eq=False, kw_only=True)
class LawLimits:
    """Of one law in one run.

    Attributes:
        law: The law.
        force_limit: Of each force [N].
        forecast: What is previewed.
    """

    law: LinearLaw
    force_limit: float
    forecast: Forecast

    def hold(self, first: int, measured: FloatArray, forces: FloatArray) -> BoolArray:
        """In which control steps none binds (n,).

        Args:
            first: Index of the first of them.
            measured: State and previous force in each (n, 10).
            forces: The law's in each (n, 2) [N].
        """
        within = np.asarray((np.abs(forces) <= self.force_limit * WITHIN).all(axis=1))  # a NaN is within nothing
        if self.law.limits is None:
            return within
        steps = np.arange(first, first + len(measured))
        if len(measured) >= _MIN_BOUND_STEPS:
            with np.errstate(over="ignore", invalid="ignore"):  # a loop that diverges is within no limit
                sums = np.vstack([self.forecast.braking, self.forecast.spread])[:, steps]
                bound = _bound(self.law) @ np.concatenate([measured.T, sums], dtype=np.float32)
                near = np.flatnonzero(~(bound.max(axis=0) <= _BOUND_MARGIN))
        else:
            near = np.arange(len(measured))
        if len(near):
            inputs = np.hstack([measured[near], flattened(self.forecast.windows[:, steps[near]])])
            within[near] &= (np.abs(inputs @ self.law.limits.T) <= WITHIN).all(axis=1)
        return within


@cached
def _bound(law: LinearLaw) -> NDArray[np.float32]:
    """Rows of either sign on [state; previous force; mean deceleration], then their norms on the rest of the preview.

    Shape (2 · rows, 14).
    """
    assert law.limits is not None  # noqa: S101 - who asks has looked
    by_disturbance = law.limits[:, LAW_INPUTS:].reshape(len(law.limits), DISTURBANCES, -1)
    gain = np.hstack([law.limits[:, :LAW_INPUTS], by_disturbance[:, 2].sum(axis=1)[:, None]])
    norms = np.linalg.norm(by_disturbance, axis=2)
    return np.vstack([np.hstack([gain, norms]), np.hstack([-gain, norms])]).astype(np.float32)
