"""The linear car with its actuators, stepped exactly."""

from dataclasses import dataclass
from math import pi

import numpy as np

from sim_core.arrays import FloatArray
from sim_core.caching import cached
from sim_core.scenario import Actuator, Vehicle
from sim_core.vehicle.half_car import DISTURBANCES, FORCES, STATES, half_car, hold


@dataclass(frozen=True, slots=True, eq=False, kw_only=True)
class Plant:
    """One step: p' = A p + B u + E w, with command u [N] and disturbances w held; A (n, n), B (n, 2), E (n, 3).

    p is the half-car's state (8,), with a lagging actuator joined by the two forces [N] (10,).
    """

    A: FloatArray
    B: FloatArray
    E: FloatArray

    @property
    def size(self) -> int:
        """Length of the plant's state."""
        return len(self.A)


@cached
def plant(vehicle: Vehicle, actuator: Actuator, step: float) -> Plant:
    """The plant over a step [s]."""
    model = half_car(vehicle)
    A, inputs = model.A, np.hstack([model.B, model.E])
    if actuator.bandwidth is not None:  # u̇ = 2π f (command - u): the forces become states, the command drives them
        corner = 2 * pi * actuator.bandwidth
        A = np.block([[model.A, model.B], [np.zeros((FORCES, STATES)), -corner * np.eye(FORCES)]])
        command = np.vstack([np.zeros((STATES, FORCES)), corner * np.eye(FORCES)])
        inputs = np.hstack([command, np.vstack([model.E, np.zeros((FORCES, DISTURBANCES))])])
    over_step, held = hold(A, inputs, step)
    return Plant(A=over_step, B=held[:, :FORCES], E=held[:, FORCES:])
