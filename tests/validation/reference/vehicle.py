"""Half-car in absolute coordinates, from Newton's second law; sim_core uses deflection coordinates.

q = (z_b, θ, z_w1, z_w2), all relative to the static equilibrium; x forward, z up, θ nose-down.
M q̈ + C q̇ + K q = T z_r + B u + D a_brake. Every number of a run follows from these five matrices.
"""

from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray
from scipy.integrate import quad_vec

from sim_core.scenario import Vehicle

Array = NDArray[np.float64]

# Rows of `outputs`, in the order sim_core names them.
OUTPUTS = (
    "body_acceleration",
    "pitch_acceleration",
    "front_tyre_load",
    "rear_tyre_load",
    "front_deflection",
    "rear_deflection",
)


@dataclass(frozen=True)
class StateSpace:
    """ẋ = A x + B u + E z_r + D a, y = C x + F u + G z_r + H a with x = (q, q̇), inputs (u_1, u_2), road (z_r1, z_r2)."""

    A: Array
    B: Array
    E: Array
    D: Array
    C: Array
    F: Array
    G: Array
    H: Array


def state_space(car: Vehicle) -> StateSpace:
    """The half-car's matrices, written from springs and dampers between named points."""
    lever = np.array([[1, -car.cg_to_front, 0, 0], [1, car.cg_to_rear, 0, 0]])  # body points above the axles
    wheel = np.array([[0, 0, 1, 0], [0, 0, 0, 1]])
    stretch = lever - wheel  # suspension deflections d = stretch @ q
    mass = np.diag([car.body_mass, car.pitch_inertia, car.front_wheel_mass, car.rear_wheel_mass])
    spring = np.diag([car.front_spring, car.rear_spring])
    damper = np.diag([car.front_damping, car.rear_damping])
    tyre = np.diag([car.front_tyre_stiffness, car.rear_tyre_stiffness])
    # Energy: V = ½ d' k d + ½ (z_r − z_w)' k_t (z_r − z_w); the actuator pushes body and wheel apart.
    K = stretch.T @ spring @ stretch + wheel.T @ tyre @ wheel
    C = stretch.T @ damper @ stretch
    inverse = np.linalg.inv(mass)
    brake = np.array([0, car.body_mass * car.cg_height, 0, 0])  # inertia force at the c.g. presses the nose down
    zero, one = np.zeros((4, 4)), np.eye(4)
    A = np.block([[zero, one], [-inverse @ K, -inverse @ C]])
    B = np.vstack([np.zeros((4, 2)), inverse @ stretch.T])
    E = np.vstack([np.zeros((4, 2)), inverse @ wheel.T @ tyre])
    D = np.concatenate([np.zeros(4), inverse @ brake])
    body = slice(4, 6)
    C_out = np.vstack([A[body], np.hstack([-tyre @ wheel, np.zeros((2, 4))]), np.hstack([stretch, np.zeros((2, 4))])])
    F_out = np.vstack([B[body], np.zeros((4, 2))])
    G_out = np.vstack([E[body], tyre, np.zeros((2, 2))])
    H_out = np.concatenate([D[body], np.zeros(4)])
    return StateSpace(A=A, B=B, E=E, D=D, C=C_out, F=F_out, G=G_out, H=H_out)


def road_response(model: StateSpace, omega: float, delay: float) -> Array:
    """Complex response of OUTPUTS to a unit front road height at `omega` [rad/s]; the rear comes `delay` [s] later."""
    road = np.array([1.0, np.exp(-1j * omega * delay)])
    state = np.linalg.solve(1j * omega * np.eye(8) - model.A, model.E @ road)
    return model.C @ state + model.G @ road


def stationary_rms(car: Vehicle, speed: float, roughness: float = 64e-6) -> Array:
    """RMS of OUTPUTS on a stationary ISO 8608 road, integrating |H|² G over frequency (adaptive, relative 1e-9).

    One-sided displacement PSD in space n0² Gd / (n² + n00²), per hertz divided by the speed.
    """
    model = state_space(car)
    delay = (car.cg_to_front + car.cg_to_rear) / speed

    def density(logarithm: float) -> Array:
        frequency = np.exp(logarithm)
        n = frequency / speed
        height = 0.1**2 * roughness / (n**2 + 0.011**2) / speed
        return np.abs(road_response(model, 2 * np.pi * frequency, delay)) ** 2 * height * frequency

    value, _ = quad_vec(density, np.log(1e-4), np.log(1e5), epsrel=1e-9, epsabs=0, limit=20_000, norm="max")
    return np.sqrt(value)
