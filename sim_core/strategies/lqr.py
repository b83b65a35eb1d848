"""LQR: the regulator that minimises the same cost as LV over an endless horizon (section 4.2.2).

With preview its force has a feedforward of the known future (Tomizuka 1976). It knows no limits: its force is clipped.
"""

from functools import lru_cache

import numpy as np

from sim_core import (
    Controller,
    CostTerms,
    LinearLaw,
    Preview,
    Setup,
    Weights,
    feedforward,
    regulator,
    scenario_field,
)


class Lqr(Controller):
    """Linear quadratic regulator with fixed weights on the same speed plan as LV."""

    id = "lqr"
    label = "LQR"
    preview: Preview = scenario_field("lqr.preview")
    prediction_horizon: int = scenario_field("lqr.preview_horizon")
    weights: Weights = scenario_field("lqr.weights")
    deflection_weight: float = scenario_field("lqr.deflection_weight")
    force_weight: float = scenario_field("mpc.force_weight")

    @property
    def preview_steps(self) -> int:
        """The horizon of its feedforward, if it has one."""
        return 0 if self.preview == "none" else self.prediction_horizon

    def start(self, setup: Setup) -> None:
        """Solve the Riccati equation.

        Raises:
            RidelabError: The vehicle and weights admit no stabilising controller.
        """
        terms = setup.cost(self.weights, self.deflection_weight, self.force_weight)
        self._law = _law(terms, setup.preview_steps)

    def linear_law(self, stage: str) -> LinearLaw:
        """U = -K x + K_w w, the same in every stage."""
        return self._law


@lru_cache(maxsize=64)
def _law(terms: CostTerms, horizon: int) -> LinearLaw:
    return LinearLaw(
        gain=np.hstack([regulator(terms).gain, np.zeros((2, 2))]),
        preview_gain=feedforward(terms, horizon) if horizon else None,
    )
