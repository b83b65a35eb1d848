"""Skyhook damping (Karnopp, Crosby and Harwood 1974, J. Eng. Ind. 96, 619-626)."""

from sim_core import DampingController, FloatArray, Setup, axle_velocities, scenario_field


class Skyhook(DampingController):
    """Damps the body against the sky, on the same speed plan as LV."""

    id = "skyhook"
    label = "Skyhook"
    skyhook_damping: float = scenario_field("hook.skyhook_damping")

    def damping(self, setup: Setup) -> FloatArray:
        """u_i = -c_sky ż_bi: each axle's force against the body's velocity above it."""
        body, _ = axle_velocities(setup)
        return -self.skyhook_damping * body
