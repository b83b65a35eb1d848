"""A vehicle on its road."""

import numpy as np

from sim_core.arrays import FloatArray
from sim_core.kernel.prepared import DrivenCar
from sim_core.kernel.record import Recorder
from sim_core.road.profile import RoadUnderAxles
from sim_core.scenario import Actuator, Vehicle
from sim_core.vehicle.half_car import DISTURBANCES, FORCES, STATES
from sim_core.vehicle.linear import fine_step
from sim_core.vehicle.model import Estimator, SemiActiveDampers
from sim_core.vehicle.nonlinear import numbers, substeps


def make_vehicle(
    vehicle: Vehicle,
    actuator: Actuator,
    step: float,
    disturbance: FloatArray,
    *,
    estimator: Estimator | None = None,
    dampers: SemiActiveDampers | None = None,
    road: RoadUnderAxles | None = None,
    recorder: Recorder | None = None,
) -> DrivenCar:
    """A car on its road.

    Args:
        vehicle: The real one.
        actuator: Its actuators.
        step: Control step [s].
        disturbance: In each control step, fine step after fine step (steps, 3 · fine), as `Excitation.disturbance`.
        estimator: Between car and controller; None where that has the state itself.
        dampers: Its dampers where they are semi-active; None where actuators act beside passive ones.
        road: The road itself within each fine step, to which a nonlinear car's stops, tyres and limits are sensitive;
            None where it is straight there, as `disturbance` has it and a linear car takes it.
        recorder: What measures its drive; None for nothing.
    """
    linear, h = is_linear(vehicle, dampers), step * DISTURBANCES / disturbance.shape[1]
    matrices = estimator and [estimator.state, estimator.command, estimator.measurement]
    return DrivenCar(
        vehicle=numbers(vehicle, actuator, dampers),
        states=STATES if actuator.bandwidth is None else STATES + FORCES,
        effects=fine_step(vehicle, actuator, h) if linear else None,
        estimator=matrices and np.concatenate([matrix.ravel() for matrix in matrices]),
        estimator_input=np.empty((0, STATES)) if estimator is None else np.ascontiguousarray(estimator.input),
        road=road and (road.surface.roughness, road.surface.layout, road.position, road.within),
        disturbance=np.ascontiguousarray(disturbance, dtype=np.float64),
        substeps=1 if linear else substeps(vehicle, actuator, dampers, h),
        fine_step=h,
        recorder=recorder,
    )


def is_linear(vehicle: Vehicle, dampers: SemiActiveDampers | None) -> bool:
    """Whether its steps are exact: passive dampers, stops and tyres that are linear, and no semi-active `dampers`."""
    return vehicle.linear and dampers is None
