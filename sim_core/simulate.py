"""simulate(scenario, strategy): speed plan, road, controller and car step by step, and the metrics of the recording."""

from sim_core.blas import one_thread
from sim_core.ecu.calibration import Calibration
from sim_core.ecu.drive import drive_ecu, ecu_calibration
from sim_core.ecu.interface import Connect
from sim_core.ecu.loop import short_steps
from sim_core.ecu.model import modelled
from sim_core.loop.closed_loop import drive_controller
from sim_core.loop.excitation import excite, fine_step
from sim_core.metrics.evaluate import evaluate
from sim_core.result import StrategyResult
from sim_core.scenario import Scenario
from sim_core.speed.profile import CONTROL_STEP, plan_speed
from sim_core.speed.stages import segments, spans
from sim_core.strategies import Strategy, SuspensionPolicy, driven, strategy_named


@one_thread()
def simulate(
    scenario: Scenario,
    strategy: str | Strategy,
    connect: Connect = modelled,
    calibration: Calibration | None = None,
) -> StrategyResult:
    """Drive one strategy over the scenario's road.

    Args:
        scenario: What to drive.
        strategy: Its id, or a strategy that is in no table.
        connect: To the ECU of a strategy that has one; by default to its model in NumPy.
        calibration: Of that ECU; by default `ecu_calibration`'s.

    Raises:
        UnknownNameError: No such strategy.
        TooExpensiveError: Its QPs take more than one run's may.
        RidelabError: The vehicle and weights admit no stabilising controller.
    """
    if isinstance(strategy, str):
        strategy = strategy_named(strategy)
    strategy = driven(strategy, scenario.speed.policy)
    motion = plan_speed(scenario, strategy.speed)
    stages = spans(scenario, strategy, motion)
    step = CONTROL_STEP if strategy.suspension is SuspensionPolicy.PASSIVE else scenario.mpc.sample_time
    by_ecu = strategy.suspension is SuspensionPolicy.ECU
    longest, multiple = fine_step(scenario, strategy), short_steps(step) if by_ecu else 1
    excitation = excite(scenario.road, scenario.vehicle.wheelbase, motion, step, longest, multiple=multiple)
    steps = segments(stages, excitation.position)
    if by_ecu:
        calibration = calibration or ecu_calibration(scenario)
        recording = drive_ecu(scenario, calibration, motion, excitation, steps, connect)
    else:
        recording = drive_controller(scenario, strategy, motion, excitation, steps)
    return evaluate(scenario, strategy, motion, stages, recording)
