"""LV control: the paper's (section 3), with MPC weights by driving stage (Table 6)."""

from sim_core import PredictiveController, StageWeights, Weights, scenario_field


class Lv(PredictiveController):
    """Fuzzy speed control and MPC suspension, weights switched by driving stage (Table 6)."""

    id = "lv"
    label = "LV control"
    stage_weights: StageWeights = scenario_field("mpc.stage_weights")

    def weights(self, stage: str) -> Weights:
        """Return the stage's own."""
        return self.stage_weights.of(stage)
