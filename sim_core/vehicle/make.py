"""Which kind of car a vehicle is on its road."""

from sim_core.arrays import FloatArray
from sim_core.road.profile import RoadUnderAxles
from sim_core.scenario import Actuator, Vehicle
from sim_core.vehicle.half_car import DISTURBANCES
from sim_core.vehicle.linear import LinearCar
from sim_core.vehicle.model import Estimator, SemiActiveDampers, VehicleModel
from sim_core.vehicle.nonlinear import NonlinearCar
from sim_core.vehicle.plant import plant


def make_vehicle(
    vehicle: Vehicle,
    actuator: Actuator,
    step: float,
    disturbance: FloatArray,
    before: int,
    *,
    estimator: Estimator | None = None,
    dampers: SemiActiveDampers | None = None,
    road: RoadUnderAxles | None = None,
) -> VehicleModel:
    """A car on its road.

    Args:
        vehicle: The real one.
        actuator: Its actuators.
        step: Control step [s].
        disturbance: In each control step, fine step after fine step (steps, 3 · fine), as `Excitation.disturbance`.
        before: Control steps before those on record.
        estimator: Between car and controller; None where that has the state itself.
        dampers: Its dampers where they are semi-active; None where actuators act beside passive ones.
        road: The road itself within each fine step, to which a nonlinear car's stops, tyres and limits are sensitive;
            None where it is straight there, as `disturbance` has it and a linear car takes it.
    """
    if is_linear(vehicle, dampers):
        matrices = plant(vehicle, actuator, step, disturbance.shape[1] // DISTURBANCES)
        return LinearCar(matrices, vehicle, disturbance, before, estimator)
    return NonlinearCar(vehicle, actuator, step, disturbance, before, estimator, dampers, road)


def is_linear(vehicle: Vehicle, dampers: SemiActiveDampers | None) -> bool:
    """Whether its steps are exact: passive dampers, stops and tyres that are linear, and no semi-active `dampers`."""
    return vehicle.linear and dampers is None
