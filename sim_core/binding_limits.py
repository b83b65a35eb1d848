"""How often limits bind in a run, and how long its QPs take: predicted from the scenario alone, in microseconds.

The force a control law asks for on a rough road is near that of the passive suspension, which has a closed form for a
quarter car: road velocity as white noise of density A does work on a tyre of stiffness k_t at a mean power of
A k_t / 2, all of which the damper dissipates, so E[ḋ²] = A k_t / (2 c), and E[d²] = A (m_b + m_w) / (2 c); spring and
damper force are uncorrelated. The margin of the limits over these matters most, and whether the real car is softer
than the law's model of it, for then the loop is unstable. benchmarks/cost.py fits the coefficients to random scenarios.
"""

from collections.abc import Mapping
from dataclasses import dataclass
from math import log, pi, sqrt

import numpy as np

from sim_core.arrays import FloatArray
from sim_core.car.road import REFERENCE_FREQUENCY
from sim_core.scenario import Scenario
from sim_core.strategies import Strategy, SuspensionPolicy

MAX_ITERATIONS = 2000.0  # of a QP solver, for one QP
_MIN_ROUGHNESS = 1e-8  # of a road without any, as its logarithm is needed [m^3]
_NO_SATURATION, _NO_RATE = 3e4, 5e6  # stand for an actuator without a limit [N, N/s]
_SETTLING = 0.5  # the bump's effect lasts so long after it [s]

# Coefficients of `limit_terms`, by cause. The sum of "force", "travel", "actuator" and "lqr" is the logarithm of the
# rate of steps at a limit, that of "bump" and "unstable" the log odds that one binds near the bump, or always, and that
# of "iterations" the logarithm of OSQP's iterations.
COEFFICIENTS: Mapping[str, tuple[float, ...]] = {
    "force": (-11, -3.7, 0.403, -0.875, -2.94, -1.82, 1.3, -0.252),
    "travel": (5.06, -3.54, -0.716, -6.42),
    "actuator": (1.5, -0.671, -1.86, -1.12),
    "bump": (-2.27, 4.6),
    "unstable": (-2.9, 86.5, 6.77, -0.858, -5.25, 1.16, 24.6, -0.104, -0.322),
    "iterations": (4.12, 0.393, 0.242, -0.218, -0.0438, 0.727),
    "lqr": (-7.74, -2.29, -1, -1.08, 1, 0.00258),
    "lqr actuator": (0.754, -1.63, -0.355),
    "lqr unstable": (-5.37, 22.5, 4.97, -1.02, 4.68),
}


@dataclass(frozen=True, slots=True, kw_only=True)
class LimitShares:
    """Shares of the control steps at any limit, and with a QP; mean iterations of OSQP for each QP."""

    limited: float = 0.0
    solved: float = 0.0
    iterations: float = 0.0


def expected_limits(scenario: Scenario, strategy: Strategy, time: float) -> LimitShares:
    """Expected for a strategy with a controller, given its time over the road [s]."""
    values = {
        cause: np.asarray(np.dot(COEFFICIENTS[cause], row))
        for cause, row in limit_terms(scenario, strategy, time).items()
    }
    limited, solved, iterations = combine(values, np.asarray(bump_share(scenario, time)))
    return LimitShares(limited=float(limited), solved=float(solved), iterations=float(iterations))


def limit_terms(scenario: Scenario, strategy: Strategy, time: float) -> dict[str, tuple[float, ...]]:
    """The terms that COEFFICIENTS multiply, by cause."""
    mpc, actuator, mismatch = scenario.mpc, scenario.actuator, scenario.mismatch
    vehicle, bump = scenario.vehicle, scenario.road.bump
    force, travel = _passive(scenario, scenario.road.length / time)
    force_margin = log(mpc.force_limit / force)
    saturation = log((actuator.saturation or _NO_SATURATION) / force)
    rate = log((actuator.rate_limit or _NO_RATE) * mpc.sample_time / force)
    damping = log((vehicle.front_damping + vehicle.rear_damping) / 2)
    softness, underdamping = max(0.0, 1 - mismatch.springs), max(0.0, 1 - mismatch.damping)
    if not strategy.suspension.predictive:
        weights, preview, deflection_weight = scenario.lqr.weights, scenario.lqr.preview, scenario.lqr.deflection_weight
    else:
        by_stage = strategy.suspension is not SuspensionPolicy.MPC_BY_ROAD
        weights = mpc.stage_weights.cruise if by_stage else mpc.road_weights.rough
        preview, deflection_weight = mpc.preview, mpc.deflection_weight
    comfort = log((weights[0] + 0.1) / (sum(weights) + 0.3))
    restoring = log((deflection_weight + 0.1) / (weights[0] + 1e-3))
    no_preview, wheelbase_preview = float(preview == "none"), float(preview == "wheelbase")
    unstable = (1.0, softness, underdamping, restoring, softness * restoring)
    if not strategy.suspension.predictive:
        law = (1.0, force_margin, no_preview, wheelbase_preview, damping, comfort)
        return {"lqr": law, "lqr actuator": (1.0, saturation, rate), "lqr unstable": unstable}
    horizon, limit = log(mpc.control_horizon * mpc.sample_time), log(mpc.deflection_limit)
    return {
        "force": (1.0, force_margin, horizon, log(mpc.sample_time), no_preview, wheelbase_preview, damping, comfort),
        "travel": (1.0, log(mpc.deflection_limit / travel), restoring, mismatch.damping),
        "actuator": (1.0, saturation, rate, no_preview),
        "bump": (1.0, log((abs(bump.height) + 0.002) / mpc.deflection_limit)),
        "unstable": (*unstable, limit, softness * limit, log(mpc.force_weight), damping),
        "iterations": (
            1.0,
            log(mpc.prediction_horizon),
            force_margin,
            log(mpc.deflection_limit / travel),
            mpc.deflection_weight,
            underdamping,
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
    return limited, 1 - free, np.clip(_exp(sums["iterations"]), 10.0, MAX_ITERATIONS)


def bump_share(scenario: Scenario, time: float) -> float:
    """Share of that time over the road [s] in which the bump is ahead, under an axle, or just behind."""
    mpc, road = scenario.mpc, scenario.road
    crossing = (road.bump.length + scenario.vehicle.wheelbase) * time / road.length
    return min(1.0, (crossing + mpc.prediction_horizon * mpc.sample_time + _SETTLING) / time)


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
