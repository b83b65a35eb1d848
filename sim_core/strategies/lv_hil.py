"""LV's suspension control as an ECU drives it (section 4.2): C code of its own beside the simulated car."""

from sim_core import EcuController, Weights, scenario_field


class LvHil(EcuController):
    """LV's suspension control as C code of its own, behind converters, a step of delay and losses."""

    id = "lv_hil"
    label = "LV as ECU code"
    cruise: Weights = scenario_field("mpc.stage_weights.cruise")
    brake: Weights = scenario_field("mpc.stage_weights.brake")
    bump: Weights = scenario_field("mpc.stage_weights.bump")

    def weights(self, stage: str) -> Weights:
        """The stage's own."""
        return {"cruise": self.cruise, "brake": self.brake, "bump": self.bump}[stage]
