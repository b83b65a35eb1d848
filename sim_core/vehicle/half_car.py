"""Half-car model in deflection coordinates (Eq. 7 with the braking moment added), and its exact stepping.

State (8): suspension deflections d1, d2 [m]; tyre deflections z_w - z_r, front and rear [m]; body velocity [m/s];
pitch rate, nose-down positive [rad/s]; wheel velocities, front and rear [m/s].
"""

from dataclasses import dataclass

import numpy as np

from sim_core.arrays import FloatArray
from sim_core.caching import small_cached
from sim_core.catalogue import METRIC_SIGNALS
from sim_core.matrices import exponential
from sim_core.scenario import Vehicle

STATES = 8
FORCES = 2
DISTURBANCES = 3  # road velocity front and rear [m/s], braking deceleration [m/s^2]
OUTPUTS = METRIC_SIGNALS[:6]  # both accelerations of the body, tyre loads, suspension deflections


@dataclass(frozen=True, slots=True, eq=False, kw_only=True)
class LinearModel:
    """x' = A x + B u + E w, y = C x + D u + F w; continuous, or one step of a discrete one (then without y).

    Shapes: A (8, 8), B (8, 2), E (8, 3), C (6, 8), D (6, 2), F (6, 3). u [N], w = DISTURBANCES, y = OUTPUTS.
    """

    A: FloatArray
    B: FloatArray
    E: FloatArray
    C: FloatArray
    D: FloatArray
    F: FloatArray


def _arms(vehicle: Vehicle) -> FloatArray:
    """Return the arms of both axles about the centre of gravity [m]: ż_bi = ż_b + arm_i θ̇."""
    return np.array([-vehicle.cg_to_front, vehicle.cg_to_rear])


def deflection_speeds(vehicle: Vehicle) -> FloatArray:
    """Return the rates of both suspension deflections [m/s] as rows on the state (2, 8)."""
    eye = np.eye(2)
    return np.hstack([np.zeros((2, 4)), np.ones((2, 1)), _arms(vehicle)[:, None], -eye])


@small_cached(128)
def half_car(vehicle: Vehicle) -> LinearModel:
    """The continuous model of a vehicle (Eq. 7; wheel, body and pitch equations in docs/explanation/half-car.md)."""
    m, inertia = vehicle.body_mass, vehicle.pitch_inertia
    arm = _arms(vehicle)
    wheel_mass = np.array([vehicle.front_wheel_mass, vehicle.rear_wheel_mass])
    tyre = np.array([vehicle.front_tyre_stiffness, vehicle.rear_tyre_stiffness])
    eye = np.eye(2)

    deflection_speed = deflection_speeds(vehicle)
    force_x = np.diag([vehicle.front_spring, vehicle.rear_spring]) @ np.eye(2, STATES)
    force_x = force_x + np.diag([vehicle.front_damping, vehicle.rear_damping]) @ deflection_speed  # F_i = k d + c ḋ - u
    tyre_load = np.hstack([np.zeros((2, 2)), -np.diag(tyre), np.zeros((2, 4))])

    body_x, body_u = -force_x.sum(axis=0) / m, np.full(2, 1 / m)
    pitch_x, pitch_u = -(arm @ force_x) / inertia, arm / inertia
    wheel_x, wheel_u = (tyre_load + force_x) / wheel_mass[:, None], -eye / wheel_mass[:, None]
    brake_moment = m * vehicle.cg_height / inertia

    wheel_speed = np.hstack([np.zeros((2, 6)), eye])
    A = np.vstack([deflection_speed, wheel_speed, body_x, pitch_x, wheel_x])
    B = np.vstack([np.zeros((4, 2)), body_u, pitch_u, wheel_u])
    E = np.zeros((STATES, DISTURBANCES))
    E[2, 0] = E[3, 1] = -1.0
    E[5, 2] = brake_moment
    E[:, 2] += B @ vehicle.link_forces
    C = np.vstack([body_x, pitch_x, tyre_load, np.eye(2, STATES)])
    D = np.vstack([body_u, pitch_u, np.zeros((4, 2))])
    F = np.zeros((len(OUTPUTS), DISTURBANCES))
    F[1, 2] = brake_moment
    F[:, 2] += D @ vehicle.link_forces
    return LinearModel(A=A, B=B, E=E, C=C, D=D, F=F)


MEASURED_OUTPUTS = ("front_deflection", "rear_deflection", "body_acceleration", "pitch_rate")


@dataclass(frozen=True, slots=True, eq=False, kw_only=True)
class Measurement:
    """y = C x + D u + F a of MEASURED_OUTPUTS: C (4, 8), D (4, 2), F (4,); u the forces [N], a the braking [m/s^2]."""

    C: FloatArray
    D: FloatArray
    F: FloatArray


@small_cached(128)
def measurement(vehicle: Vehicle) -> Measurement:
    """Return what a car's own sensors give."""
    model = half_car(vehicle)
    rows, pitch_rate = [OUTPUTS.index(name) for name in MEASURED_OUTPUTS[:3]], np.eye(1, STATES, k=5)
    return Measurement(
        C=np.vstack([model.C[rows], pitch_rate]),
        D=np.vstack([model.D[rows], np.zeros((1, FORCES))]),
        F=np.append(model.F[rows, 2], 0.0),
    )


def zero_order_hold(A: FloatArray, inputs: FloatArray, step: float) -> tuple[FloatArray, FloatArray]:
    """Exact step of x' = A x + inputs·v with v held: (Φ, Γ) by the matrix exponential (Van Loan 1978).

    A held road *velocity* is a road height that is linear within the step, so no height is ever held.
    """
    n, m = inputs.shape
    block = np.zeros((n + m, n + m))
    block[:n, :n], block[:n, n:] = A, inputs
    over_step = exponential(block * step)
    return over_step[:n, :n], over_step[:n, n:]


@small_cached(128)
def discrete(vehicle: Vehicle, step: float) -> LinearModel:
    """Return the model over one step [s] with force, road velocities and deceleration held; exact."""
    model = half_car(vehicle)
    A, inputs = zero_order_hold(model.A, np.hstack([model.B, model.E]), step)
    return LinearModel(A=A, B=inputs[:, :FORCES], E=inputs[:, FORCES:], C=model.C, D=model.D, F=model.F)
