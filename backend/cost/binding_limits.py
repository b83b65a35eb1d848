"""How often limits bind in a run, and how long its QPs take: predicted from the scenario alone, in microseconds.

The force a control law asks for on a rough road is near that of the passive suspension, which has a closed form for a
quarter car: road velocity as white noise of density A does work on a tyre of stiffness k_t at a mean power of
A k_t / 2, all of which the damper dissipates, so E[ḋ²] = A k_t / (2 c), and E[d²] = A (m_b + m_w) / (2 c); spring and
damper force are uncorrelated. The margin of the limits over these matters most, and whether the real car is softer
than the law's model of it, for then the loop is unstable. benchmarks/cost_fit.py fits the coefficients to random runs.
"""

from collections.abc import Mapping
from dataclasses import dataclass
from math import log, pi, sqrt

import numpy as np

from sim_core import Controller, FloatArray, PredictiveController, Scenario
from sim_core.road.profile import REFERENCE_FREQUENCY
from sim_core.strategies.suspension_only import SuspensionOnly

MIN_ITERATIONS, MAX_ITERATIONS = 25.0, 2000.0  # of OSQP, for one QP: so often it looks whether it has solved it
FITTED_WEIGHT = 10.0  # of travel, the greatest that the coefficients were fitted to: the slider's end
TRIED_WEIGHT = 60.0  # the greatest that is searched for good laws (benchmarks/robust.py)
_MIN_ROUGHNESS = 1e-8  # of a road without any, as its logarithm is needed [m^3]
_NO_SATURATION, _NO_RATE = 3e4, 5e6  # stand for an actuator without a limit [N, N/s]
_LITTLE_NOISE = 1e-3  # of a previewed height [m]
_SETTLING = 0.5  # the bump's effect lasts so long after it [s]

# Coefficients of `limit_terms`, by cause. The sum of "force", "travel", "actuator" and "lqr" is the logarithm of the
# rate of steps at a limit, that of "bump" and "unstable" the log odds that one binds near the bump, or always, and that
# of "iterations" the logarithm of OSQP's iterations.
COEFFICIENTS: Mapping[str, tuple[float, ...]] = {
    "force": (-7.62, -2.91, -0.24, 1.71, -1.55, 0.0956, 1.73, 0.347, 0.379, 0.778, -0.509, 1.59, 0.755, -0.115),
    "travel": (-10.2, 0.728, 0.583, 1.76, 0.263, 0.299, -0.162, 2.28),
    "actuator": (0.97, -1.09, -0.23, -0.739),
    "bump": (-1.96, 2.55),
    "unstable": (7.84, 17.2, 9.96, -0.754, -6.16, 1.11, -5.92, 0.0381, -1.15),
    "iterations": (2.8, 0.912, 0.39, -0.242, -0.11, 1.59, -0.872, -0.443, 0.00187, -0.0236),
    "lqr": (-15.6, -2.02, -0.204, -0.701, 1.55, -0.65, 0.271, 0.324, -0.502, 2.83),
    "lqr actuator": (2.1, -1.53, -0.307),
    "lqr unstable": (-4.55, 25, 2.53, -0.765, 0.00721),
}


@dataclass(frozen=True, slots=True, kw_only=True)
class LimitShares:
    """Shares of the control steps at any limit, and with a QP; mean iterations of OSQP for each QP."""

    limited: float = 0.0
    solved: float = 0.0
    iterations: float = 0.0


def expected_limits(scenario: Scenario, strategy: type[Controller], time: float) -> LimitShares:
    """Expected for a strategy with a controller, given its time over the road [s]."""
    values = {
        cause: np.asarray(np.dot(COEFFICIENTS[cause], row))
        for cause, row in limit_terms(scenario, strategy, time).items()
    }
    limited, solved, iterations = combine(values, np.asarray(bump_share(scenario, time)))
    if issubclass(strategy, PredictiveController):  # a law far from what was fitted may be at a limit in every step
        trust = TRIED_WEIGHT / max(scenario.mpc.deflection_weight, TRIED_WEIGHT)
        limited, solved = 1 - trust * (1 - limited), 1 - trust * (1 - solved)
    return LimitShares(limited=float(limited), solved=float(solved), iterations=float(iterations))


def limit_terms(scenario: Scenario, strategy: type[Controller], time: float) -> dict[str, tuple[float, ...]]:
    """The terms that COEFFICIENTS multiply, by cause."""
    mpc, actuator, mismatch = scenario.mpc, scenario.actuator, scenario.mismatch
    vehicle, bump = scenario.vehicle, scenario.road.bump
    force, travel = _passive(scenario, scenario.road.length / time)
    force_margin = log(mpc.force_limit / force)
    saturation = log((actuator.saturation or _NO_SATURATION) / force)
    rate = log((actuator.rate_limit or _NO_RATE) * mpc.sample_time / force)
    damping = log((vehicle.front_damping + vehicle.rear_damping) / 2)
    softness, underdamping = max(0.0, 1 - mismatch.springs), max(0.0, 1 - mismatch.damping)
    if not issubclass(strategy, PredictiveController):
        weights, preview, deflection_weight = scenario.lqr.weights, scenario.lqr.preview, scenario.lqr.deflection_weight
    else:
        by_stage = not issubclass(strategy, SuspensionOnly)
        weights = mpc.stage_weights.cruise if by_stage else mpc.road_weights.rough
        preview, deflection_weight = mpc.preview, mpc.deflection_weight
    comfort = log((weights[0] + 0.1) / (sum(weights) + 0.3))
    restoring = log((deflection_weight + 0.1) / (weights[0] + 1e-3))
    if preview == "wheelbase" and not scenario.rear_axle_offset:
        preview = "none"  # the front axle's road comes too late
    no_preview, wheelbase_preview = float(preview == "none"), float(preview == "wheelbase")
    errors = (*_estimation_terms(scenario), log(scenario.real_vehicle.rebound_ratio))
    unstable = (1.0, softness, underdamping, restoring, softness * restoring)
    if not issubclass(strategy, PredictiveController):
        law = (1.0, force_margin, no_preview, wheelbase_preview, damping, comfort, *errors)
        return {"lqr": law, "lqr actuator": (1.0, saturation, rate), "lqr unstable": unstable}
    horizon, limit = log(mpc.control_horizon * mpc.sample_time), log(mpc.deflection_limit)
    return {
        "force": (
            *(1.0, force_margin, horizon, log(mpc.sample_time), no_preview, wheelbase_preview, damping, comfort),
            *(*errors, _preview_noise(scenario), log(mpc.force_weight)),
        ),
        "travel": (1.0, log(mpc.deflection_limit / travel), restoring, mismatch.damping, *errors),
        "actuator": (1.0, saturation, rate, no_preview),
        "bump": (1.0, log((abs(bump.height) + 0.002) / mpc.deflection_limit)),
        "unstable": (*unstable, limit, softness * limit, log(mpc.force_weight), damping),
        "iterations": (
            1.0,
            log(mpc.prediction_horizon),
            force_margin,
            log(mpc.deflection_limit / travel),
            min(mpc.deflection_weight, FITTED_WEIGHT),
            underdamping,
            *errors,
        ),
    }


def combine(sums: Mapping[str, FloatArray], bump: FloatArray) -> tuple[FloatArray, FloatArray, FloatArray]:
    """Share of steps at a limit, share with a QP, and iterations.

    Args:
        sums: Of coefficients times terms, by cause; one value, or one for each run.
        bump: `bump_share`, likewise.
    """
    if "lqr" in sums:
        free = np.exp(-_exp(sums["lqr"]) - _exp(sums["lqr actuator"])) / (1 + _exp(sums["lqr unstable"]))
        return 1 - free, np.zeros_like(free), np.zeros_like(free)
    odds = _exp(sums["bump"])
    free = np.exp(-_exp(sums["force"]) - _exp(sums["travel"])) / (1 + _exp(sums["unstable"]))
    free = free * (1 - bump * odds / (1 + odds))
    limited = 1 - free * np.exp(-_exp(sums["actuator"]))
    return limited, 1 - free, np.clip(_exp(sums["iterations"]), MIN_ITERATIONS, MAX_ITERATIONS)


def bump_share(scenario: Scenario, time: float) -> float:
    """Share of that time over the road [s] in which the bump is ahead, under an axle, or just behind."""
    mpc, road = scenario.mpc, scenario.road
    crossing = (road.bump.length + scenario.rear_axle_offset) * time / road.length
    return min(1.0, (crossing + mpc.prediction_horizon * mpc.sample_time + _SETTLING) / time)


def _estimation_terms(scenario: Scenario) -> tuple[float, float, float]:
    """Whether a filter estimates the state, and how noisy its sensors of acceleration and deflection are."""
    estimation = scenario.estimation
    if estimation.kind == "exact":
        return 0.0, 0.0, 0.0
    return 1.0, log(estimation.acceleration_noise), log(estimation.deflection_noise)


def _preview_noise(scenario: Scenario) -> float:
    """Noise of a previewed road, as its logarithm."""
    if scenario.mpc.preview in ("none", "obstacle"):
        return 0.0
    return log(1 + scenario.mismatch.preview_noise / _LITTLE_NOISE)


def _passive(scenario: Scenario, speed: float) -> tuple[float, float]:
    """RMS of the passive suspension's force [N] and deflection [m] at a speed [m/s], the greater of both axles."""
    vehicle = scenario.vehicle
    density = (2 * pi * REFERENCE_FREQUENCY) ** 2 * max(scenario.road.roughness, _MIN_ROUGHNESS) * speed / 2
    share = vehicle.cg_to_rear / vehicle.wheelbase
    forces, travels = [], []
    for mass, wheel, spring, damping, tyre in (
        (share, vehicle.front_wheel_mass, vehicle.front_spring, vehicle.front_damping, vehicle.front_tyre_stiffness),
        (1 - share, vehicle.rear_wheel_mass, vehicle.rear_spring, vehicle.rear_damping, vehicle.rear_tyre_stiffness),
    ):
        travel = density * (mass * vehicle.body_mass + wheel) / (2 * damping)
        forces.append(sqrt(spring**2 * travel + damping * density * tyre / 2))
        travels.append(sqrt(travel))
    return max(forces), max(travels)


def _exp(value: FloatArray) -> FloatArray:
    """Without overflow."""
    return np.asarray(np.exp(np.clip(value, -30.0, 8.0)))
