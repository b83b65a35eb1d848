"""The linear car: its steps are exact."""

from functools import lru_cache

import numpy as np

from sim_core.arrays import FloatArray
from sim_core.kernel.prepared import CAUSES, NUMBERS
from sim_core.scenario import Actuator, Vehicle
from sim_core.vehicle.half_car import DISTURBANCES, FORCES, STATES, measurement
from sim_core.vehicle.model import Estimator
from sim_core.vehicle.plant import Plant, plant


def control_step(plant: Plant, vehicle: Vehicle, estimator: Estimator | None) -> tuple[FloatArray, FloatArray]:
    """A (n, n) and B (n, 2) of p' = A p + B u + forcing over one control step; p as `DrivenCar` has it.

    Args:
        plant: Of the real car.
        vehicle: The real one.
        estimator: None where the controller has the state itself.
    """
    if estimator is None:
        return plant.A, plant.B
    sensors = measurement(vehicle)
    C, D = sensors.C, sensors.D
    if plant.size > STATES:
        C, D = np.hstack([C, D]), np.zeros_like(D)
    L, none = estimator.measurement, np.zeros((plant.size, STATES))
    A = np.block([[estimator.state, L @ C @ plant.A], [none, plant.A]])
    return A, np.vstack([estimator.command + L @ (C @ plant.B + D), plant.B])


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
