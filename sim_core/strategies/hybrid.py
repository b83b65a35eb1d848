"""Hybrid damping: a share of skyhook and the rest of groundhook (Ahmadian 1997, ASME DETC97/VIB-4147)."""

from sim_core import DampingController, FloatArray, Setup, axle_velocities, scenario_field


class Hybrid(DampingController):
    """A share of skyhook and the rest of groundhook, on the same speed plan as LV."""

    id = "hybrid"
    label = "Hybrid hook"
    skyhook_damping: float = scenario_field("hook.skyhook_damping")
    groundhook_damping: float = scenario_field("hook.groundhook_damping")
    alpha: float = scenario_field("hook.alpha")

    def damping(self, setup: Setup) -> FloatArray:
        """u_i = (1 - α) c_ground ż_wi - α c_sky ż_bi."""
        body, wheel = axle_velocities(setup)
        return (1 - self.alpha) * self.groundhook_damping * wheel - self.alpha * self.skyhook_damping * body
