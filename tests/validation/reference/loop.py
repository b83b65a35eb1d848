"""The whole closed loop a second time, plainly: one control step after another, a QP in each, no shortcuts.

Taken from the core: the road's heights and the speed plan (both checked elsewhere). Everything vertical is the
reference's own: absolute coordinates, its own prediction, cost, Riccati solution and QP, which DAQP solves.
"""

from collections.abc import Callable
from dataclasses import dataclass
from math import ceil

import daqp
import numpy as np
from numpy.typing import NDArray

from sim_core import Scenario, StrategyResult
from sim_core.road.profile import road_profile
from sim_core.speed.profile import SpeedProfile
from tests.validation.reference.sampled import gauss, interval, mean_cost, regulator, weights
from tests.validation.reference.vehicle import StateSpace, behind, state_space

Array = NDArray[np.float64]
RUN_IN = 20.0  # the car starts in equilibrium this far behind the start [m]
KILO = 1000.0


class Predictor:
    """Stacked maps from (x, U, road heights, decelerations) to every interval's w = (x, u, z_start, z_end, a)."""

    def __init__(self, model: StateSpace, length: float, horizon: int, moves: int) -> None:
        step = interval(model, length, length).state
        self.horizon, self.moves = horizon, moves
        n = 8 + 2 * moves + 2 * (horizon + 1) + horizon
        U, Z, D = 8, 8 + 2 * moves, 8 + 2 * moves + 2 * (horizon + 1)
        x = np.eye(8, n)
        rows = []
        for i in range(horizon):
            w = np.zeros((15, n))
            w[:8] = x
            j = U + 2 * min(i, moves - 1)
            w[8:10, j : j + 2] = np.eye(2)
            w[10:14, Z + 2 * i : Z + 2 * i + 4] = np.eye(4)
            w[14, D + i] = 1
            rows.append(w)
            x = step @ w
        self.w, self.end = np.array(rows), x
        self.free = [*range(U), *range(Z, n)]
        self.forced = slice(U, Z)


class ReferenceMpc:
    """One stage's problem, set up as a dense QP in forces [kN] and slacks [cm] and solved from nothing each time."""

    def __init__(self, scenario: Scenario, predictor: Predictor, q: tuple[float, float, float]) -> None:
        car, mpc = scenario.vehicle, scenario.mpc
        model, self.predictor, self.mpc = state_space(car), predictor, mpc
        speed = scenario.speed.initial_speed_kmh / 3.6
        weight = weights(car, q, mpc.deflection_weight, mpc.deflection_limit, speed, behind(scenario))
        cost = mean_cost(model, weight, mpc.sample_time, mpc.force_weight, *gauss())
        P = regulator(model, cost, mpc.sample_time).P
        lever = np.array([[1, -car.cg_to_front], [1, car.cg_to_rear]])
        deflection_of = np.hstack([lever, -np.eye(2), np.zeros((2, 4))])

        # The end state is judged relative to the road there: everything lifted by the last heights.
        heights = np.zeros((2, predictor.end.shape[1]))
        last = 8 + 2 * predictor.moves + 2 * predictor.horizon
        heights[:, last : last + 2] = np.eye(2)
        end = predictor.end - np.vstack([np.linalg.solve(lever, heights), heights, np.zeros((4, heights.shape[1]))])

        quadratic = sum(w.T @ cost @ w for w in predictor.w) + end.T @ P @ end
        forced, free = predictor.forced, predictor.free
        n = 2 * predictor.moves
        change = np.eye(n) - np.eye(n, k=-2)
        self.to_newton = KILO
        self.H = np.zeros((n + 2, n + 2))
        self.H[:n, :n] = 2 * KILO**2 * (quadratic[forced, forced] + mpc.force_change_weight * change.T @ change)
        self.H[n:, n:] = 2 * 1e6 / 100**2 * np.eye(2)
        self.g_free = 2 * KILO * quadratic[forced, :][:, free]
        self.g_previous = -2 * KILO * mpc.force_change_weight * (change.T @ np.eye(n, 2))
        travel = [deflection_of @ w[:8] for w in [*predictor.w[1:], predictor.end]]
        rows = np.vstack([t[:, forced] * KILO * 100 for t in travel])
        self.travel_free = np.vstack([t[:, free] * 100 for t in travel])
        slack = -np.tile(np.eye(2), (predictor.horizon, 1))
        pick, none = np.eye(n), np.zeros((n, 2))
        self.A = np.block([[rows, slack], [-rows, slack], [pick, none], [-pick, none], [np.zeros((2, n)), -np.eye(2)]])

    def solve(self, x: Array, previous: Array, heights: Array, braking: Array) -> Array:
        """First force of the optimum [N]; the solver is asked where the unconstrained optimum is not allowed.

        heights: (Np + 1, 2), braking: (Np,).
        """
        inputs = np.concatenate([x, heights.ravel(), braking])
        n = 2 * self.predictor.moves
        g = np.concatenate([self.g_free @ inputs + self.g_previous @ previous, np.full(2, 1e5 / 100)])
        offset, limit = self.travel_free @ inputs, self.mpc.deflection_limit * 100
        force = np.full(n, self.mpc.force_limit / KILO)
        b = np.concatenate([limit - offset, limit + offset, force, force, np.zeros(2)])
        y = np.concatenate([np.linalg.solve(self.H[:n, :n], -g[:n]), np.zeros(2)])
        if not np.all(self.A @ y <= b):
            y, _, flag, _ = daqp.solve(self.H.copy(), g, self.A.copy(), b, np.full(len(b), -1e30), primal_tol=1e-10)
            assert flag == 1
        return y[:2] * KILO


@dataclass(frozen=True)
class Trace:
    """Times of the control instants [s], commands [N] there, and OUTPUTS on the fine grid with its times."""

    time: Array
    command: Array
    fine_time: Array
    output: Array


def drive(
    scenario: Scenario,
    result: StrategyResult,
    plan: SpeedProfile,
    stage_weights: Callable[[float], tuple[float, float, float]],
    *,
    law: str,
) -> Trace:
    """Drive the scenario by a speed plan, in the fine steps of `result`.

    stage_weights: q1-q3 at a front-axle position.
    law: 'mpc' or 'lqr' (whose weights come from the scenario).
    """
    car, mpc, actuator = scenario.vehicle, scenario.mpc, scenario.actuator
    model, surface = state_space(car), road_profile(scenario.road)
    distance, Ts = behind(scenario), mpc.sample_time
    h = result.series["time"][1] - result.series["time"][0]
    fine = round(Ts / h)
    corner = 2 * np.pi * (actuator.bandwidth or 0.0)
    small, read = interval(model, h, h, corner), interval(model, h, 0.0, corner).output
    most = np.inf if actuator.rate_limit is None else actuator.rate_limit * Ts

    def braking(time: Array) -> Array:
        return plan.sample(plan.braking, time)

    def heights(time: Array) -> Array:
        x = plan.at(time)[0]
        return np.stack([surface.height(x), surface.height(x - distance)], axis=-1)

    def seen(t: float) -> tuple[Array, Array]:
        horizon = np.asarray(t + Ts * np.arange(mpc.prediction_horizon + 1), dtype=np.float64)
        if mpc.preview == "lookahead":
            return heights(horizon), braking(horizon[:-1] + Ts / 2)
        level = np.tile(heights(np.array([t])), (len(horizon), 1))
        if mpc.preview == "wheelbase":
            (x,), (speed,) = plan.at(np.array([t]))
            distances = speed * (horizon - t)
            covered = distances[distances <= distance]
            rear = surface.height(x - distance + covered)
            level[:, 1] = rear[-1]
            level[: len(rear), 1] = rear
        return level, np.full(mpc.prediction_horizon, braking(np.array([t]))[0])

    if law == "lqr":
        weight = weights(
            car,
            scenario.lqr.weights,
            scenario.lqr.deflection_weight,
            mpc.deflection_limit,
            scenario.speed.initial_speed_kmh / 3.6,
            distance,
        )
        K = regulator(model, mean_cost(model, weight, Ts, mpc.force_weight, *gauss()), Ts).K
        lever = np.array([[1, -car.cg_to_front], [1, car.cg_to_rear]])
    predictor = Predictor(model, Ts, mpc.prediction_horizon, mpc.control_horizon)
    problems: dict[tuple[float, float, float], ReferenceMpc] = {}

    begin = -ceil(RUN_IN / (result.series["speed"][0] * Ts))
    finish = int(np.floor(result.series["time"][-1] / Ts))
    x, u, force, times, commands, outputs = np.zeros(8), np.zeros(2), np.zeros(2), [], [], []
    # In equilibrium on the road where it starts.
    start = heights(np.array([begin * Ts]))[0]
    x[:4] = [*np.linalg.solve([[1, -car.cg_to_front], [1, car.cg_to_rear]], start), *start]
    for k in range(begin, finish):
        t = k * Ts
        if law == "mpc":
            q = stage_weights(float(plan.at(np.array([t]))[0][0]))
            if q not in problems:
                problems[q] = ReferenceMpc(scenario, predictor, q)
            wanted = problems[q].solve(x, u, *seen(t))
        else:
            z = heights(np.array([t]))[0]
            wanted = -K @ (x - np.concatenate([np.linalg.solve(lever, z), z, np.zeros(4)]))
        wanted = np.clip(wanted, -mpc.force_limit, mpc.force_limit)
        u = u + np.clip(wanted - u, -most, most)
        moments = t + h * np.arange(fine + 1)
        z = heights(moments)
        a = braking(moments[:-1] + h / 2)
        for j in range(fine):
            actuation = (force, u) if corner else (u, u[:0])
            w = np.concatenate([x, actuation[0], z[j], z[j + 1], a[j : j + 1], actuation[1]])
            outputs.append(read @ w)
            x, force = small.state @ w, small.force @ w
        times.append(t)
        commands.append(u)
    fine_time = begin * Ts + h * np.arange(len(outputs))
    return Trace(time=np.array(times), command=np.array(commands), fine_time=fine_time, output=np.array(outputs))
