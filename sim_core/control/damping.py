"""What skyhook, groundhook and hybrid damping share: a law of velocities, by actuators or semi-active dampers."""

from math import inf

import numpy as np

from sim_core.arrays import FloatArray
from sim_core.control.controller import Controller, undefined
from sim_core.control.declared import scenario_field
from sim_core.control.law import LinearLaw
from sim_core.control.seen import Setup
from sim_core.vehicle.half_car import FORCES, STATES
from sim_core.vehicle.model import SemiActiveDampers


class DampingController(Controller):
    """A law u = damping·state, without preview; a subclass gives its `damping`.

    Example:
        >>> from sim_core import DampingController, Scenario, axle_velocities, simulate
        >>> class Skyhook(DampingController):
        ...     def damping(self, setup):
        ...         body, wheel = axle_velocities(setup)
        ...         return -4000.0 * body
        >>> skyhook, speed_only = simulate(Scenario(), Skyhook), simulate(Scenario(), "speed_only")
        >>> skyhook.comfort["weighted_rms"] < speed_only.comfort["weighted_rms"]
        True
    """

    semi_active: bool = scenario_field("hook.semi_active")
    min_damping: float = scenario_field("hook.min_damping")
    max_damping: float | None = scenario_field("hook.max_damping")

    def damping(self, setup: Setup) -> FloatArray:
        """Gains of the forces front and rear [N] on the state (2, 8), whose order `Seen.state` has.

        Raises:
            RidelabError: The class does not define it.
        """
        raise undefined(self, "damping(setup)")

    def start(self, setup: Setup) -> None:
        """Make the law."""
        self._law = LinearLaw(gain=np.hstack([self.damping(setup), np.zeros((FORCES, FORCES))]))

    def linear_law(self, stage: str) -> LinearLaw:
        """Return the same in every stage."""
        return self._law

    def dampers(self) -> SemiActiveDampers | None:
        """Semi-active dampers where `hook.semi_active` asks for them; None where actuators act beside the dampers."""
        if not self.semi_active:
            return None
        return SemiActiveDampers(
            least=self.min_damping,
            most=inf if self.max_damping is None else self.max_damping,
        )


def axle_velocities(setup: Setup) -> tuple[FloatArray, FloatArray]:
    """Velocities [m/s] of the body above both axles, and of both wheels, each as rows on the state (2, 8).

    Example:
        >>> from types import SimpleNamespace
        >>> from sim_core import Scenario, axle_velocities
        >>> body, wheel = axle_velocities(SimpleNamespace(vehicle=Scenario().vehicle))
        >>> pitching = [0, 0, 0, 0, 0, 1, 0, 0]  # at 1 rad/s, nose down
        >>> (body @ pitching).tolist(), (wheel @ pitching).tolist()
        ([-1.015, 1.895], [0.0, 0.0])
    """
    body = np.zeros((FORCES, STATES))
    body[:, 4] = 1.0
    body[:, 5] = -setup.vehicle.cg_to_front, setup.vehicle.cg_to_rear
    return body, np.eye(FORCES, STATES, k=6)
