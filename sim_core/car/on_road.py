"""Which kind of car a vehicle is on its road."""

from sim_core.arrays import FloatArray
from sim_core.car.driven_car import DrivenCar, Estimator
from sim_core.car.half_car import DISTURBANCES
from sim_core.car.linear import LinearCar
from sim_core.car.nonlinear import NonlinearCar
from sim_core.car.plant import plant
from sim_core.scenario import Actuator, Vehicle


def on_road(
    vehicle: Vehicle,
    actuator: Actuator,
    step: float,
    disturbance: FloatArray,
    before: int,
    *,
    estimator: Estimator | None = None,
    clipped: bool = False,
) -> DrivenCar:
    """A car on its road.

    Args:
        vehicle: The real one.
        actuator: Its actuators.
        step: Control step [s].
        disturbance: In each control step, fine step after fine step (steps, 3 · fine), as `RoadInput.disturbance`.
        before: Control steps before those on record.
        estimator: Between car and controller; None where that has the state itself.
        clipped: Whether the law's limits shape the force in most steps, so that blocks of free steps gain nothing.
    """
    if vehicle.linear and not clipped:
        matrices = plant(vehicle, actuator, step, disturbance.shape[1] // DISTURBANCES)
        return LinearCar(matrices, vehicle, disturbance, before, estimator)
    return NonlinearCar(vehicle, actuator, step, disturbance, before, estimator)
