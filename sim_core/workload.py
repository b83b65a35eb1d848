"""What a run will cost, told from the scenario alone, so that a service can refuse it before starting."""

from sim_core.drive.sampling import fine_step
from sim_core.drive.speed_profile import CONTROL_STEP, KMH, TARGET_BAND
from sim_core.ecu.loop import short_steps
from sim_core.scenario import Scenario
from sim_core.strategies import SpeedPolicy, SuspensionPolicy, strategy_named

# Seconds of one core, rounded up from `make bench`; coefficients of a worst case, not of a typical run.
_START = 0.005
_PER_PLAN_STEP = 3e-6
_PER_FINE_STEP = 4e-7
_PER_PREDICTED_NUMBER = 1e-9  # control step × checked row × preview column
_PER_QP = {"daqp": 1e-4, "osqp": 4e-3}  # at 20 moves and 30 steps; grows as below
_PER_LIMITED_STEP = 1e-4  # decided singly, without a QP
_START_ECU = 0.1  # its process, and the tables for it
_PER_EXCHANGE = 2e-4  # a frame to the ECU and its answer back
_PER_SHORT_STEP = 1e-5
_PER_ITERATED_ROW = 3e-8  # solver iteration × checked row
_PER_NOISE = 3e-8


def duration(scenario: Scenario, name: str) -> float:
    """Longest time the strategy can take from x = 0 to the road's end [s]."""
    speed, road = scenario.speed, scenario.road
    initial = speed.initial_speed_kmh * KMH
    if strategy_named(name).speed is SpeedPolicy.CONSTANT:
        return road.length / initial
    slowest = min(initial, speed.target_speed_kmh * KMH) - TARGET_BAND
    detection = max(0.0, road.bump.start - speed.detection_distance)
    return detection / initial + (road.length - detection) / slowest


def estimate(scenario: Scenario, name: str) -> float:
    """Upper estimate of one strategy's cost [s of one core].

    Raises:
        UnknownNameError: No such strategy.
    """
    chosen, mpc, time = strategy_named(name), scenario.mpc, duration(scenario, name)
    cost = _START + time / fine_step(scenario, chosen) * _PER_FINE_STEP
    if chosen.speed is SpeedPolicy.PLANNED:
        cost += time / CONTROL_STEP * _PER_PLAN_STEP
    if chosen.suspension is SuspensionPolicy.LQR:
        cost += time / mpc.sample_time * _PER_LIMITED_STEP
    if chosen.suspension in (SuspensionPolicy.MPC_BY_ROAD, SuspensionPolicy.MPC_BY_STAGE):
        steps = time / mpc.sample_time
        rows, columns = 2 * (mpc.control_horizon + mpc.prediction_horizon), 3 * mpc.prediction_horizon + 10
        longer, further = max(1.0, mpc.control_horizon / 20), max(1.0, mpc.prediction_horizon / 30)
        qp = _PER_QP[mpc.solver] * longer**1.5 * further**0.75
        cost += steps * (rows * columns * _PER_PREDICTED_NUMBER + qp)  # as if a limit bound in every step
    if chosen.suspension is SuspensionPolicy.ECU:
        steps = time / mpc.sample_time
        rows, columns = 2 * (mpc.control_horizon + mpc.prediction_horizon), 3 * mpc.prediction_horizon + 10
        each = _PER_EXCHANGE + _PER_SHORT_STEP * short_steps(mpc.sample_time) + rows * columns * _PER_PREDICTED_NUMBER
        each += scenario.hil.iterations * rows * _PER_ITERATED_ROW
        if scenario.hil.noise:
            each += columns * _PER_NOISE
        cost += _START_ECU + steps * each
    return cost
