"""LV control: the paper's (section 3), with MPC weights by driving stage (Table 6)."""

from sim_core import PredictiveController, Weights, scenario_field


class Lv(PredictiveController):
    """Fuzzy speed control and MPC suspension, weights switched by driving stage (Table 6)."""

    id = "lv"
    label = "LV control"
    cruise: Weights = scenario_field("mpc.stage_weights.cruise")
    brake: Weights = scenario_field("mpc.stage_weights.brake")
    bump: Weights = scenario_field("mpc.stage_weights.bump")

    def weights(self, stage: str) -> Weights:
        """The stage's own."""
        return {"cruise": self.cruise, "brake": self.brake, "bump": self.bump}[stage]
