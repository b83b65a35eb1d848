"""Whether the loop is stable with the car and the actuators as they really are (docs/robustness.md, "Stability").

Near rest no limit binds, and the loop of car, actuators and controller is linear: its modes say whether a small
disturbance dies out. An unstable loop here never grows beyond all bounds: the actuators' limits end it in a steady
oscillation, so no single figure of a run shows it reliably, and the modes do.
"""

import numpy as np

from sim_core.arrays import FloatArray
from sim_core.car.half_car import DISTURBANCES
from sim_core.car.linear import closed_loop_matrix, control_step
from sim_core.car.plant import plant
from sim_core.catalogue import STAGES
from sim_core.control.estimator import make_estimator
from sim_core.controllers import make_controller, told_preview
from sim_core.drive.sampling import fine_step, sample_road
from sim_core.drive.speed_profile import CONTROL_STEP, drive
from sim_core.drive.stages import coordinated_weights
from sim_core.scenario import Actuator, Bump, Mismatch, Road, Scenario
from sim_core.strategies import Strategy, SuspensionPolicy, driven, strategy_named

JUDGED = {
    SuspensionPolicy.PASSIVE,
    SuspensionPolicy.LQR,
    SuspensionPolicy.SKYHOOK,
    SuspensionPolicy.GROUNDHOOK,
    SuspensionPolicy.HYBRID,
    SuspensionPolicy.MPC_BY_ROAD,
    SuspensionPolicy.MPC_BY_STAGE,
}
_ANY_ROAD = Road(
    roughness=0, length=30, bump=Bump(height=0, start=20)
)  # no law depends on it, a Kalman filter on the roughness alone


def least_damping(scenario: Scenario, name: str | Strategy) -> float | None:
    """Smallest damping ratio of the closed loop's modes [1], over the stages; None for a controller that is not a law.

    Of a mode exp(s·t) it is -Re(s)/|s|: 1 does not oscillate, 0 oscillates for ever, below 0 the loop is unstable.
    Each stage is taken by itself; preview is left out, because it is not fed back and cannot make a loop unstable.

    Args:
        scenario: With its mismatch: the controller is designed without it and meets the real car.
        name: Strategy id, or a strategy that is in no table.

    Raises:
        UnknownNameError: No such strategy.
        RidelabError: The vehicle and weights admit no stabilising controller.
    """
    strategy = driven(strategy_named(name) if isinstance(name, str) else name, scenario.speed.policy)
    if strategy.suspension not in JUDGED:
        return None
    actuated = strategy.suspension is not SuspensionPolicy.PASSIVE
    believed = scenario.model_copy(
        update={
            "road": _ANY_ROAD,
            "mismatch": Mismatch(),
            "mpc": scenario.mpc.model_copy(update={"preview": "none"}),
            "lqr": scenario.lqr.model_copy(update={"preview": "none"}),
        }
    )
    step = scenario.mpc.sample_time if actuated else CONTROL_STEP
    motion = drive(believed, strategy.speed)
    road_input = sample_road(believed.road, believed.vehicle.wheelbase, motion, step, fine_step(believed, strategy))
    controller = make_controller(believed, strategy, motion, road_input)
    car = plant(scenario.real_vehicle, scenario.actuator if actuated else Actuator(), step, 1)
    stages = STAGES if actuated else ("cruise",)
    distinct = {coordinated_weights(believed, strategy, stage): stage for stage in stages}
    estimator = None
    if actuated:
        mode, still = told_preview(scenario, strategy.suspension), np.zeros((1, DISTURBANCES))
        estimator = make_estimator(scenario, step, motion.initial_speed, still, mode=mode)
    loop = control_step(car, scenario.real_vehicle, estimator)
    return min(damping(closed_loop_matrix(loop, controller.law(stage)), step) for stage in distinct.values())


def damping(loop: FloatArray, step: float) -> float:
    """Smallest damping ratio [1] of z' = loop·z over a step [s]; loop (n, n)."""
    eigenvalues = np.linalg.eigvals(loop)
    eigenvalues = eigenvalues[np.abs(eigenvalues) > np.finfo(float).tiny]  # zero is gone after a step: damped enough
    poles = np.log(eigenvalues.astype(np.complex128)) / step
    size = np.abs(poles)
    ratios = np.where(size > 0, -poles.real / np.where(size > 0, size, 1), 0.0)
    return float(ratios.min(initial=1.0))
