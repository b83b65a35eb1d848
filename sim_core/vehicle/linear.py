"""The linear car: its steps are exact."""

from functools import lru_cache

import numpy as np

from sim_core.arrays import FloatArray
from sim_core.kernel.prepared import CAUSES, NUMBERS
from sim_core.scenario import Actuator, Vehicle
from sim_core.vehicle.half_car import DISTURBANCES, FORCES, STATES
from sim_core.vehicle.plant import plant


@lru_cache(maxsize=128)
def effects(vehicle: Vehicle, actuator: Actuator, step: float) -> FloatArray:
    """What each cause alone makes of the state in a step [s] (20, 10), as `struct linear_step` of kernel/car.c has it.

    Causes are both road velocities, braking, the state with the forces, five that a straight road and a linear car do
    not have, and both commands, which are the forces where actuators do not lag.
    """
    exact = plant(vehicle, actuator, step)
    n, own = exact.size, np.zeros((CAUSES, NUMBERS))
    own[:DISTURBANCES, :n] = exact.E.T
    states, commands = own[DISTURBANCES : DISTURBANCES + NUMBERS], own[-FORCES:]
    states[:n, :n] = exact.A.T
    if n == STATES:
        states[n:, :n], states[n:, n:] = exact.B.T, np.eye(FORCES)
    else:
        commands[:] = exact.B.T
    return own
