"""What a run costs, estimated from the scenario alone; and the limit on what one run may cost.

Seconds are those of one core of the machine on which `python -m benchmarks.cost_fit` was run last. A run's own limits
count its work and not its time, so that whether it is too expensive depends on the scenario alone, and on no fit. With
which simulated drives a recording is compared does depend on it, and its notes name those left out.
"""

from collections.abc import Iterable, Mapping
from math import atan, exp, log, sqrt

import numpy as np

from backend.cost.binding_limits import LimitShares, expected_limits
from sim_core import Actuator, Controller, DampingController, EcuController, PredictiveController, Scenario
from sim_core.control.qp import osqp_effort
from sim_core.errors import TooExpensiveError
from sim_core.loop.excitation import StepSizes, longest_fine_step, step_sizes
from sim_core.loop.run import run_dampers
from sim_core.scenario.recorded import recording_id
from sim_core.speed.brake import BrakeChain
from sim_core.speed.profile import SPEED_CONTROL_PERIOD, TARGET_BAND, make_speed_profile
from sim_core.strategies import REFERENCE_STRATEGIES, speed_plan_on, strategy_named
from sim_core.vehicle.make import is_linear
from sim_core.vehicle.nonlinear import substeps

MAX_REFERENCE_COST = 3.0  # of one drive that a recording is compared with [s of one core]
# To read a recording of all signals and find its position on roads of these lengths [m] [s of one core].
PLACING = (0.0, 150.0, 500.0, 1000.0, 3000.0), (0.1, 0.8, 3.0, 5.0, 7.0)
CACHED_STEPS = 3e5  # of a run: so many fine steps' arrays fit into the processor's cache
MAX_BYTES = 4.2e8  # of one run's arrays; whoever changes this or `memory` changes which scenarios have a result
MAX_OPERATIONS = 3.3e11  # of one run's steps: some 30 s; its QPs have a limit of their own, `control.qp.MAX_EFFORT`

# Multiply-adds that a unit of `work` counts as in that limit. They decide which scenarios have a result: whoever
# changes one raises the core's version. `SECONDS` may be fitted anew at any time and change no run.
OPERATIONS: Mapping[str, float] = {
    "plan": 1.3e7,
    "design": 3.4e7,
    "design entries": 4.2,
    "fine steps": 1_850,
    "nonlinear steps": 400,
    "check entries": 1,
    "limited steps": 86_000,
    "ECU": 1.2e8,
    "exchanges": 330_000,
    "short steps": 50_000,
    "ECU entries": 10,
    "ECU iterations": 12,
}
# Seconds of each unit of `work`; entries are those of matrices.
SECONDS: Mapping[str, float] = {
    "run": 0,
    "plan": 0.0003,
    "design": 0.0031,
    "design entries": 3.9e-10,
    "fine steps": 1.7e-07,
    "uncached steps": 3.7e-07,
    "nonlinear steps": 1.0e-07,
    "check entries": 9.2e-11,
    "limited steps": 7.9e-06,
    "QPs": 7.8e-06,
    "QP entries": 1.9e-09,
    "OSQP": 0.8,
    "ECU": 0.011,
    "exchanges": 3e-05,
    "short steps": 4.6e-06,
    "ECU entries": 9.5e-10,
    "ECU iterations": 1.1e-09,
}


def duration(scenario: Scenario, name: str) -> float:
    """Longest time the strategy can take from x = 0 to the road's end [s]; exact where the brakes' lag is long."""
    speed, road = scenario.speed, scenario.road
    if speed_plan_on(strategy_named(name), scenario) == "constant":
        return road.length / speed.initial
    floor = min(speed.initial, speed.target) - TARGET_BAND
    # The brake pressure that remains when braking ends reduces the speed by as much again.
    slowest = floor - scenario.brake.maximum_deceleration * (scenario.brake.pressure_lag + SPEED_CONTROL_PERIOD)
    if slowest < floor / 2:
        return make_speed_profile(scenario, "planned").time_at(road.length)
    detection = scenario.braking_start
    return detection / speed.initial + (road.length - detection) / slowest


def estimate(scenario: Scenario, name: str) -> float:
    """Expected cost of one strategy, or of a recording with what it is compared with [s of one core].

    Raises:
        UnknownNameError: No such strategy.
    """
    if recording_id(name) is not None:
        return float(np.interp(scenario.road.length, *PLACING)) + cost_of(scenario, references(scenario))
    strategy = strategy_named(name)
    time = expected_time(scenario, strategy)
    counts = work(scenario, strategy, time, expected_limits(scenario, strategy, time))
    return sum(SECONDS[unit] * count for unit, count in counts.items())


def references(scenario: Scenario) -> tuple[str, ...]:
    """Return the strategies whose drives a recording is compared with: those that are not too expensive."""
    return tuple(name for name in REFERENCE_STRATEGIES if estimate(scenario, name) <= MAX_REFERENCE_COST)


def costs_of(scenario: Scenario, strategies: Iterable[str]) -> dict[str, float]:
    """Expected cost of each of these strategies [s of one core]."""
    return {strategy: estimate(scenario, strategy) for strategy in strategies}


def cost_of(scenario: Scenario, strategies: Iterable[str]) -> float:
    """Expected cost of these strategies together [s of one core]."""
    return sum(costs_of(scenario, strategies).values())


def check_affordable(scenario: Scenario, name: str) -> float:
    """About the most that a run's arrays take at once [bytes]; one whose steps alone are too many is refused.

    Raises:
        UnknownNameError: No such strategy.
        TooExpensiveError: There are too many.
    """
    strategy = strategy_named(name)
    time = make_speed_profile(scenario, speed_plan_on(strategy, scenario)).time_at(scenario.road.length)
    counts = work(scenario, strategy, time, LimitShares(limited=1.0))
    operations = sum(each * counts.get(unit, 0.0) for unit, each in OPERATIONS.items())
    size = memory(scenario, strategy, time)
    if operations > MAX_OPERATIONS or size > MAX_BYTES:
        raise TooExpensiveError("The run has too many steps", fields=_fields(scenario, strategy))
    return size


def samples(scenario: Scenario, strategy: type[Controller], time: float) -> tuple[float, int]:
    """Control steps of a run, given its time over the road [s], and fine steps in each: its samples are their product.

    Args:
        scenario: What is driven.
        strategy: What drives it.
        time: The run's [s].
    """
    steps = _steps(scenario, strategy)
    return time / steps.control, steps.fine


def memory(scenario: Scenario, strategy: type[Controller], time: float) -> float:
    """About the most that a run's arrays take at once, given its time over the road [s] [bytes].

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


def expected_time(scenario: Scenario, strategy: type[Controller]) -> float:
    """Expected time from x = 0 to the road's end [s].

    The car brakes with the maximum deceleration, slows down by its resistances until its rear axle has left the last
    bump, then holds its speed.
    """
    speed, road, brake = scenario.speed, scenario.road, scenario.brake
    initial = speed.initial
    if speed_plan_on(strategy, scenario) == "constant":
        return road.length / initial
    chain, target = BrakeChain(brake, scenario.vehicle.total_mass), min(initial, speed.target)
    distance, left = scenario.bump_start - scenario.braking_start, min(scenario.bump_left, road.length)
    braked = max(0.0, distance - brake.pressure_lag * initial)
    _, arrival = _slowing(chain, initial, target, braked, brake.maximum_deceleration)
    coasting, last = _slowing(chain, arrival, target - TARGET_BAND, left - scenario.bump_start)
    before = scenario.braking_start / initial + distance / ((initial + arrival) / 2)
    return before + coasting + (road.length - left) / last


def _slowing(
    chain: BrakeChain, speed: float, floor: float, distance: float, braking: float = 0.0
) -> tuple[float, float]:
    """Time [s] over a distance [m] on which a car slows down to a floor [m/s], and its speed at the end [m/s].

    Args:
        chain: Whose resistances slow it down.
        speed: That it begins with [m/s].
        floor: The least, which it then holds [m/s].
        distance: [m].
        braking: Deceleration by the brakes [m/s^2].
    """
    constant = max(braking + chain.rolling, 1e-6)
    air = max(chain.air, 1e-6)  # of the speed's square [1/m]
    equal = sqrt(constant / air)  # the speed at which air drag equals all else [m/s]
    slowing = min(distance, log((speed**2 + equal**2) / (floor**2 + equal**2)) / (2 * air))
    end = sqrt((speed**2 + equal**2) * exp(-2 * air * slowing) - equal**2)
    time = (atan(speed / equal) - atan(end / equal)) / sqrt(constant * air)
    return time + (distance - slowing) / end, end


def work(scenario: Scenario, strategy: type[Controller], time: float, expected: LimitShares) -> dict[str, float]:
    """How many of each unit of `SECONDS` a run has, given its time over the road [s]."""
    by_ecu, controller = issubclass(strategy, EcuController), strategy().for_scenario(scenario)
    counts = {"run": 1.0, "fine steps": time / _fine_step(scenario, strategy)}
    counts["uncached steps"] = max(0.0, counts["fine steps"] - CACHED_STEPS)
    vehicle, dampers = scenario.real_vehicle, run_dampers(scenario, controller)
    if not is_linear(vehicle, dampers):
        actuator = scenario.actuator if strategy.actuated else Actuator()
        short = substeps(vehicle, actuator, dampers, _fine_step(scenario, strategy))
        counts["nonlinear steps"] = counts["fine steps"] * short
    if speed_plan_on(strategy, scenario) == "planned":
        counts["plan"] = 1.0
    if not strategy.actuated:
        return counts
    steps = time / scenario.mpc.sample_time
    # An ECU checks its limits in every step, and its own units say what that takes.
    limited = 0.0 if by_ecu else expected.limited * steps
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
            "short steps": steps * _steps(scenario, strategy).short,
            "ECU entries": steps * checks * inputs,
            "ECU iterations": 0.5 * steps * checks * scenario.hil.iterations,
        }
    unknowns, solved = 2 * moves + 2, expected.solved * steps
    counts |= {
        "check entries": (1.3 * steps + 8 * limited) * checks * inputs,
        "QPs": solved,
        "QP entries": solved * unknowns * inputs,
    }
    if controller.solver == "osqp":
        counts["OSQP"] = solved * osqp_effort(expected.iterations, unknowns, 4 * horizon)
    return counts


def _steps(scenario: Scenario, strategy: type[Controller]) -> StepSizes:
    return step_sizes(scenario, strategy, speed_plan_on(strategy, scenario))


def _fine_step(scenario: Scenario, strategy: type[Controller]) -> float:
    return longest_fine_step(scenario, speed_plan_on(strategy, scenario), actuated=strategy.actuated)


def _fields(scenario: Scenario, strategy: type[Controller]) -> tuple[str, ...]:
    """Fields that make a run's steps fewer or cheaper."""
    fields: tuple[str, ...] = ("road.length", "speed.initial_speed_kmh")
    if speed_plan_on(strategy, scenario) == "planned":
        fields += ("speed.target_speed_kmh",)
    if strategy.actuated:
        fields += ("mpc.sample_time",)
    if issubclass(strategy, PredictiveController):
        fields += ("mpc.prediction_horizon", "mpc.control_horizon")
    return fields
