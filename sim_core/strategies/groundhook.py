"""Groundhook damping (Ahmadian 1997, ASME DETC97/VIB-4147)."""

from sim_core import DampingController, FloatArray, Setup, axle_velocities, scenario_field


class Groundhook(DampingController):
    """Damps the wheels against the ground, on the same speed plan as LV."""

    id = "groundhook"
    label = "Groundhook"
    groundhook_damping: float = scenario_field("hook.groundhook_damping")

    def damping(self, setup: Setup) -> FloatArray:
        """u_i = c_ground ż_wi: a force that lifts the body presses the wheel down."""
        _, wheel = axle_velocities(setup)
        return self.groundhook_damping * wheel
