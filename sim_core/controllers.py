"""Which controller a strategy has and what estimates the state for it, made from the scenario."""

from math import inf

from sim_core.arrays import FloatArray
from sim_core.catalogue import STAGES
from sim_core.control.controller import Controller, PassiveController
from sim_core.control.cost import CostTerms
from sim_core.control.hooks import HookController, hook_gain
from sim_core.control.lqr import LqrController, feedforward, regulator
from sim_core.control.mpc import MpcController
from sim_core.control.mpc_design import Horizon, MpcDesign, design
from sim_core.loop.excitation import Excitation
from sim_core.loop.preview import preview, preview_windows
from sim_core.road.sensed import expected_errors
from sim_core.scenario import Preview, Scenario, Weights
from sim_core.speed.profile import SpeedProfile
from sim_core.speed.stages import coordinated_weights
from sim_core.strategies import Strategy, SuspensionPolicy
from sim_core.vehicle.estimator import make_estimator
from sim_core.vehicle.model import Estimator, SemiActiveDampers

# Which share of skyhook each of the laws has; None is the scenario's.
HOOKS = {SuspensionPolicy.SKYHOOK: 1.0, SuspensionPolicy.GROUNDHOOK: 0.0, SuspensionPolicy.HYBRID: None}


def make_controller(scenario: Scenario, strategy: Strategy, motion: SpeedProfile, excitation: Excitation) -> Controller:
    """The strategy's controller for one run; not of a strategy whose controller is an ECU.

    Raises:
        RidelabError: The vehicle and weights admit no stabilising controller.
    """
    if strategy.suspension is SuspensionPolicy.PASSIVE:
        return PassiveController()
    if strategy.suspension in HOOKS:
        share = HOOKS[strategy.suspension]
        gain = hook_gain(scenario.vehicle, scenario.hook, scenario.hook.alpha if share is None else share)
        return HookController(gain, scenario.mpc.force_limit)
    mpc, lqr = scenario.mpc, scenario.lqr
    sensing = scenario.vehicle.wheelbase, scenario.mismatch, expected_errors(mpc)
    if strategy.suspension is SuspensionPolicy.LQR:
        terms = _terms(scenario, motion, lqr.weights, lqr.deflection_weight)
        if lqr.preview == "none":
            return LqrController(regulator(terms), mpc.force_limit)
        windows = preview_windows(lqr.preview, scenario.road, motion, excitation, lqr.preview_horizon, *sensing)
        return LqrController(regulator(terms), mpc.force_limit, windows @ feedforward(terms, lqr.preview_horizon).T)
    forecast = preview(mpc.preview, scenario.road, motion, excitation, mpc.prediction_horizon, *sensing)
    return MpcController(mpc_designs(scenario, strategy, motion), forecast, mpc)


def semi_active_dampers(scenario: Scenario, strategy: Strategy) -> SemiActiveDampers | None:
    """The car's dampers where the strategy sets their coefficients; None where its actuators act beside them."""
    hook = scenario.hook
    if strategy.suspension not in HOOKS or not hook.semi_active:
        return None
    return SemiActiveDampers(
        least=hook.min_damping,
        most=inf if hook.max_damping is None else hook.max_damping,
        most_force=min(scenario.mpc.force_limit, scenario.actuator.saturation or inf),
    )


def mpc_designs(scenario: Scenario, strategy: Strategy, motion: SpeedProfile) -> dict[str, MpcDesign]:
    """The MPC of each driving stage."""
    mpc = scenario.mpc
    horizon = Horizon(
        prediction=mpc.prediction_horizon,
        control=mpc.control_horizon,
        force_limit=mpc.force_limit,
        force_change_weight=mpc.force_change_weight,
    )
    designs = {}
    for stage in STAGES:
        weights = coordinated_weights(scenario, strategy, stage)
        designs[stage] = design(_terms(scenario, motion, weights, mpc.deflection_weight), horizon)
    return designs


def make_filter(
    scenario: Scenario,
    suspension: SuspensionPolicy,
    motion: SpeedProfile,
    excitation: Excitation,
    disturbance: FloatArray,
    per_control: int = 1,
) -> Estimator | None:
    """What estimates the state for a strategy's controller, or None where it has the state itself, or none needs it.

    Args:
        scenario: What to drive.
        suspension: The strategy's.
        motion: The speed plan.
        excitation: The road at that speed.
        disturbance: Of `excitation` in each of the filter's steps (steps, 3 · fine).
        per_control: Steps of the filter in a control step.

    Raises:
        RidelabError: There is no such filter.
    """
    if suspension is SuspensionPolicy.PASSIVE or scenario.estimation.kind == "exact":
        return None
    mode, seen = told_preview(scenario, suspension), None
    if mode != "none":
        sensing = scenario.vehicle.wheelbase, scenario.mismatch, expected_errors(scenario.mpc)
        seen = preview(mode, scenario.road, motion, excitation, 1, *sensing).windows[:2, :, 0].T
    step, speed = excitation.step / per_control, motion.initial_speed
    return make_estimator(scenario, step, speed, disturbance, per_control, mode=mode, seen=seen)


def told_preview(scenario: Scenario, suspension: SuspensionPolicy) -> Preview:
    """What of the road a strategy's filter is told: what its controller previews, where the scenario says so."""
    if not scenario.estimation.knows_preview:
        return "none"
    if suspension is SuspensionPolicy.LQR:
        return scenario.lqr.preview
    return scenario.mpc.preview if suspension.predictive else "none"


def _terms(scenario: Scenario, motion: SpeedProfile, weights: Weights, deflection_weight: float) -> CostTerms:
    return CostTerms(
        vehicle=scenario.vehicle,
        speed=motion.initial_speed,
        sample_time=scenario.mpc.sample_time,
        weights=weights,
        deflection_weight=deflection_weight,
        deflection_limit=scenario.mpc.deflection_limit,
        force_weight=scenario.mpc.force_weight,
    )
