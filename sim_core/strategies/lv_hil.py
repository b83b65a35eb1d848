"""LV's suspension control as an ECU drives it (section 4.2): C code of its own beside the simulated car."""

from sim_core import EcuController, StageWeights, Weights, scenario_field


class LvHil(EcuController):
    """LV's suspension control as C code of its own, behind converters, a step of delay and losses."""

    id = "lv_hil"
    label = "LV as ECU code"
    stage_weights: StageWeights = scenario_field("mpc.stage_weights")

    def weights(self, stage: str) -> Weights:
        """Return the stage's own."""
        return self.stage_weights.of(stage)
