"""LQR as a visitor writes it: the core's cost and Riccati equation, the law said once and driven in blocks."""

import numpy as np

from sim_core import Controller, LinearLaw, Setup, option, regulator


class MyLqr(Controller):
    """Minimises the same cost as Ridelab's LQR, with weights of its own."""

    id, label = "my_lqr", "My LQR"
    body: float = option(1.0, ge=0, le=1000, help="Weight of the body's acceleration.")
    pitch: float = option(1.0, ge=0, le=1000, help="Weight of the pitch acceleration.")
    tyres: float = option(1.0, ge=0, le=1000, help="Weight of the tyre loads.")
    travel: float = option(3.0, ge=0, le=1000, help="Weight of the suspension deflections.")
    force_weight: float = option(1e-9, unit="1/N^2", ge=1e-12, le=1e-3, help="Weight of the forces.")

    def start(self, setup: Setup) -> None:
        """Solve the Riccati equation for this car and sample time."""
        cost = setup.cost((self.body, self.pitch, self.tyres), self.travel, self.force_weight)
        self.law = LinearLaw(gain=np.hstack([regulator(cost).gain, np.zeros((2, 2))]))

    def linear_law(self, stage: str) -> LinearLaw:
        """The same in every stage."""
        return self.law
