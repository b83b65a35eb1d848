"""What a run costs, estimated from the scenario alone; and the limit on what one run may cost.

Seconds are those of one core of the machine on which they were fitted. A run's own limits
count its work and not its time, so that whether it is too expensive depends on the scenario alone, and on no fit. With
which simulated drives a recording is compared does depend on it, and its notes name those left out.
"""

import tomllib
from collections.abc import Iterable, Mapping
from math import erfc, inf, pi, sqrt
from pathlib import Path

import numpy as np

from sim_core import Actuator, Controller, DampingController, EcuController, PredictiveController, Scenario
from sim_core.control.qp import osqp_effort
from sim_core.errors import TooExpensiveError
from sim_core.loop.excitation import longest_fine_step, step_sizes
from sim_core.loop.run import run_dampers
from sim_core.road.profile import REFERENCE_FREQUENCY
from sim_core.scenario.recorded import recording_id
from sim_core.speed.profile import make_speed_profile
from sim_core.strategies import REFERENCE_STRATEGIES, speed_plan_on, strategy_named
from sim_core.vehicle.make import is_linear, substeps

MAX_REFERENCE_COST = 3.0  # of one drive that a recording is compared with [s of one core]
# To read a recording of all signals and find its position on roads of these lengths [m] [s of one core].
PLACING = (0.0, 150.0, 500.0, 1000.0, 3000.0), (0.1, 0.8, 3.0, 5.0, 7.0)
CACHED_STEPS = 3e5  # of a run: so many fine steps' arrays fit into the processor's cache
MIN_ROUGHNESS = 1e-8  # of a road without any [m^3]
SETTLING = 0.5  # the bump's effect lasts so long after it [s]
FORCE_RATIO = 2.0  # of a controller's force to the passive suspension's
LEAST_HARD = 0.1  # of the control steps of a run by OSQP, with such a QP
ITERATIONS = 350.0  # of OSQP, for one QP
MAX_BYTES = 4.2e8  # of one run's arrays; whoever changes this or `memory` changes which scenarios have a result
MAX_OPERATIONS = 3.3e11  # of one run's steps: some 30 s; its QPs have a limit of their own, `control.qp.MAX_EFFORT`

UNITS: Mapping[str, Mapping[str, float]] = tomllib.loads(Path(__file__).with_name("units.toml").read_text("utf-8"))


def duration(scenario: Scenario, name: str) -> float:
    """Return the time that the strategy takes from x = 0 to the road's end [s]."""
    plan = speed_plan_on(strategy_named(name), scenario)
    return make_speed_profile(scenario, plan).time_at(scenario.road.length)


def estimate(scenario: Scenario, name: str) -> float:
    """Return the expected cost of one strategy, or of a recording with what it is compared with [s of one core].

    Raises:
        UnknownNameError: No such strategy.
    """
    if recording_id(name) is not None:
        return float(np.interp(scenario.road.length, *PLACING)) + cost_of(scenario, references(scenario))
    strategy = strategy_named(name)
    time = duration(scenario, name)
    counts = work(scenario, strategy, time, limited_share(scenario, strategy, time))
    return sum(UNITS[unit]["seconds"] * count for unit, count in counts.items())


def references(scenario: Scenario) -> tuple[str, ...]:
    """Return the strategies whose drives a recording is compared with: those that are not too expensive."""
    return tuple(name for name in REFERENCE_STRATEGIES if estimate(scenario, name) <= MAX_REFERENCE_COST)


def cost_of(scenario: Scenario, strategies: Iterable[str]) -> float:
    """Return the expected cost of these strategies together [s of one core]."""
    return sum(estimate(scenario, name) for name in strategies)


def check_affordable(scenario: Scenario, name: str) -> float:
    """Return about the most that a run's arrays take at once [bytes]; one whose steps alone are too many is refused.

    Raises:
        UnknownNameError: No such strategy.
        TooExpensiveError: There are too many.
    """
    strategy = strategy_named(name)
    time = duration(scenario, name)
    counts = work(scenario, strategy, time, 1.0)
    operations = sum(UNITS[unit].get("operations", 0.0) * count for unit, count in counts.items())
    size = memory(scenario, strategy, time)
    if operations > MAX_OPERATIONS or size > MAX_BYTES:
        raise TooExpensiveError("The run has too many steps", fields=_fields(scenario, strategy))
    return size


def samples(scenario: Scenario, strategy: type[Controller], time: float) -> tuple[float, int]:
    """Return the control steps of a run and the fine steps in each: its samples are their product.

    Args:
        scenario: What is driven.
        strategy: What drives it.
        time: The run's [s].
    """
    steps = step_sizes(scenario, strategy().for_scenario(scenario), speed_plan_on(strategy, scenario))
    return time / steps.control, steps.fine


def memory(scenario: Scenario, strategy: type[Controller], time: float) -> float:
    """Return about the most that a run's arrays take at once, given its time over the road [s] [bytes].

    Measured. It is driven first, with what is previewed where that is no view of the road ahead; then its time
    histories are made, each sample 8 bytes.
    """
    steps, fine = samples(scenario, strategy, time)
    controller = strategy().for_scenario(scenario)
    ahead = controller.preview_steps * scenario.mpc.sample_time * scenario.speed.initial
    copied = controller.preview == "wheelbase" or ahead > scenario.speed.detection_distance
    previewed = (8.0 if controller.preview == "none" else 58.0 * copied) * controller.preview_steps
    each = 250.0 + max(165.0 * fine, 85.0 * fine + previewed)
    if strategy.actuated and scenario.estimation.kind != "exact":
        each += 300.0
    if issubclass(strategy, EcuController):  # what went over its channels
        each += 3300.0
    return steps * each


def limited_share(scenario: Scenario, strategy: type[Controller], time: float) -> float:
    """Return the expected share of a run's control steps at a limit, given its time over the road [s].

    The force that a controller asks for on a rough road is some two times that of the passive suspension, whose
    variance has a closed form for a quarter car: road velocity as white noise of density A does work on a tyre of
    stiffness k_t at a mean power of A k_t / 2, all of which the damper dissipates, so the deflection's rate has the
    variance A k_t / (2 c) and the deflection A (m_b + m_w) / (2 c). Where the real springs are softer than the
    controller believes, its loop may be unstable and stays at a limit.
    """
    if scenario.mismatch.springs < 1:
        return 1.0
    car, mpc, predictive = scenario.vehicle, scenario.mpc, issubclass(strategy, PredictiveController)
    speed, roughness = scenario.road.length / time, max(scenario.road.roughness, MIN_ROUGHNESS)
    density = (2 * pi * REFERENCE_FREQUENCY) ** 2 * roughness * speed / 2
    to_front = car.cg_to_rear / car.wheelbase
    force = travel = 0.0  # largest variance of an axle
    for mass, wheel, spring, damping, tyre in (
        (to_front, car.front_wheel_mass, car.front_spring, car.front_damping, car.front_tyre_stiffness),
        (1 - to_front, car.rear_wheel_mass, car.rear_spring, car.rear_damping, car.rear_tyre_stiffness),
    ):
        deflection = density * (mass * car.body_mass + wheel) / (2 * damping)
        travel = max(travel, deflection)
        force = max(force, spring**2 * deflection + damping * density * tyre / 2)
    most = min(mpc.force_limit if predictive else inf, scenario.actuator.saturation or inf)
    free = 1 - erfc(most / (sqrt(2 * force) * FORCE_RATIO))
    if predictive:
        free *= 1 - erfc(mpc.deflection_limit / sqrt(2 * travel))
        bump = scenario.road.bump
        if abs(bump.height) > mpc.deflection_limit:
            crossing = (bump.length + scenario.rear_axle_offset) / scenario.road.length
            free *= 1 - min(1.0, crossing + (mpc.prediction_horizon * mpc.sample_time + SETTLING) / time)
    return 1 - free


def work(scenario: Scenario, strategy: type[Controller], time: float, share: float) -> dict[str, float]:
    """Return how many of each of `UNITS` a run has.

    Args:
        scenario: What is driven.
        strategy: What drives it.
        time: The run's [s].
        share: Of its control steps, at a limit.
    """
    by_ecu, controller = issubclass(strategy, EcuController), strategy().for_scenario(scenario)
    plan = speed_plan_on(strategy, scenario)
    fine_step = longest_fine_step(scenario, plan, actuated=strategy.actuated)
    counts = {"run": 1.0, "fine steps": time / fine_step}
    counts["uncached steps"] = max(0.0, counts["fine steps"] - CACHED_STEPS)
    vehicle, dampers = scenario.real_vehicle, run_dampers(scenario, controller)
    if not is_linear(vehicle, dampers):
        actuator = scenario.actuator if strategy.actuated else Actuator()
        short = substeps(vehicle, actuator, dampers, fine_step)
        counts["nonlinear steps"] = counts["fine steps"] * short
    if plan == "planned":
        counts["plan"] = 1.0
    if not strategy.actuated:
        return counts
    steps = time / scenario.mpc.sample_time
    # An ECU checks its limits in every step, and its own units say what that takes.
    limited = 0.0 if by_ecu else share * steps
    if strategy.linear_law is Controller.linear_law:  # asked in every step
        limited = steps
    counts["limited steps"] = limited
    if issubclass(strategy, DampingController):
        return counts
    counts["design"] = 1.0
    if not isinstance(controller, PredictiveController):
        return counts
    horizon, moves = controller.prediction_horizon, controller.control_horizon
    checks, inputs = 2 * (moves + horizon), 3 * horizon + 10
    counts["design entries"] = checks * inputs**2
    if by_ecu:
        return counts | {
            "ECU": 1.0,
            "exchanges": steps,
            "short steps": steps * step_sizes(scenario, controller, plan).short,
            "ECU entries": steps * checks * inputs,
            "ECU iterations": 0.5 * steps * checks * scenario.hil.iterations,
        }
    unknowns, solved = 2 * moves + 2, share * steps
    counts |= {
        "check entries": (1.3 * steps + 8 * limited) * checks * inputs,
        "QPs": solved,
        "QP entries": solved * unknowns * inputs,
    }
    if controller.solver == "osqp":
        hard = max(solved, LEAST_HARD * steps)  # one that never ends may come in any run
        counts["OSQP"] = hard * osqp_effort(ITERATIONS, unknowns, 4 * horizon)
    return counts


def _fields(scenario: Scenario, strategy: type[Controller]) -> tuple[str, ...]:
    """Return the fields that make a run's steps fewer or cheaper."""
    fields: tuple[str, ...] = ("road.length", "speed.initial_speed_kmh")
    if speed_plan_on(strategy, scenario) == "planned":
        fields += ("speed.target_speed_kmh",)
    if strategy.actuated:
        fields += ("mpc.sample_time",)
    if issubclass(strategy, PredictiveController):
        fields += ("mpc.prediction_horizon", "mpc.control_horizon")
    return fields
