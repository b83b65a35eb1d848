"""A vehicle on its road."""

import numpy as np

from sim_core.arrays import FloatArray
from sim_core.kernel.prepared import DrivenCar
from sim_core.kernel.record import Recorder
from sim_core.scenario import Actuator, Vehicle
from sim_core.vehicle.half_car import FORCES, STATES
from sim_core.vehicle.model import Estimator, SemiActiveDampers
from sim_core.vehicle.nonlinear import substeps, to_c_struct
from sim_core.vehicle.plant import transition_matrix


def make_vehicle(
    vehicle: Vehicle,
    actuator: Actuator,
    fine_step: float,
    fine: int,
    height: FloatArray,
    braking: FloatArray,
    *,
    above_chord: FloatArray | None = None,
    estimator: Estimator | None = None,
    dampers: SemiActiveDampers | None = None,
    recorder: Recorder | None = None,
) -> DrivenCar:
    """Return a car on its road.

    Args:
        vehicle: The real one.
        actuator: Its actuators.
        fine_step: Fine step [s].
        fine: Fine steps in each of its steps.
        height: Of the road under both axles at the ends of all fine steps (2, n + 1) [m].
        braking: Deceleration in each fine step (n,) [m/s^2].
        above_chord: How far the road lies above its chord, as `DrivenCar` has it.
        estimator: Between car and controller; None where that has the state itself.
        dampers: Its dampers where they are semi-active; None where actuators act beside passive ones.
        recorder: What measures its drive; None for nothing.
    """
    linear = is_linear(vehicle, dampers)
    return DrivenCar(
        vehicle=to_c_struct(vehicle, actuator, dampers),
        states=STATES if actuator.bandwidth is None else STATES + FORCES,
        effects=transition_matrix(vehicle, actuator, fine_step) if linear else None,
        steps=len(braking) // fine,
        fine=fine,
        estimator=None if estimator is None else _estimator_struct(estimator),
        estimator_input=np.empty((0, STATES)) if estimator is None else np.ascontiguousarray(estimator.input),
        height=height,
        braking=braking,
        above_chord=above_chord,
        substeps=1 if linear else substeps(vehicle, actuator, dampers, fine_step),
        fine_step=fine_step,
        recorder=recorder,
    )


def is_linear(vehicle: Vehicle, dampers: SemiActiveDampers | None) -> bool:
    """Check whether its steps are exact: no semi-active `dampers`; passive ones, stops and tyres that are linear."""
    return vehicle.linear and dampers is None


def _estimator_struct(estimator: Estimator) -> FloatArray:
    """Return `struct estimator` of kernel/car.c."""
    return np.concatenate([part.ravel() for part in (estimator.state, estimator.command, estimator.measurement)])
