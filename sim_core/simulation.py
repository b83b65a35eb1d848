"""simulate(scenario, strategy): road and drive, controller, closed loop, record, metrics."""

import numpy as np

from sim_core.closed_loop import ClosedLoop
from sim_core.controller import Controller, PassiveController, SolverReport
from sim_core.cost import CostTerms
from sim_core.fields import Weights
from sim_core.hil.calibration import Calibration, Checked
from sim_core.hil.drive import calibration, drive_hil, longest_fine_step
from sim_core.hil.ecu import Connect
from sim_core.hil.model import modelled
from sim_core.longitudinal import CONTROL_STEP, KMH, Drive, drive
from sim_core.lqr import LqrController, feedforward, regulator
from sim_core.metrics import Recording, evaluate
from sim_core.mpc import CENTI, Horizon, MpcController, MpcDesign, design
from sim_core.plant import plant
from sim_core.preview import preview, preview_windows
from sim_core.result import StrategyResult
from sim_core.road import GRID, detail
from sim_core.scenario import Actuator, Scenario
from sim_core.stages import coordinated_weights, segments, spans
from sim_core.strategies import SpeedPolicy, Strategy, SuspensionPolicy, strategy
from sim_core.track import Track, track

FINEST, COARSEST = 5e-5, 1e-3  # bounds of the fine step [s]


def simulate(scenario: Scenario, name: str | Strategy, connect: Connect = modelled) -> StrategyResult:
    """Drive one strategy over the scenario's road.

    Args:
        scenario: What to drive.
        name: Strategy id, or a strategy that is in no table.
        connect: To the ECU of a strategy that has one; by default its model in NumPy.

    Raises:
        UnknownNameError: No such strategy.
        RidelabError: The vehicle and weights admit no stabilising controller.
    """
    chosen = strategy(name) if isinstance(name, str) else name
    if chosen.suspension is SuspensionPolicy.ECU:
        return simulate_ecu(scenario, ecu_calibration(scenario), connect)
    actuated = chosen.suspension is not SuspensionPolicy.PASSIVE
    motion = drive(scenario, chosen.speed)
    stages = spans(scenario, chosen, motion)
    step = scenario.mpc.sample_time if actuated else CONTROL_STEP
    way = track(scenario.road, scenario.vehicle.wheelbase, motion, step, fine_step(scenario, chosen.speed))
    actuator = scenario.actuator if actuated else Actuator()
    car = plant(scenario.real_vehicle, actuator, step, way.fine)
    controller = make_controller(scenario, chosen, motion, way)
    most_change = np.inf if actuator.rate_limit is None else actuator.rate_limit * step
    most_force = np.inf if actuator.saturation is None else actuator.saturation
    loop = ClosedLoop(controller, car, way.disturbance @ car.E, most_change, most_force)
    course = loop.run(segments(stages, way.position))
    on_record = slice(way.drive.before, None)
    table = car.record(course.states[on_record], course.commands[on_record], way.disturbance[on_record])
    recording = Recording(table=table, track=way)
    return evaluate(scenario, chosen, motion, stages, recording, controller.report, course.limited)


def simulate_ecu(scenario: Scenario, known: Calibration, connect: Connect = modelled) -> StrategyResult:
    """Drive `lv_hil` with these numbers in the ECU.

    Args:
        scenario: What to drive.
        known: `ecu_calibration`'s, perhaps of other horizons.
        connect: To the ECU.
    """
    chosen = strategy("lv_hil")
    motion = drive(scenario, chosen.speed)
    stages = spans(scenario, chosen, motion)
    step = scenario.mpc.sample_time
    way = track(scenario.road, scenario.vehicle.wheelbase, motion, step, longest_fine_step(step, fine_step(scenario)))
    record = drive_hil(scenario, known, motion, way, segments(stages, way.position), connect)
    tally = record.tally
    report = SolverReport(solves=tally.limited, failures=tally.unfinished, max_slack=tally.slack / CENTI)
    recording = Recording(table=record.table, track=way)
    return evaluate(scenario, chosen, motion, stages, recording, report, tally.limited, tally)


def ecu_calibration(scenario: Scenario, checked: Checked = "all") -> Calibration:
    """What the ECU of `lv_hil` knows: the scenario's own MPC, exported.

    Args:
        scenario: Whose.
        checked: Which limits of the horizon its program checks.

    Raises:
        RidelabError: The vehicle and weights admit no stabilising controller.
    """
    chosen = strategy("lv_hil")
    return calibration(scenario, mpc_designs(scenario, chosen, drive(scenario, chosen.speed)), checked)


def fine_step(scenario: Scenario, policy: SpeedPolicy = SpeedPolicy.PLANNED) -> float:
    """Longest fine step [s]: 60 over the bump (or its two ramps), 0.1 rad of the wheels, a grid step of the road, 1 ms.

    Between the ends of a fine step the road is taken as linear and the car exact, so the road's curvature and the
    sampling of peaks need it short; tests/validation holds metrics against steps of 0.02 ms. The bump counts at the
    initial speed, the rough road at the speed that is held for long.
    """
    vehicle, bump, speed = scenario.real_vehicle, scenario.road.bump, scenario.speed
    stiffest = max(
        (vehicle.front_tyre_stiffness + vehicle.front_spring) / vehicle.front_wheel_mass,
        (vehicle.rear_tyre_stiffness + vehicle.rear_spring) / vehicle.rear_wheel_mass,
    )
    over_bump = detail(bump) / (60 * speed.initial_speed_kmh * KMH) if bump.height else COARSEST
    held = speed.initial_speed_kmh
    if policy is SpeedPolicy.PLANNED:
        held = min(held, speed.target_speed_kmh)
    over_grid = GRID / (held * KMH) if scenario.road.roughness else COARSEST
    return min(COARSEST, max(FINEST, min(0.1 / float(np.sqrt(stiffest)), over_bump, over_grid)))


def make_controller(scenario: Scenario, chosen: Strategy, motion: Drive, way: Track) -> Controller:
    """The strategy's controller for one run over a track."""
    if chosen.suspension is SuspensionPolicy.PASSIVE:
        return PassiveController()
    mpc, lqr, wheelbase = scenario.mpc, scenario.lqr, scenario.vehicle.wheelbase
    if chosen.suspension is SuspensionPolicy.LQR:
        terms = _terms(scenario, motion, lqr.weights, lqr.deflection_weight)
        if lqr.preview == "none":
            return LqrController(regulator(terms), mpc.force_limit)
        seen = preview_windows(
            lqr.preview, scenario.road, motion, way, lqr.preview_horizon, wheelbase, scenario.mismatch
        )
        return LqrController(regulator(terms), mpc.force_limit, seen @ feedforward(terms, lqr.preview_horizon).T)
    windows = preview(mpc.preview, scenario.road, motion, way, mpc.prediction_horizon, wheelbase, scenario.mismatch)
    return MpcController(mpc_designs(scenario, chosen, motion), windows, mpc)


def mpc_designs(scenario: Scenario, chosen: Strategy, motion: Drive) -> dict[str, MpcDesign]:
    """The MPC of each driving stage."""
    mpc = scenario.mpc
    horizon = Horizon(
        prediction=mpc.prediction_horizon,
        control=mpc.control_horizon,
        force_limit=mpc.force_limit,
        force_change_weight=mpc.force_change_weight,
    )
    designs = {}
    for stage in ("cruise", "brake", "bump"):
        weights = coordinated_weights(scenario, chosen, stage)
        designs[stage] = design(_terms(scenario, motion, weights, mpc.deflection_weight), horizon)
    return designs


def _terms(scenario: Scenario, motion: Drive, weights: Weights, deflection_weight: float) -> CostTerms:
    return CostTerms(
        vehicle=scenario.vehicle,
        speed=motion.initial_speed,
        sample_time=scenario.mpc.sample_time,
        weights=weights,
        deflection_weight=deflection_weight,
        deflection_limit=scenario.mpc.deflection_limit,
        force_weight=scenario.mpc.force_weight,
    )
