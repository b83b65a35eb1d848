"""Skyhook, groundhook and hybrid damping, active or semi-active.

Skyhook damps the body against the sky (Karnopp, Crosby and Harwood 1974, J. Eng. Ind. 96), groundhook the wheel against
the ground, hybrid is a share of both (Ahmadian 1997, ASME DETC97/VIB-4147). Each axle has its own: the force lifts the
body and presses the wheel down, so u_i = -c_sky ż_bi and u_i = c_ground ż_wi.
"""

import numpy as np

from sim_core.arrays import BoolArray, FloatArray
from sim_core.control.controller import Controller
from sim_core.scenario import Hook, Vehicle
from sim_core.vehicle.half_car import FORCES, STATES, deflection_speeds
from sim_core.vehicle.model import LinearLaw


def hook_gain(vehicle: Vehicle, hook: Hook, alpha: float) -> FloatArray:
    """The law on [state; previous command] (2, 10) in N: `alpha` of skyhook, the rest of groundhook."""
    gain = np.zeros((FORCES, STATES + FORCES))
    wheel = np.eye(FORCES, STATES, k=6)
    body = deflection_speeds(vehicle) + wheel
    gain[:, :STATES] = (1 - alpha) * hook.groundhook_damping * wheel - alpha * hook.skyhook_damping * body
    return gain


class HookController(Controller):
    """One of these laws within the force limit; what semi-active dampers make of it is theirs (`SemiActiveDampers`)."""

    def __init__(self, gain: FloatArray, force_limit: float) -> None:
        super().__init__()
        self._law = LinearLaw(gain=gain, force_limit=force_limit)

    def law(self, stage: str) -> LinearLaw:
        """The same in every stage."""
        return self._law

    def holds(self, first: int, stage: str, measured: FloatArray, commands: FloatArray) -> BoolArray:
        """Where its forces are within the limit."""
        return np.asarray((np.abs(commands) <= self._law.force_limit).all(axis=1))

    def step(self, step: int, stage: str, state: FloatArray, previous: FloatArray) -> tuple[FloatArray, bool]:
        """The law's force, clipped."""
        wanted = self._law.gain[:, :STATES] @ state
        force = np.clip(wanted, -self._law.force_limit, self._law.force_limit)
        return force, not np.array_equal(force, wanted)
