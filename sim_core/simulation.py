"""simulate(scenario, strategy): the only time loop.

The half-car is linear and every controller is a linear law until a limit binds. So the loop drives the *linear*
closed loop over a block of control steps at once, accepts it up to the first step at which a limit would bind, lets
the controller decide that step exactly, and goes on (docs/decisions/0002-speculative-blocks.md). Between the control
instants the car is stepped exactly on a finer grid, on which the series and all metrics are taken.
"""

from dataclasses import dataclass
from math import ceil, pi

import numpy as np

from sim_core.controller import Controller, LinearLaw, PassiveController
from sim_core.cost import CostTerms
from sim_core.half_car import DISTURBANCES, FORCES, OUTPUTS, STATES, half_car, hold
from sim_core.longitudinal import CONTROL_STEP, KMH, Drive, drive, run_in_steps
from sim_core.lqr import LqrController, regulator
from sim_core.metrics import Recording, evaluate
from sim_core.mpc import Horizon, MpcController, design
from sim_core.preview import preview_windows
from sim_core.result import FloatArray, StrategyResult
from sim_core.road import RoadProfile, profile
from sim_core.scenario import Actuator, Scenario, Vehicle, Weights
from sim_core.stages import coordinated_weights, segments, spans
from sim_core.strategies import Strategy, SuspensionPolicy, strategy

FINEST, COARSEST = 5e-5, 1e-3  # bounds of the fine step [s]
_LONGEST_BLOCK = 512


@dataclass(frozen=True, slots=True, eq=False, kw_only=True)
class Grid:
    """Control instants [s] (steps + 1,), and how many fine steps lie in each control step."""

    time: FloatArray
    fine: int

    @property
    def step(self) -> float:
        """Control step [s]."""
        return float(self.time[1] - self.time[0])


@dataclass(frozen=True, slots=True, eq=False, kw_only=True)
class Plant:
    """The car with its actuators over one fine step: p' = A p + B u + E w, shapes (n, n), (n, 2), (n, 3).

    With a lagging actuator the two forces join the state (n = 10), else the command is the force (n = 8).
    """

    A: FloatArray
    B: FloatArray
    E: FloatArray
    lagging: bool


def simulate(scenario: Scenario, name: str) -> StrategyResult:
    """Drive one strategy over the scenario's road.

    Args:
        scenario: What to drive.
        name: Strategy id.

    Raises:
        UnknownNameError: No such strategy.
        RidelabError: The vehicle and weights admit no stabilising controller.
    """
    chosen = strategy(name)
    road, motion = profile(scenario.road), drive(scenario, chosen.speed)
    stages = spans(scenario, chosen, motion)
    grid = make_grid(scenario, chosen, motion)
    disturbance = _disturbances(scenario.vehicle, road, motion, grid)
    controller = _controller(scenario, chosen, road, motion, grid)
    actuator = scenario.actuator if chosen.suspension is not SuspensionPolicy.PASSIVE else Actuator()
    plant = make_plant(scenario.vehicle, actuator, grid.step / grid.fine)
    loop = ClosedLoop(controller, plant, grid, disturbance, actuator.rate_limit)
    states, commands, limited = loop.run(segments(stages, motion.at(grid.time[:-1])[0]))
    return evaluate(
        scenario,
        chosen,
        motion,
        stages,
        _record(scenario, road, motion, grid, plant, states, commands, disturbance),
        controller.report,
        limited,
    )


def make_grid(scenario: Scenario, chosen: Strategy, motion: Drive) -> Grid:
    """Control steps from the run-in to the road's end, and fine steps small enough for this car and bump.

    Fine steps: 60 over the bump at the fastest, 0.1 rad of the stiffest wheel mode, at most 1 ms.
    """
    step = CONTROL_STEP if chosen.suspension is SuspensionPolicy.PASSIVE else scenario.mpc.sample_time
    before = run_in_steps(motion.initial_speed, step)
    after = ceil(motion.time_at(scenario.road.length) / step - 1e-9)
    return Grid(time=step * np.arange(-before, after + 1), fine=ceil(step / fine_step(scenario) - 1e-9))


def fine_step(scenario: Scenario) -> float:
    """Longest fine step that resolves the scenario's bump and wheels [s]."""
    vehicle, bump = scenario.vehicle, scenario.road.bump
    fastest = max(
        (vehicle.front_tyre_stiffness + vehicle.front_spring) / vehicle.front_wheel_mass,
        (vehicle.rear_tyre_stiffness + vehicle.rear_spring) / vehicle.rear_wheel_mass,
    )
    over_bump = bump.width / (60 * scenario.speed.initial_speed_kmh * KMH) if bump.height else COARSEST
    return min(COARSEST, max(FINEST, min(0.1 / fastest**0.5, over_bump)))


def make_plant(vehicle: Vehicle, actuator: Actuator, step: float) -> Plant:
    """The exact fine step of car and actuators."""
    model = half_car(vehicle)
    A, inputs = model.A, np.hstack([model.B, model.E])
    lagging = actuator.bandwidth is not None
    if actuator.bandwidth is not None:  # u̇ = 2π f (command - u)
        corner = 2 * pi * actuator.bandwidth
        A = np.block([[model.A, model.B], [np.zeros((FORCES, STATES)), -corner * np.eye(FORCES)]])
        command = np.vstack([np.zeros((STATES, FORCES)), corner * np.eye(FORCES)])
        inputs = np.hstack([command, np.vstack([model.E, np.zeros((FORCES, DISTURBANCES))])])
    A, inputs = hold(A, inputs, step)
    return Plant(A=A, B=inputs[:, :FORCES], E=inputs[:, FORCES:], lagging=lagging)


def _disturbances(vehicle: Vehicle, road: RoadProfile, motion: Drive, grid: Grid) -> FloatArray:
    """Road velocities of both axles and braking, held over each fine step; shape (steps, fine, 3)."""
    steps, h = len(grid.time) - 1, grid.step / grid.fine
    fine_time = grid.time[0] + h * np.arange(steps * grid.fine + 1)
    position, _ = motion.at(fine_time)
    columns = [np.diff(road.height(position - behind)) / h for behind in (0.0, vehicle.wheelbase)]
    columns.append(motion.sample(motion.braking, fine_time[:-1] + h / 2))
    return np.stack(columns, axis=-1).reshape(steps, grid.fine, DISTURBANCES)


def _controller(scenario: Scenario, chosen: Strategy, road: RoadProfile, motion: Drive, grid: Grid) -> Controller:
    """The strategy's controller for this run."""
    if chosen.suspension is SuspensionPolicy.PASSIVE:
        return PassiveController()
    mpc, vehicle = scenario.mpc, scenario.vehicle

    def terms(weights: Weights, deflection_weight: float) -> CostTerms:
        return CostTerms(
            vehicle=vehicle,
            speed=motion.initial_speed,
            sample_time=mpc.sample_time,
            weights=weights,
            deflection_weight=deflection_weight,
            deflection_limit=mpc.deflection_limit,
            force_weight=mpc.force_weight,
        )

    if chosen.suspension is SuspensionPolicy.LQR:
        return LqrController(regulator(terms(scenario.lqr.weights, scenario.lqr.deflection_weight)), mpc.force_limit)
    horizon = Horizon(
        prediction=mpc.prediction_horizon,
        control=mpc.control_horizon,
        force_limit=mpc.force_limit,
        force_change_weight=mpc.force_change_weight,
    )
    designs = {
        stage: design(terms(coordinated_weights(scenario, chosen, stage), mpc.deflection_weight), horizon)
        for stage in ("cruise", "brake", "bump")
    }
    windows = preview_windows(mpc.preview, road, motion, grid.time, mpc.prediction_horizon, vehicle.wheelbase)
    return MpcController(designs, windows, mpc)


class ClosedLoop:
    """Controller and plant over the control steps of one run."""

    def __init__(
        self,
        controller: Controller,
        plant: Plant,
        grid: Grid,
        disturbance: FloatArray,
        rate_limit: float | None,
    ) -> None:
        self._controller = controller
        self._size = len(plant.A)
        self._most_change = np.inf if rate_limit is None else rate_limit * grid.step
        self._A = np.linalg.matrix_power(plant.A, grid.fine)
        _, end = march(plant, np.zeros((len(disturbance), self._size)), None, disturbance)
        self._forcing = end
        self._B = np.zeros((self._size, FORCES))
        for _ in range(grid.fine):
            self._B = plant.A @ self._B + plant.B

    def run(self, stages: list[tuple[str, int, int]]) -> tuple[FloatArray, FloatArray, int]:
        """States at the control instants (steps, n), commands (steps, 2) [N], and steps in which a limit bound."""
        steps = len(self._forcing)
        states, commands = np.empty((steps, self._size)), np.empty((steps, FORCES))
        state, previous, limited = np.zeros(self._size), np.zeros(FORCES), 0
        for stage, first, last in stages:
            law = self._controller.law(stage)
            feed, offsets = self._controller.ahead(stage, first, last)
            powers = self._powers(law)
            k, block = first, 64
            while k < last:
                stop = min(k + block, last)
                here = slice(k - first, stop - first)
                z = self._speculate(law, powers, state, previous, feed[here], k)
                count, u = self._accept(law, z, feed[here], offsets[here])
                states[k : k + count], commands[k : k + count] = z[:count, : self._size], u[:count]
                block = min(2 * block, _LONGEST_BLOCK)
                if count:
                    k += count
                    state, previous = z[count, : self._size], u[count - 1]
                if k < stop:
                    states[k] = state
                    command = self._controller.step(k, stage, state[:STATES], previous)
                    commands[k] = previous = previous + np.clip(
                        command - previous, -self._most_change, self._most_change
                    )
                    state = self._A @ state + self._B @ previous + self._forcing[k]
                    limited, k, block = limited + 1, k + 1, 4
        return states, commands, limited

    def _powers(self, law: LinearLaw) -> list[FloatArray]:
        """Transposed powers 1, 2, 4, … of the closed loop over [state; previous command]."""
        n = self._size
        gain = np.zeros((FORCES, n + FORCES))
        gain[:, :STATES], gain[:, n:] = law.gain[:, :STATES], law.gain[:, STATES:]
        loop = np.vstack([np.hstack([self._A, np.zeros((n, FORCES))]) + self._B @ gain, gain]).T
        powers = [loop]
        while 2 ** len(powers) <= _LONGEST_BLOCK:
            powers.append(powers[-1] @ powers[-1])
        return powers

    def _speculate(
        self,
        law: LinearLaw,
        powers: list[FloatArray],
        state: FloatArray,
        previous: FloatArray,
        feed: FloatArray,
        k: int,
    ) -> FloatArray:
        """[state; previous command] of a block as if no limit bound: rows 0 to count, row 0 is now.

        z[i + 1] = M z[i] + f[i] for all i at once by a prefix sum with doubling strides (Hillis and Steele 1986).
        """
        count, n = len(feed), self._size
        z = np.empty((count + 1, n + FORCES))
        z[0, :n], z[0, n:] = state, previous
        z[1:, :n] = self._forcing[k : k + count] + feed @ self._B.T
        z[1:, n:] = feed
        stride = 1
        for power in powers:
            if stride > count:
                break
            z[stride:] += z[:-stride] @ power
            stride *= 2
        return z

    def _accept(self, law: LinearLaw, z: FloatArray, feed: FloatArray, offsets: FloatArray) -> tuple[int, FloatArray]:
        """How many steps of a speculated block hold, and the block's commands."""
        n = self._size
        measured = z[:-1] if n == STATES else np.hstack([z[:-1, :STATES], z[:-1, n:]])
        u = z[1:, n:]
        broken = (np.abs(measured @ law.checks.T + offsets) > law.bounds).any(axis=1)
        if np.isfinite(self._most_change):
            broken |= (np.abs(u - z[:-1, n:]) > self._most_change).any(axis=1)
        return (int(broken.argmax()) if broken.any() else len(feed)), u


def march(
    plant: Plant, states: FloatArray, commands: FloatArray | None, disturbance: FloatArray
) -> tuple[FloatArray, FloatArray]:
    """Step every control interval through its fine steps, all intervals at once.

    Args:
        plant: The fine step.
        states: At the start of each interval (steps, n).
        commands: Held in each interval (steps, 2) [N], or None for none.
        disturbance: (steps, fine, 3).

    Returns:
        States at the start of each fine step (steps, fine, n), and at the end of each interval (steps, n).
    """
    fine = disturbance.shape[1]
    path = np.empty((len(states), fine, len(plant.A)))
    pushed = disturbance @ plant.E.T
    if commands is not None:
        pushed += (commands @ plant.B.T)[:, None, :]
    for j in range(fine):
        path[:, j] = states
        states = states @ plant.A.T + pushed[:, j]
    return path, states


def _record(
    scenario: Scenario,
    road: RoadProfile,
    motion: Drive,
    grid: Grid,
    plant: Plant,
    states: FloatArray,
    commands: FloatArray,
    disturbance: FloatArray,
) -> Recording:
    """Series on the fine grid from x = 0 to the road's end."""
    path, _ = march(plant, states, commands, disturbance)
    forces = path[:, :, STATES:] if plant.lagging else np.broadcast_to(commands[:, None], (*path.shape[:2], FORCES))
    model = half_car(scenario.vehicle)
    outputs = path[:, :, :STATES] @ model.C.T + forces @ model.D.T + disturbance @ model.F.T

    steps, h = len(commands), grid.step / grid.fine
    time = grid.time[0] + h * np.arange(steps * grid.fine)
    first = -round(grid.time[0] / grid.step) * grid.fine
    last = first + int(motion.time_at(scenario.road.length) / h + 1e-6) + 1
    kept = slice(first, last)
    time = time[kept]
    time[0] = 0.0
    position, speed = motion.at(time)
    flat = outputs.reshape(-1, len(OUTPUTS))[kept].T
    force = forces.reshape(-1, FORCES)[kept].T
    return Recording(
        step=h,
        series={
            "time": time,
            "position": position,
            "speed": speed,
            "front_road": road.height(position),
            "rear_road": road.height(position - scenario.vehicle.wheelbase),
            "brake_pressure": motion.sample(motion.pressure, time),
            "brake_deceleration": motion.sample(motion.braking, time),
            **{name: flat[i] for i, name in enumerate(OUTPUTS[:6])},
            "front_force": force[0],
            "rear_force": force[1],
        },
        deflection_speed=flat[6:],
    )
