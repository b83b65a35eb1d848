"""The linear car with its actuators, stepped exactly."""

from dataclasses import dataclass
from math import pi

import numpy as np

from sim_core.arrays import FloatArray
from sim_core.caching import cached, small_cached
from sim_core.kernel.prepared import CAUSES, NUMBERS
from sim_core.scenario import Actuator, Vehicle
from sim_core.vehicle.half_car import DISTURBANCES, FORCES, STATES, half_car, zero_order_hold


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


def continuous_plant(vehicle: Vehicle, actuator: Actuator) -> Plant:
    """Return the plant in continuous time: ṗ = A p + B u + E w."""
    model = half_car(vehicle)
    if actuator.bandwidth is None:
        return Plant(A=model.A, B=model.B, E=model.E)
    corner = 2 * pi * actuator.bandwidth  # u̇ = 2π f (command - u): the forces become states, the command drives them
    return Plant(
        A=np.block([[model.A, model.B], [np.zeros((FORCES, STATES)), -corner * np.eye(FORCES)]]),
        B=np.vstack([np.zeros((STATES, FORCES)), corner * np.eye(FORCES)]),
        E=np.vstack([model.E, np.zeros((FORCES, DISTURBANCES))]),
    )


@cached
def discretised_plant(vehicle: Vehicle, actuator: Actuator, step: float) -> Plant:
    """Return the plant over a step [s]."""
    model = continuous_plant(vehicle, actuator)
    over_step, held = zero_order_hold(model.A, np.hstack([model.B, model.E]), step)
    return Plant(A=over_step, B=held[:, :FORCES], E=held[:, FORCES:])


@small_cached(128)
def transition_matrix(vehicle: Vehicle, actuator: Actuator, step: float) -> FloatArray:
    """Return what each cause alone makes of rest in a step [s] (15, 10), as kernel/car.c has it.

    Causes are both road velocities, braking, the state with the forces, and both commands, which are the forces where
    actuators do not lag.
    """
    exact = discretised_plant(vehicle, actuator, step)
    n, own = exact.size, np.zeros((CAUSES, NUMBERS))
    own[:DISTURBANCES, :n] = exact.E.T
    states, commands = own[DISTURBANCES : DISTURBANCES + NUMBERS], own[-FORCES:]
    states[:n, :n] = exact.A.T
    if n == STATES:
        states[n:, :n], states[n:, n:] = exact.B.T, np.eye(FORCES)
    else:
        commands[:] = exact.B.T
    return own
