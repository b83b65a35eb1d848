"""The linear car on its road: its steps are exact.

See docs/decisions/0002-laws-are-followed-in-c.md.
"""

from dataclasses import dataclass

import numpy as np

from sim_core.arrays import FloatArray
from sim_core.caching import cached
from sim_core.kernel.prepared import FollowLaw, LawArrays, linear_car
from sim_core.scenario import Vehicle
from sim_core.vehicle.half_car import FORCES, STATES, measurement
from sim_core.vehicle.model import Estimator, LinearLaw, VehicleModel
from sim_core.vehicle.plant import Plant


@dataclass(frozen=True, slots=True, eq=False, kw_only=True)
class ControlStep:
    """p' = A p + B u + forcing over one control step, p as `VehicleModel` has it: A (n, n), B (n, 2)."""

    A: FloatArray
    B: FloatArray


@cached
def _exact(plant: Plant) -> ControlStep:
    """Without an estimator; shared, and with it what is prepared for a law."""
    return ControlStep(A=np.ascontiguousarray(plant.A), B=np.ascontiguousarray(plant.B))


def control_step(plant: Plant, vehicle: Vehicle, estimator: Estimator | None) -> ControlStep:
    """A control step of a linear car and its estimator.

    Args:
        plant: Of the real car.
        vehicle: The real one.
        estimator: None where the controller has the state itself.
    """
    if estimator is None:
        return _exact(plant)
    C, D = _sensors(plant, vehicle)
    L, none = estimator.measurement, np.zeros((plant.size, STATES))
    return ControlStep(
        A=np.block([[estimator.state, L @ C @ plant.A], [none, plant.A]]),
        B=np.vstack([estimator.command + L @ (C @ plant.B + D), plant.B]),
    )


def _sensors(plant: Plant, vehicle: Vehicle) -> tuple[FloatArray, FloatArray]:
    """What sensors give of the plant's state (4, n) and of the command before the instant (4, 2)."""
    sensors = measurement(vehicle)
    if plant.size == STATES:
        return sensors.C, sensors.D
    return np.hstack([sensors.C, sensors.D]), np.zeros_like(sensors.D)


@cached
def closed_loop_matrix(step: ControlStep, law: LinearLaw) -> FloatArray:
    """One control step of [p; previous command] while no limit binds (n + 2, n + 2)."""
    n = len(step.A)
    gain = np.zeros((FORCES, n + FORCES))
    gain[:, :STATES], gain[:, n:] = law.gain[:, :STATES], law.gain[:, STATES:]
    free = np.hstack([step.A, np.zeros((n, FORCES))])
    return np.vstack([free + step.B @ gain, gain])


class LinearCar(VehicleModel):
    """A linear car on its road; the arguments are `make_vehicle`'s."""

    def __init__(
        self, plant: Plant, vehicle: Vehicle, disturbance: FloatArray, before: int, estimator: Estimator | None
    ) -> None:
        self._plant = plant
        self._vehicle = vehicle
        self._disturbance = disturbance
        self._before = before
        step = control_step(plant, vehicle, estimator)
        self.size = len(step.A)
        forcing = disturbance @ plant.E
        if estimator is not None:
            measured = forcing @ _sensors(plant, vehicle)[0].T
            measured += np.outer(disturbance[:, -1], measurement(vehicle).F)
            forcing = np.hstack([measured @ estimator.measurement.T + estimator.input, forcing])
        self._driven = linear_car(step.A, step.B, forcing)

    def follow_law(self, law: LawArrays, loop: FloatArray) -> FollowLaw:
        """As VehicleModel says."""
        return self._driven.follow_law(law, loop)

    def advance(self, step: int, loop: FloatArray) -> None:
        """As VehicleModel says."""
        self._driven.advance(step, loop)

    def measure(self, step: int, state: FloatArray, command: FloatArray) -> FloatArray:
        """As VehicleModel says."""
        C, D = _sensors(self._plant, self._vehicle)
        braking = self._disturbance[max(step - 1, 0), -1]
        return np.asarray(C @ state[-self._plant.size :] + D @ command + measurement(self._vehicle).F * braking)

    def record(self, states: FloatArray, commands: FloatArray) -> FloatArray:
        """As VehicleModel says."""
        return self._plant.record(states[:, -self._plant.size :], commands, self._disturbance[self._before :])
