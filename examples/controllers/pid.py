"""PID on the suspension deflections, as the car's own sensors measure them."""

import numpy as np

from sim_core import Controller, FloatArray, Seen, Setup, option


class DeflectionPid(Controller):
    """Brings each suspension back to its static length by a PID of its own."""

    id, label = "deflection_pid", "PID on deflections"
    proportional: float = option(2000.0, unit="N/m", ge=0, le=50_000, help="Force per deflection.")
    integral: float = option(500.0, unit="N/(m s)", ge=0, le=50_000, help="Force per deflection and second.")
    derivative: float = option(800.0, unit="N s/m", ge=0, le=10_000, help="Force per deflection's velocity.")

    def start(self, setup: Setup) -> None:
        """Forget the run before."""
        self.step, self.sum, self.before = setup.sample_time, np.zeros(2), np.zeros(2)

    def force(self, seen: Seen) -> FloatArray:
        """Against the deflection, its integral and its change since the step before."""
        deflection = seen.measurement[:2]
        self.sum = self.sum + self.step * deflection
        change, self.before = (deflection - self.before) / self.step, deflection
        force: FloatArray = -self.proportional * deflection - self.integral * self.sum - self.derivative * change
        return force
