"""The linear car on its road: its steps are exact.

See docs/decisions/0002-laws-are-followed-in-c.md.
"""

import numpy as np

from sim_core.arrays import FloatArray
from sim_core.kernel.prepared import linear_car
from sim_core.scenario import Vehicle
from sim_core.vehicle.half_car import STATES, measurement
from sim_core.vehicle.model import Estimator, VehicleModel
from sim_core.vehicle.plant import Plant


def control_step(plant: Plant, vehicle: Vehicle, estimator: Estimator | None) -> tuple[FloatArray, FloatArray]:
    """A (n, n) and B (n, 2) of p' = A p + B u + forcing over one control step, p as `VehicleModel` has it.

    Args:
        plant: Of the real car.
        vehicle: The real one.
        estimator: None where the controller has the state itself.
    """
    if estimator is None:
        return plant.A, plant.B
    C, D = _sensors(plant, vehicle)
    L, none = estimator.measurement, np.zeros((plant.size, STATES))
    A = np.block([[estimator.state, L @ C @ plant.A], [none, plant.A]])
    return A, np.vstack([estimator.command + L @ (C @ plant.B + D), plant.B])


def _sensors(plant: Plant, vehicle: Vehicle) -> tuple[FloatArray, FloatArray]:
    """What sensors give of the plant's state (4, n) and of the command before the instant (4, 2)."""
    sensors = measurement(vehicle)
    if plant.size == STATES:
        return sensors.C, sensors.D
    return np.hstack([sensors.C, sensors.D]), np.zeros_like(sensors.D)


class LinearCar(VehicleModel):
    """A linear car on its road; the arguments are `make_vehicle`'s."""

    def __init__(
        self, plant: Plant, vehicle: Vehicle, disturbance: FloatArray, before: int, estimator: Estimator | None
    ) -> None:
        self._plant = plant
        self._vehicle = vehicle
        self._disturbance = disturbance
        self._before = before
        A, B = control_step(plant, vehicle, estimator)
        self.size = len(A)
        forcing = disturbance @ plant.E
        if estimator is not None:
            measured = forcing @ _sensors(plant, vehicle)[0].T
            measured += np.outer(disturbance[:, -1], measurement(vehicle).F)
            forcing = np.hstack([measured @ estimator.measurement.T + estimator.input, forcing])
        self._driven = linear_car(A, B, forcing)

    def measure(self, step: int, state: FloatArray, command: FloatArray) -> FloatArray:
        """As VehicleModel says."""
        C, D = _sensors(self._plant, self._vehicle)
        braking = self._disturbance[max(step - 1, 0), -1]
        return np.asarray(C @ state[-self._plant.size :] + D @ command + measurement(self._vehicle).F * braking)

    def record(self, states: FloatArray, commands: FloatArray) -> FloatArray:
        """As VehicleModel says."""
        return self._plant.record(states[:, -self._plant.size :], commands, self._disturbance[self._before :])
