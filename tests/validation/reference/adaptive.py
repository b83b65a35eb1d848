"""Cars with unequal dampers, stops and tyres that lift off, in absolute coordinates and by SciPy's adaptive solver.

Newton's second law for bodies and wheels with the forces as they are, integrated by RK45 from control instant to
control instant, all cars at once; taken from the core are the road's heights, the speed plan and the commands.
"""

from collections.abc import Sequence
from dataclasses import dataclass
from unittest.mock import patch

import numpy as np
from numpy.typing import NDArray
from scipy.integrate import solve_ivp

from sim_core import DampingController
from sim_core.loop.closed_loop import ClosedLoop, Trajectory
from sim_core.result import StrategyResult
from sim_core.road.profile import profile
from sim_core.scenario import Scenario
from sim_core.simulate import simulate
from sim_core.speed.profile import CONTROL_STEP, plan_speed
from sim_core.speed.stages import Segment
from sim_core.strategies import strategy_named
from tests.validation.reference.held import Held, run_in
from tests.validation.reference.vehicle import OUTPUTS

Array = NDArray[np.float64]
SAMPLES = 200  # in a control step
TOLERANCE = 1e-5  # relative, of the solver; a tenth of it moves no metric of the tests by 0.03 %
NAMES = (*OUTPUTS, "front_force", "rear_force")


@dataclass(frozen=True)
class AdaptiveRun:
    """A strategy's run: the core's result, and its states and commands at the control instants."""

    scenario: Scenario
    result: StrategyResult
    trajectory: Trajectory

    @property
    def commands(self) -> Array:
        """(steps, 2) [N]."""
        return self.trajectory.commands


def run(scenario: Scenario, name: str) -> AdaptiveRun:
    """Drive it by the core."""
    caught: list[Trajectory] = []
    drive_loop = ClosedLoop.run

    def caught_run(self: ClosedLoop, stages: Sequence[Segment]) -> Trajectory:
        caught.append(drive_loop(self, stages))
        return caught[-1]

    with patch.object(ClosedLoop, "run", caught_run):
        return AdaptiveRun(scenario, simulate(scenario, name), caught[0])


def errors(runs: list[AdaptiveRun]) -> list[dict[str, float]]:
    """How far each RMS value and peak of the core is from the solver's, relative.

    All runs at one constant speed, of one length and with control steps of `CONTROL_STEP`.
    """
    relative_errors = []
    for run, theirs in zip(runs, _solved(runs), strict=True):
        ours = {
            f"{window}.{signal}.{statistic}": value
            for window, signals in run.result.metrics.items()
            for signal, statistics in signals.items()
            for statistic, value in statistics.items()
        }
        relative_errors.append({key: ours[key] / theirs[key] - 1 for key in ours if abs(theirs[key]) > 1e-9})
    return relative_errors


class Cars:
    """The cars' forces; every array has a column a car, pairs are front and rear (2, cars).

    `semi_active` says for each whether its dampers are, `most_force` what these add or take at most [N].
    """

    def __init__(self, runs: list[AdaptiveRun], corner: list[float]) -> None:
        cars = [run.scenario.real_vehicle for run in runs]

        def pair(name: str) -> Array:
            return np.array([[getattr(car, f"{axle}_{name}") for car in cars] for axle in ("front", "rear")])

        self.arm = np.array([[-car.cg_to_front for car in cars], [car.cg_to_rear for car in cars]])
        self.mass, self.inertia = (
            np.array([getattr(car, name) for car in cars]) for name in ("body_mass", "pitch_inertia")
        )
        self.wheel_mass, self.spring, self.tyre = pair("wheel_mass"), pair("spring"), pair("tyre_stiffness")
        ratio = np.array([car.rebound_ratio for car in cars])
        self.compression, self.rebound = pair("damping") * 2 / (1 + ratio), pair("damping") * 2 * ratio / (1 + ratio)
        self.clearance = np.array([car.bump_stop_clearance or np.inf for car in cars])
        self.stop = np.array([car.bump_stop_stiffness for car in cars])
        weight = self.mass * 9.80665 * np.abs(self.arm[::-1]) / np.abs(self.arm).sum(axis=0)
        lifts = np.array([car.tyre_lift_off for car in cars])
        self.lowest = np.where(lifts, -weight - self.wheel_mass * 9.80665, -np.inf)
        self.brake = np.array([car.body_mass * car.cg_height for car in cars])
        self.corner = np.array(corner)
        hooks = [run.scenario.hook for run in runs]
        laws = [strategy_named(run.result.strategy) for run in runs]
        damped = [issubclass(law, DampingController) for law in laws]
        self.semi_active = np.array([h.semi_active and each for h, each in zip(hooks, damped, strict=True)])
        self.most_force = np.array([run.scenario.mpc.force_limit for run in runs])
        self.least = np.array([hook.min_damping for hook in hooks])
        # Without a limit a damper that would stop its wheel within a millisecond.
        self.most = np.array([hook.max_damping or np.nan for hook in hooks]) * np.ones((2, 1))
        self.most = np.where(np.isnan(self.most), self.wheel_mass / 1e-3, self.most)

    def control(self, x: Array, speed: Array, asked: Array) -> Array:
        """Force that control adds [N]: the actuators' state (2, …, cars), or what semi-active dampers make of it.

        A lagging semi-active damper's state is not a force but what it adds to the coefficient.
        """
        shape = (2, *[1] * (x.ndim - 2), -1)
        passive = np.where(speed > 0, self.rebound.reshape(shape), self.compression.reshape(shape))
        lagging = -np.clip(asked * speed, -self.most_force, self.most_force)
        ends = self.least * speed, self.most.reshape(shape) * speed
        whole = passive * speed - np.where(self.corner > 0, lagging, asked)
        whole = np.clip(whole, np.minimum(*ends), np.maximum(*ends))
        return np.where(self.semi_active, passive * speed - whole, asked)

    def lag(self, x: Array, speed: Array, command: Array) -> Array:
        """Rate of the actuators' state."""
        shape = (2, *[1] * (x.ndim - 2), -1)
        passive = np.where(speed > 0, self.rebound.reshape(shape), self.compression.reshape(shape))
        added = -command / np.where(speed == 0, np.inf, speed)
        added = np.clip(added, self.least - passive, self.most.reshape(shape) - passive)
        return np.asarray(self.corner * (np.where(self.semi_active, added, command) - x[8:]))

    def forces(self, x: Array, road: Array) -> tuple[Array, Array, Array, Array]:
        """Travel [m], its speed [m/s], force between body and wheel without the actuator's, dynamic tyre load [N].

        Args:
            x: Body, pitch, wheels, their speeds, actuator forces (10, …, cars).
            road: Heights under the axles (2, …, cars) [m].
        """
        arm, shape = self.arm, (2, *[1] * (x.ndim - 2), -1)
        arm = arm.reshape(shape)
        travel, speed = x[0] + arm * x[1] - x[2:4], x[4] + arm * x[5] - x[6:8]
        damping = np.where(speed > 0, self.rebound.reshape(shape), self.compression.reshape(shape))
        beyond = np.maximum(np.abs(travel) - self.clearance, 0) * np.sign(travel)
        force = self.spring.reshape(shape) * travel + damping * speed + self.stop * beyond
        load = np.maximum(self.tyre.reshape(shape) * (road - x[2:4]), self.lowest.reshape(shape))
        return travel, speed, force, load

    def slope(self, x: Array, road: Array, braking: float, command: Array) -> Array:
        """Time derivative of x (10, …, cars)."""
        shape = (2, *[1] * (x.ndim - 2), -1)
        _, speed, force, load = self.forces(x, road)
        net = force - self.control(x, speed, x[8:])
        pitch = (self.brake * braking - (self.arm.reshape(shape) * net).sum(axis=0)) / self.inertia
        body = -net.sum(axis=0) / self.mass
        wheels = (load + net) / self.wheel_mass.reshape(shape)
        return np.concatenate([x[4:8], body[None], pitch[None], wheels, self.lag(x, speed, command)])


def _solved(runs: list[AdaptiveRun]) -> list[dict[str, float]]:
    motion = plan_speed(runs[0].scenario, "constant")
    steps, n, h = len(runs[0].commands), len(runs), CONTROL_STEP / SAMPLES
    time = CONTROL_STEP * (np.arange(steps)[:, None] - run_in(runs[0].scenario, motion, CONTROL_STEP))
    time = time + h * np.arange(SAMPLES + 1, dtype=np.float64)
    position = motion.at(time)[0]
    roads = np.empty((steps, 2, SAMPLES + 1, n))
    for i, run in enumerate(runs):
        for axle, behind in enumerate((0.0, run.scenario.vehicle.cg_to_front + run.scenario.vehicle.cg_to_rear)):
            roads[:, axle, :, i] = profile(run.scenario.road).height(position - behind)
    commands = np.stack([run.commands.T for run in runs], axis=-1)  # (2, steps, cars)
    bandwidths = [run.scenario.actuator.bandwidth if run.commands.any() else None for run in runs]
    cars = Cars(runs, [2 * np.pi * (each or 0.0) for each in bandwidths])
    ideal = cars.corner == 0

    x = np.zeros((10, n))
    x[2:4] = roads[0, :, 0]
    x[1] = (x[3] - x[2]) / (cars.arm[1] - cars.arm[0])
    x[0] = x[2] - cars.arm[0] * x[1]
    values = np.empty((steps, len(NAMES) + 2, SAMPLES + 1, n))
    for k in range(steps):
        command = commands[:, k]
        x[8:, ideal] = command[:, ideal]

        def slope(t: float, flat: Array, road: Array = roads[k], command: Array = command) -> Array:
            j = min(int(t / h), SAMPLES - 1)
            share = t / h - j
            return cars.slope(
                flat.reshape(10, n), (1 - share) * road[:, j] + share * road[:, j + 1], 0.0, command
            ).ravel()

        solved = solve_ivp(
            *(slope, (0, CONTROL_STEP), x.ravel(), "RK45", h * np.arange(SAMPLES + 1)),
            rtol=TOLERANCE,
            atol=TOLERANCE / 100,
            max_step=1e-3,
        )
        states = np.moveaxis(solved.y.reshape(10, n, -1), 1, 2)  # (10, samples, cars)
        travel, speed, _, load = cars.forces(states, roads[k])
        rates = cars.slope(states, roads[k], 0.0, command[:, None])
        values[k] = np.concatenate([rates[4:6], load, travel, cars.control(states, speed, states[8:]), speed])
        x = states[:, -1].copy()
    seen = time[:, 0] >= -1e-9
    metrics_by_run = []
    for i, run in enumerate(runs):
        signals = {name: values[seen, row, :, i] for row, name in enumerate(NAMES)}
        held = Held(time=time[seen], signals=signals, speed=(values[seen, -2, :, i], values[seen, -1, :, i]))
        metrics = held.metrics(run.scenario, motion)
        metrics_by_run.append({key: value for key, value in metrics.items() if not key.startswith("comfort")})
    return metrics_by_run
