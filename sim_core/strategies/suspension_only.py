"""Single suspension control: the paper's MPC without the speed control, with weights by road (Table 3)."""

from sim_core import PredictiveController, RoadWeights, Weights, scenario_field


class SuspensionOnly(PredictiveController):
    """MPC suspension at constant speed, weights switched by road (Table 3)."""

    id = "suspension_only"
    label = "Single suspension control"
    speed_plan = "constant"
    road_weights: RoadWeights = scenario_field("mpc.road_weights")

    def weights(self, stage: str) -> Weights:
        """Return those of the bump on it, of the rough road before and behind it."""
        return self.road_weights.bump if stage == "bump" else self.road_weights.rough
