"""A force in proportion to the road's rise ahead, beside damping of the body."""

import numpy as np

from sim_core import Controller, FloatArray, Preview, Seen, Setup, option, scenario_field


class PreviewProportional(Controller):
    """Pulls its wheel up before a rise that it sees coming, and damps the body."""

    id, label = "preview_proportional", "Preview, proportional"
    preview: Preview = scenario_field("mpc.preview")
    prediction_horizon: int = scenario_field("mpc.prediction_horizon")
    gain: float = option(15_000.0, unit="N/m", ge=0, le=50_000, help="Force per rise of the road.")
    time_ahead: float = option(0.05, unit="s", ge=0, le=0.3, help="How far ahead the road is looked at.")
    damping: float = option(3000.0, unit="N s/m", ge=0, le=20_000, help="Force per velocity of the body.")

    def start(self, setup: Setup) -> None:
        """Remember which of the heights ahead is meant, and where the axles are."""
        self.ahead = min(round(self.time_ahead / setup.sample_time), setup.preview_steps - 1)
        self.arms = np.array([-setup.vehicle.cg_to_front, setup.vehicle.cg_to_rear])

    def force(self, seen: Seen) -> FloatArray:
        """Against the rise between now and then, and against the body's velocity over each axle."""
        body = seen.state[4] + self.arms * seen.state[5]
        rise = seen.preview[self.ahead] - seen.preview[0] if self.ahead > 0 else np.zeros(2)
        force: FloatArray = -self.gain * rise - self.damping * body
        return force
