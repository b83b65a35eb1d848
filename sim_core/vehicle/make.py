"""What the C of kernel/car.c is told of a car: its numbers, and how finely it is stepped where it is not linear.

F_i = k_i d + c_i(ḋ) ḋ + stop_i(d) - u_i - link_i a, a being the braking, and load_i = max(-k_t,i (z_w - z_r), -static
load_i). The slope of each of these changes where a damper turns, a stop is met or a tyre lifts off: a step
(Runge-Kutta, fourth order) ends there. A semi-active damper's force is the nearest to c_i(ḋ) ḋ - u_i that lies between
`least` ḋ and `most` ḋ.
tests/validation/test_nonlinear.py holds metrics to an adaptive solver's and to those of much finer steps.
"""

from functools import lru_cache
from itertools import chain
from math import ceil, inf, pi

import numpy as np

from sim_core.arrays import FloatArray
from sim_core.caching import small_cached
from sim_core.kernel.prepared import DrivenCar
from sim_core.kernel.record import Recorder
from sim_core.scenario import Actuator, Vehicle
from sim_core.scenario.damper import MOST_POINTS, hardest, with_origin
from sim_core.vehicle.half_car import FORCES, STATES, deflection_speeds, half_car
from sim_core.vehicle.model import Estimator, SemiActiveDampers
from sim_core.vehicle.plant import transition_matrix

_LONGEST_ANGLE = 0.045  # of the fastest pole in a step of Runge-Kutta [rad]; 0.09 misses test_nonlinear_loops by far
# Of a semi-active damper that no limit is given for: it does not stop a wheel faster [s]. Without this its coefficient
# would be infinite whenever travel turns, and a lagging actuator would keep it so.
_SHORTEST_STOP = 1e-3
# One step of Runge-Kutta with semi-active dampers, whose force has corners at which no step ends: at most so long [s],
# and at most so large an exponent of the decay that the hardest damper causes.
_LONGEST_STEP, _LARGEST_DECAY = 2.5e-4, 1.0


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
    linear, numbers, given = is_linear(vehicle, dampers), None, np.empty((0, STATES))
    if estimator is not None:
        numbers = np.concatenate([each.ravel() for each in (estimator.state, estimator.command, estimator.measurement)])
        given = np.ascontiguousarray(estimator.input)
    return DrivenCar(
        vehicle=to_c_struct(vehicle, actuator, dampers),
        states=STATES if actuator.bandwidth is None else STATES + FORCES,
        effects=transition_matrix(vehicle, actuator, fine_step) if linear else None,
        steps=len(braking) // fine,
        fine=fine,
        estimator=numbers,
        estimator_input=given,
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


def substeps(vehicle: Vehicle, actuator: Actuator, dampers: SemiActiveDampers | None, fine_step: float) -> int:
    """Return how many steps of Runge-Kutta a fine step [s] takes; `dampers` are those that are semi-active."""
    steps = ceil(fine_step * max(_fastest(vehicle), _corner(actuator)) / _LONGEST_ANGLE)
    if dampers is None:
        return steps
    mobility = np.diag(deflection_speeds(vehicle) @ half_car(vehicle).B)  # of both axles [1/kg]
    decay = float((_hardest(vehicle, dampers) * mobility).max())
    return max(steps, ceil(fine_step / _LONGEST_STEP), ceil(fine_step * decay / _LARGEST_DECAY))


def _hardest(vehicle: Vehicle, dampers: SemiActiveDampers) -> FloatArray:
    """Return the greatest damping of semi-active dampers, front and rear [N s/m]."""
    if dampers.most < inf:
        return np.full(2, dampers.most)
    wheels = np.array([vehicle.front_wheel_mass, vehicle.rear_wheel_mass])
    passive: FloatArray = np.array(_steepest(vehicle))
    return np.maximum(np.maximum(wheels / _SHORTEST_STOP, passive), dampers.least)


def _steepest(vehicle: Vehicle) -> tuple[float, float]:
    """Return the greatest slope of both passive dampers' force over velocity, front and rear [N s/m]."""
    if vehicle.damper_curves is None:
        hard = max(vehicle.damping_factors)
        return vehicle.front_damping * hard, vehicle.rear_damping * hard
    front, rear = map(hardest, vehicle.damper_curves)
    return front, rear


def _corner(actuator: Actuator) -> float:
    """Return the corner of their lag [rad/s], 0 without one."""
    return 2 * pi * (actuator.bandwidth or 0.0)


@small_cached(128)
def to_c_struct(vehicle: Vehicle, actuator: Actuator, dampers: SemiActiveDampers | None) -> FloatArray:
    """Return `struct vehicle` of kernel/car.c."""
    semi_active = dampers or SemiActiveDampers(least=0.0, most=0.0, most_force=0.0)
    compression, rebound = vehicle.damping_factors
    damping = np.array([vehicle.front_damping, vehicle.rear_damping])
    down, up = vehicle.stop_clearances
    front_and_rear = {
        "body_share": (1 / vehicle.body_mass, 1 / vehicle.body_mass),
        "pitch_share": (-vehicle.cg_to_front / vehicle.pitch_inertia, vehicle.cg_to_rear / vehicle.pitch_inertia),
        "arm": (-vehicle.cg_to_front, vehicle.cg_to_rear),
        "per_wheel_mass": (1 / vehicle.front_wheel_mass, 1 / vehicle.rear_wheel_mass),
        "spring": (vehicle.front_spring, vehicle.rear_spring),
        "rebound": tuple(rebound * damping),
        "compression": tuple(compression * damping),
        "clearance_down": down,
        "clearance_up": up,
        "stop": (vehicle.bump_stop_stiffness, vehicle.bump_stop_stiffness),
        "tyre": (vehicle.front_tyre_stiffness, vehicle.rear_tyre_stiffness),
        "lift_off": tuple(-load if vehicle.tyre_lift_off else -inf for load in vehicle.static_loads),
        "link": vehicle.link_forces,
        "least_damping": (semi_active.least, semi_active.least),
        "most_damping": tuple(_hardest(vehicle, semi_active)),
    }
    brake_moment = vehicle.body_mass * vehicle.cg_height / vehicle.pitch_inertia
    asymmetric = dampers is not None or not (vehicle.rebound_ratio == 1 and vehicle.damper_curves is None)
    single = brake_moment, _corner(actuator), float(asymmetric), float(dampers is not None), semi_active.most_force
    return np.array([*single, *chain.from_iterable(front_and_rear.values()), *curves(vehicle)])


def curves(vehicle: Vehicle) -> FloatArray:
    """Return how many points both dampers' curves have, their velocities and their forces; 0 without curves."""
    numbers = np.zeros((2, 1 + 2 * (MOST_POINTS + 1)))
    for row, points in zip(numbers, vehicle.damper_curves or (), strict=False):
        whole = np.array(with_origin(points))
        row[0] = len(whole)
        row[1:].reshape(2, -1)[:, : len(whole)] = whole.T
    return numbers.ravel()


@lru_cache(maxsize=128)
def _fastest(vehicle: Vehicle) -> float:
    """Return the magnitude of the fastest pole that any of its linear cars has [rad/s]: dampers hard, stops met."""
    front, rear = _steepest(vehicle)
    stop = 0.0 if vehicle.bump_stop_clearance is None else vehicle.bump_stop_stiffness
    stiffest = vehicle.model_copy(
        update={
            "front_spring": vehicle.front_spring + stop,
            "rear_spring": vehicle.rear_spring + stop,
            "front_damping": front,
            "rear_damping": rear,
        }
    )
    return float(np.abs(np.linalg.eigvals(half_car(stiffest).A)).max())
