"""A steady-state Kalman filter on what cars measure, between the car and its controller (Kalman 1960).

Measured at each control instant, just before the command changes: both suspension deflections, the body's acceleration
and the pitch rate. The road is white velocity noise to the filter, the braking is known from the speed plan.
"""

from dataclasses import dataclass
from math import pi, sqrt

import numpy as np
from scipy.linalg import expm

from sim_core.arrays import FloatArray
from sim_core.caching import cached
from sim_core.car.driven_car import Estimator
from sim_core.car.half_car import DISTURBANCES, STATES, discrete, half_car, measurement
from sim_core.car.road import REFERENCE_FREQUENCY
from sim_core.control.lqr import riccati, solve
from sim_core.errors import RidelabError
from sim_core.scenario import Estimation, Scenario, Vehicle

_NOISE_STREAM = 6  # a generator of its own beside the road's
_LEAST_ROUGHNESS = 1e-6  # on a smoother road the filter would ignore its sensors [m³]
_UNSTABLE = "No stable Kalman filter was found for this vehicle and these sensors"


@dataclass(frozen=True, slots=True, eq=False, kw_only=True)
class KalmanFilter:
    """x̂ = x̂⁻ + gain·(y - C x̂⁻ - D u): gain (8, 4), covariance (8, 8) of what x̂ is off by."""

    gain: FloatArray
    covariance: FloatArray


@cached
def kalman_filter(vehicle: Vehicle, noise: Estimation, step: float, intensity: float) -> KalmanFilter:
    """The filter that is optimal on an endless road.

    Args:
        vehicle: The one the controllers believe in.
        noise: Of the sensors.
        step: Between measurements [s].
        intensity: Of each axle's road velocity, two-sided [m²/s].

    Raises:
        RidelabError: There is no such filter.
    """
    A, C = discrete(vehicle, step).A, measurement(vehicle).C
    Q = _accumulated(vehicle, step, intensity)
    R = np.diag(np.square([noise.deflection_noise] * 2 + [noise.acceleration_noise, noise.pitch_rate_noise]))
    P = riccati(A.T, C.T, Q, R, np.zeros((STATES, len(C))))
    gain = solve(C @ P @ C.T + R, C @ P).T
    closed = A - gain @ C @ A
    if not np.isfinite(closed).all() or np.abs(np.linalg.eigvals(closed)).max() >= 1:
        raise RidelabError(_UNSTABLE, field="estimation.kind")
    return KalmanFilter(gain=gain, covariance=P - gain @ C @ P)


def make_estimator(
    scenario: Scenario, step: float, speed: float, disturbance: FloatArray, per_control: int = 1
) -> Estimator | None:
    """What estimates the state for a scenario's controllers, or None where they have the state itself.

    Args:
        scenario: Whose vehicle, road and sensors.
        step: Between measurements [s].
        speed: For which the filter is made [m/s].
        disturbance: In each step, fine step after fine step (steps, 3 · fine), as `RoadInput.disturbance`.
        per_control: Measurements in a control step: each has so many times the variance, so that together they tell as
            much as one.

    Raises:
        RidelabError: There is no such filter.
    """
    if scenario.estimation.kind == "exact":
        return None
    noise = scenario.estimation
    if per_control > 1:
        names = "acceleration_noise", "deflection_noise", "pitch_rate_noise"
        noise = noise.model_copy(update={name: getattr(noise, name) * sqrt(per_control) for name in names})
    roughness = max(scenario.road.roughness, _LEAST_ROUGHNESS)
    intensity = (2 * pi * REFERENCE_FREQUENCY) ** 2 * roughness * speed / 2
    filtered = kalman_filter(scenario.vehicle, noise, step, intensity)
    model, sensors, L = discrete(scenario.vehicle, step), measurement(scenario.vehicle), filtered.gain
    rest = np.eye(STATES) - L @ sensors.C
    steps = len(disturbance)
    braking, last = disturbance.reshape(steps, -1, DISTURBANCES)[:, :, 2].mean(axis=1), disturbance[:, -1]
    white = np.random.default_rng((scenario.road.seed, _NOISE_STREAM)).standard_normal((steps, len(L.T)))
    deviations = [noise.deflection_noise] * 2 + [noise.acceleration_noise, noise.pitch_rate_noise]
    return Estimator(
        state=rest @ model.A,
        command=rest @ model.B - L @ sensors.D,
        measurement=L,
        input=np.outer(braking, rest @ model.E[:, 2]) + (white * deviations - np.outer(last, sensors.F)) @ L.T,
    )


def _accumulated(vehicle: Vehicle, step: float, intensity: float) -> FloatArray:
    """Covariance (8, 8) that the road adds to the state in a step [s] (Van Loan 1978)."""
    model = half_car(vehicle)
    road = model.E[:, :2]
    block = np.zeros((2 * STATES, 2 * STATES))
    block[:STATES, :STATES], block[STATES:, STATES:] = -model.A, model.A.T
    block[:STATES, STATES:] = intensity * road @ road.T
    exponential = expm(block * step)
    return np.asarray(exponential[STATES:, STATES:].T @ exponential[:STATES, STATES:])
