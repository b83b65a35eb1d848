"""`lv_hil` over a road: designs into tables, sensors ahead, the car in short steps, and the loop around the ECU."""

import numpy as np

from sim_core.control.controller import SolverReport
from sim_core.control.mpc_design import CENTI
from sim_core.controllers import make_filter, mpc_designs
from sim_core.ecu.calibration import Calibration, Checked, calibrate
from sim_core.ecu.channels import STAGES
from sim_core.ecu.interface import Connect
from sim_core.ecu.loop import HilLoop, Limits, LoopInputs, short_steps
from sim_core.loop.excitation import Excitation, under_axles
from sim_core.loop.preview import preview_windows
from sim_core.loop.recording import Recording
from sim_core.road.sensed import expected_errors
from sim_core.scenario import Scenario
from sim_core.speed.profile import SpeedProfile, plan_speed
from sim_core.strategies import SuspensionPolicy, driven, strategy_named
from sim_core.vehicle.half_car import DISTURBANCES, discrete
from sim_core.vehicle.make import is_linear, make_vehicle


def ecu_calibration(scenario: Scenario, checked: Checked = "all") -> Calibration:
    """What the ECU of `lv_hil` knows: the scenario's own MPC, exported.

    Args:
        scenario: Whose.
        checked: Which limits of the horizon its program checks.

    Raises:
        RidelabError: The vehicle and weights admit no stabilising controller.
    """
    strategy = driven(strategy_named("lv_hil"), scenario.speed.policy)
    designs = mpc_designs(scenario, strategy, plan_speed(scenario, strategy.speed))
    model = discrete(scenario.vehicle, scenario.mpc.sample_time)
    return calibrate(designs, model, scenario.hil, scenario.mpc.force_limit, checked)


def drive_ecu(
    scenario: Scenario,
    calibration: Calibration,
    motion: SpeedProfile,
    excitation: Excitation,
    stages: list[tuple[str, int, int]],
    connect: Connect,
) -> Recording:
    """Drive the ECU's controller over a road.

    Args:
        scenario: What to drive.
        calibration: What the ECU knows.
        motion: The speed plan.
        excitation: With a whole multiple of `short_steps` fine steps in a control step.
        stages: Name, first control step and one past the last, as `segments` gives them.
        connect: To the ECU.
    """
    n = short_steps(excitation.step)
    fine = excitation.fine // n
    disturbance = excitation.disturbance.reshape(-1, DISTURBANCES * fine)
    before = excitation.drive.before * n
    step = excitation.step / n
    estimator = make_filter(scenario, SuspensionPolicy.ECU, motion, excitation, disturbance, per_control=n)
    vehicle = scenario.real_vehicle
    road = None if is_linear(vehicle, None) else under_axles(excitation)
    car = make_vehicle(vehicle, scenario.actuator, step, disturbance, before, estimator=estimator, road=road)
    numbers = [STAGES.index(stage) for stage, first, last in stages for _ in range(first, last)]
    if calibration.predicts:  # a command is made for the stage in which it takes effect
        numbers = [*numbers[1:], numbers[-1]]
    preview = preview_windows(
        scenario.mpc.preview,
        scenario.road,
        motion,
        excitation,
        calibration.preview_length,
        scenario.vehicle.wheelbase,
        scenario.mismatch,
        expected_errors(scenario.mpc),
    )
    rate, most = scenario.actuator.rate_limit, scenario.mpc.force_limit
    saturation = scenario.actuator.saturation
    loop = HilLoop(
        car=car,
        inputs=LoopInputs(preview=preview, stages=numbers, per_control=n, step=step),
        calibration=calibration,
        hil=scenario.hil,
        limits=Limits(
            rate=np.inf if rate is None else rate, force=most if saturation is None else min(most, saturation)
        ),
    )
    with connect(calibration) as ecu:
        trajectory = loop.run(ecu)
    counts = trajectory.statistics
    return Recording(
        table=car.record(trajectory.states[before:], trajectory.commands[before:]),
        excitation=excitation,
        report=SolverReport(solves=counts.limited, failures=counts.unfinished, max_slack=counts.slack / CENTI),
        limited=counts.limited,
        loop=counts,
    )
