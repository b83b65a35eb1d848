"""Half-car in absolute coordinates, from Newton's second law; sim_core uses deflection coordinates.

q = (z_b, θ, z_w1, z_w2), all relative to the static equilibrium; x forward, z up, θ nose-down.
M q̈ + C q̇ + K q = T z_r + B u + D a_brake. Every number of a run follows from these five matrices.
"""

from collections.abc import Callable
from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from sim_core.scenario import Scenario, Vehicle

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
    """ẋ = A x + B u + E z_r + D a, y = C x + F u + G z_r + H a; x = (q, q̇), u = (u_1, u_2), z_r = (z_r1, z_r2)."""

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
    to_deflection = lever - wheel  # suspension deflections d = to_deflection @ q
    mass = np.diag([car.body_mass, car.pitch_inertia, car.front_wheel_mass, car.rear_wheel_mass])
    spring = np.diag([car.front_spring, car.rear_spring])
    damper = np.diag([car.front_damping, car.rear_damping])
    tyre = np.diag([car.front_tyre_stiffness, car.rear_tyre_stiffness])
    # Energy: V = ½ d' k d + ½ (z_r − z_w)' k_t (z_r − z_w); the actuator pushes body and wheel apart.
    K = to_deflection.T @ spring @ to_deflection + wheel.T @ tyre @ wheel
    C = to_deflection.T @ damper @ to_deflection
    inverse = np.linalg.inv(mass)
    brake = np.array([0, car.body_mass * car.cg_height, 0, 0])  # inertia force at the c.g. presses the nose down
    # Links at the angle β between body and wheel turn the braking force F into F tan β, upwards at the front, downwards
    # at the rear (Gillespie 1992, chapter 7), tan β being their number times h / L.
    for axle, share, number in (
        (0, car.front_brake_share, car.anti_dive),
        (1, car.front_brake_share - 1, car.anti_lift),
    ):
        slope = number * car.cg_height / (car.cg_to_front + car.cg_to_rear)
        brake = brake + to_deflection[axle] * share * car.body_mass * slope
    zero, one = np.zeros((4, 4)), np.eye(4)
    A = np.block([[zero, one], [-inverse @ K, -inverse @ C]])
    B = np.vstack([np.zeros((4, 2)), inverse @ to_deflection.T])
    E = np.vstack([np.zeros((4, 2)), inverse @ wheel.T @ tyre])
    D = np.concatenate([np.zeros(4), inverse @ brake])
    body = slice(4, 6)
    C_out = np.vstack(
        [A[body], np.hstack([-tyre @ wheel, np.zeros((2, 4))]), np.hstack([to_deflection, np.zeros((2, 4))])]
    )
    F_out = np.vstack([B[body], np.zeros((4, 2))])
    G_out = np.vstack([E[body], tyre, np.zeros((2, 2))])
    H_out = np.concatenate([D[body], np.zeros(4)])
    return StateSpace(A=A, B=B, E=E, D=D, C=C_out, F=F_out, G=G_out, H=H_out)


def behind(scenario: Scenario) -> float:
    """Return after which distance the rear wheel meets what the front one has met [m]."""
    car = scenario.vehicle
    return {"in_turn": car.cg_to_front + car.cg_to_rear, "together": 0.0}[scenario.road.rear_axle]


def road_response(model: StateSpace, frequency: Array, delay: float) -> Array:
    """Complex response (n, 6) of OUTPUTS to a unit front road at `frequency` [Hz], met by the rear `delay` [s] late."""
    both = axle_responses(model, frequency)
    late: Array = both[..., 1] * np.exp(-2j * np.pi * np.asarray(frequency) * delay)[:, None]
    return both[..., 0] + late


def axle_responses(model: StateSpace, frequency: Array) -> Array:
    """Complex response (n, 6, 2) of OUTPUTS to a unit road height under the front and under the rear wheel."""
    omega = 2 * np.pi * np.asarray(frequency)
    return model.C @ np.linalg.solve(1j * omega[:, None, None] * np.eye(8) - model.A, model.E) + model.G


def stationary_rms(car: Vehicle, speed: float, distance: float | None = None) -> Array:
    """RMS of OUTPUTS on a stationary ISO 8608 road of class B, integrating |H|² G over frequency.

    The rear wheel meets what the front one has met after a `distance` [m], by default the car's own between its axles.

    One-sided displacement PSD in space n0² Gd / (n² + n00²), per hertz divided by the speed. Gauss-Legendre in
    panels of 0.01 and 0.15 Hz over the body's and wheels' resonances, then of half a period of the two axles'
    interference; last, in even steps of log f, at least 40 periods each, that averages out: the axles' powers add.
    Without a distance there is no interference, and the responses add instead.
    """
    points, share = np.polynomial.legendre.leggauss(4)

    def integrate(edges: Array, power: Callable[[Array], Array]) -> Array:
        width = np.diff(edges)[:, None]
        frequency = (edges[:-1, None] + width * (points + 1) / 2).ravel()
        n = frequency / speed
        height = 0.1**2 * 64e-6 / (n**2 + 0.011**2) / speed
        return ((width * share / 2).ravel() * height) @ power(frequency)

    model, delay = state_space(car), (car.cg_to_front + car.cg_to_rear if distance is None else distance) / speed
    far, step = (max(200, 300 / delay), min(0.5 / delay, 5)) if delay else (200, 5)
    fine = np.concatenate([np.linspace(0, 5, 500)[:-1], np.linspace(5, 50, 300)[:-1], np.arange(50, far, step), [far]])

    def far_off(f: Array) -> Array:
        both = axle_responses(model, f)
        powers: Array = (np.abs(both) ** 2).sum(axis=-1) if delay else np.abs(both.sum(axis=-1)) ** 2
        return powers

    low = integrate(fine, lambda f: np.abs(road_response(model, f, delay)) ** 2)
    high = integrate(far * np.exp(np.linspace(0, np.log(1e6), 81)), far_off)
    return np.sqrt(low + high)
