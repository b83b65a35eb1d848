"""A steady-state Kalman filter on what cars measure, between the car and its controller (Kalman 1960).

Measured at each control instant, just before the command changes: both suspension deflections, the body's acceleration
and the pitch rate. The braking is known from the speed plan. Of the road the filter is told what its controller
previews; the rest of the roughness is white velocity noise to it (docs/explanation/estimation.md).
"""

from dataclasses import dataclass
from functools import lru_cache
from math import ceil, log2, pi, sqrt

import numpy as np

from sim_core.arrays import FloatArray
from sim_core.caching import cached
from sim_core.errors import RefusedError
from sim_core.matrices import exponential, riccati, solve
from sim_core.road.profile import REFERENCE_FREQUENCY
from sim_core.road.sensed import ExpectedErrors, expected_errors, wiener_filter
from sim_core.scenario import Estimation, Preview, Scenario, Vehicle
from sim_core.scenario.road import RearAxle
from sim_core.vehicle.half_car import MEASURED_OUTPUTS, STATES, discrete, half_car, measurement
from sim_core.vehicle.model import Estimator

_NOISE_STREAM = 6  # a generator of its own beside the road's
_LEAST_ROUGHNESS = 1e-6  # on a smoother road the filter would ignore its sensors [m³]
_BODY_VELOCITY = 4  # in the state
_FREQUENCIES = np.geomspace(0.05, 50, 300)  # the body's and the wheels' [Hz]
NOTHING_SEEN = (1.0, 1.0)
_UNSTABLE = "No stable Kalman filter was found for this vehicle and these sensors"


@dataclass(frozen=True, slots=True, eq=False, kw_only=True)
class KalmanFilter:
    """x̂ = x̂⁻ + gain·(y - C x̂⁻ - D u - F a), a the disturbances at the measurement.

    Attributes:
        gain: (8, 4).
        covariance: Of the estimate's error (8, 8).
    """

    gain: FloatArray
    covariance: FloatArray


@cached
def kalman_filter(
    vehicle: Vehicle,
    noise: Estimation,
    step: float,
    intensity: float,
    unseen: tuple[float, float] = NOTHING_SEEN,
    per_control: int = 1,
    rear_axle: RearAxle = "in_turn",
) -> KalmanFilter:
    """Return the filter that is optimal on an endless road.

    Args:
        vehicle: The one the controllers believe in.
        noise: Of the sensors.
        step: Between measurements [s].
        intensity: Of each axle's road velocity, two-sided [m²/s].
        unseen: Share of that intensity that preview does not measure, front and rear.
        per_control: Measurements in a control step, whose mean velocity preview gives.
        rear_axle: Whether both axles meet the road together: its velocities are then the same noise, else two.

    Raises:
        RidelabError: There is no such filter.
    """
    A, C = discrete(vehicle, step).A, measurement(vehicle).C
    share = np.array(unseen)
    left, seen = _under_both(intensity * share, rear_axle), _under_both(intensity * (1 - share), rear_axle)
    Q = _added(vehicle, step, left, seen, per_control)
    R = np.diag(_deviations(noise, per_control) ** 2)
    P = riccati(A.T, C.T, Q, R, np.zeros((STATES, len(C))))
    gain = solve(C @ P @ C.T + R, C @ P).T
    closed = A - gain @ C @ A
    if not np.isfinite(closed).all() or np.abs(np.linalg.eigvals(closed)).max() >= 1:
        raise RefusedError(_UNSTABLE, field="estimation.kind")
    return KalmanFilter(gain=gain, covariance=P - gain @ C @ P)


def make_estimator(
    scenario: Scenario,
    step: float,
    speed: float,
    braking: FloatArray,
    per_control: int = 1,
    *,
    mode: Preview = "none",
    seen: FloatArray | None = None,
) -> Estimator:
    """Return what estimates the state for a scenario's controllers.

    Args:
        scenario: Whose vehicle, road and sensors.
        step: Between measurements [s].
        speed: For which the filter is made [m/s].
        braking: Deceleration in each fine step of each step (steps, fine) [m/s^2].
        per_control: As of `sensor_noise`.
        mode: What the filter's controller previews, where the filter is told of it.
        seen: Mean velocity of both axles' road over each control step, as previewed (steps / per_control, 2) [m/s];
            None is a level road.

    Raises:
        RidelabError: There is no such filter.
    """
    roughness = max(scenario.road.roughness, _LEAST_ROUGHNESS)
    intensity = (2 * pi * REFERENCE_FREQUENCY) ** 2 * roughness * speed / 2
    unseen = _unseen(scenario, mode, speed)
    rear_axle = scenario.road.rear_axle
    filtered = kalman_filter(scenario.vehicle, scenario.estimation, step, intensity, unseen, per_control, rear_axle)
    model, sensors, L = discrete(scenario.vehicle, step), measurement(scenario.vehicle), filtered.gain
    rest = np.eye(STATES) - L @ sensors.C
    predicted = np.outer(braking.mean(axis=1), model.E[:, 2])
    if seen is not None:
        predicted += np.repeat(seen, per_control, axis=0) @ model.E[:, :2].T
    measured = sensor_noise(scenario, len(braking), per_control) - np.outer(braking[:, -1], sensors.F)
    return Estimator(
        state=rest @ model.A,
        command=rest @ model.B - L @ sensors.D,
        measurement=L,
        input=predicted @ rest.T + measured @ L.T,
    )


@cached
def sensor_noise(scenario: Scenario, steps: int, per_control: int = 1) -> FloatArray:
    """Noise of half_car.MEASURED_OUTPUTS in each step (steps, 4), in their units.

    Args:
        scenario: Whose sensors and seed.
        steps: Measurements.
        per_control: Measurements in a control step. The variance of each is multiplied by it, so that together they
            carry the information of one.
    """
    white = np.random.default_rng((scenario.road.seed, _NOISE_STREAM)).standard_normal((steps, len(MEASURED_OUTPUTS)))
    return white * _deviations(scenario.estimation, per_control)


def _deviations(noise: Estimation, per_control: int) -> FloatArray:
    """Standard deviations of half_car.MEASURED_OUTPUTS (4,)."""
    of_sensors = [noise.deflection_noise] * 2 + [noise.acceleration_noise, noise.pitch_rate_noise]
    return np.array(of_sensors) * sqrt(per_control)


def _unseen(scenario: Scenario, mode: Preview, speed: float) -> tuple[float, float]:
    """Return which share of the roughness' intensity preview leaves unknown under the front and the rear axle."""
    if mode == "wheelbase" and scenario.rear_axle_offset:
        return 1.0, 0.0  # the rear axle meets what the front one has passed
    if mode == "lookahead":
        road, expected = scenario.road, expected_errors(scenario.mpc)
        share = unseen_share(scenario.vehicle, road.roughness, speed, expected, road.rear_axle)
        beyond = speed * scenario.mpc.sample_time - scenario.speed.detection_distance  # what a step begins to see
        return 1.0 if beyond > 0 else share, 1.0 if beyond > scenario.rear_axle_offset else share
    return NOTHING_SEEN


@lru_cache(maxsize=128)
def unseen_share(
    vehicle: Vehicle, roughness: float, speed: float, expected: ExpectedErrors, rear_axle: RearAxle = "in_turn"
) -> float:
    """Return the share of the road's intensity with which white noise moves the body as what preview leaves unknown.

    Of the road's density S the Wiener estimate (`wiener_filter`, W) leaves S (1 - exp(-(2π n s)²/2) W), s being the
    expected offset: little of the long waves and all of the short ones. No sensor measures the body's velocity, which
    is why that is what counts.
    """
    if expected == ExpectedErrors():
        return 0.0
    model, n = half_car(vehicle), _FREQUENCIES / speed
    left = 1 - np.exp(-((2 * pi * n * expected.offset) ** 2) / 2) * wiener_filter(n, roughness, expected)
    plant = 2j * pi * _FREQUENCIES[:, None, None] * np.eye(STATES) - model.A
    motion = np.linalg.solve(plant, np.broadcast_to(model.E[:, :2], (len(n), STATES, 2)))[:, _BODY_VELOCITY]
    causes = motion if rear_axle == "in_turn" else motion.sum(axis=1, keepdims=True)
    power = (np.abs(causes) ** 2).sum(axis=1) * _FREQUENCIES  # an interval of the grid grows with its frequency
    return float(power @ left / power.sum())


def _under_both(intensities: FloatArray, rear_axle: RearAxle) -> FloatArray:
    """Return the intensity matrix (2, 2) [m²/s] of road velocities with these intensities (2,) under both axles."""
    if rear_axle == "in_turn":  # what the front axle meets the rear one meets much later: taken as independent
        return np.diag(intensities)
    return np.asarray(np.sqrt(np.outer(intensities, intensities)))


def _added(vehicle: Vehicle, step: float, unseen: FloatArray, seen: FloatArray, per_control: int) -> FloatArray:
    """Covariance (8, 8) that the road adds to what the filter predicts of the state over a step [s].

    Of a road whose mean velocity over a control step h is known, only what it does around that mean is added: the mean
    itself has the covariance intensity / h. Measurements within a control step share that evenly.

    Args:
        vehicle: The believed one.
        step: Between measurements [s].
        unseen: Intensity of the velocities under the front and the rear axle that are not known (2, 2) [m²/s].
        seen: Of the velocities whose mean over a control step is known (2, 2) [m²/s].
        per_control: Measurements in a control step.
    """
    control_step = step * per_control
    held = discrete(vehicle, control_step).E[:, :2]
    around = _accumulated(vehicle, control_step, seen) - held @ (seen / control_step) @ held.T
    return _accumulated(vehicle, step, unseen) + around / per_control


def _accumulated(vehicle: Vehicle, step: float, intensity: FloatArray) -> FloatArray:
    """Covariance (8, 8) that white road velocities of this intensity (2, 2) add to the state in a step [s].

    Van Loan (1978), over a part in which nothing grows much, then over twice as long again and again: what decays fast
    is e^(time / its time constant) in that method.
    """
    model = half_car(vehicle)
    road = model.E[:, :2]
    doublings = max(0, ceil(log2(float(np.abs(model.A).sum(axis=0).max()) * step)))
    block = np.zeros((2 * STATES, 2 * STATES))
    block[:STATES, :STATES], block[STATES:, STATES:] = -model.A, model.A.T
    block[:STATES, STATES:] = road @ intensity @ road.T
    part = exponential(block * (step / 2**doublings))
    decay = part[STATES:, STATES:].T
    added = decay @ part[:STATES, STATES:]
    for _ in range(doublings):
        added, decay = added + decay @ added @ decay.T, decay @ decay
    return np.asarray(added)
