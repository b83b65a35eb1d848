"""Controller and plant over a run's control steps: speculative blocks of the linear closed loop.

Every controller is a linear law until a limit binds. So a block of control steps is
driven as if none did and accepted up to the first step at which one would; that step and those after it are decided
exactly by the controller until none binds any more, and so on (docs/decisions/0002-speculative-blocks.md).
"""

from dataclasses import dataclass

import numpy as np

from sim_core.arrays import BoolArray, FloatArray
from sim_core.control.controller import Controller
from sim_core.controllers import make_controller, make_filter, semi_active_dampers
from sim_core.loop.excitation import Excitation, under_axles
from sim_core.loop.recording import Recording
from sim_core.scenario import Actuator, Scenario
from sim_core.speed.profile import SpeedProfile
from sim_core.strategies import Strategy, SuspensionPolicy
from sim_core.vehicle.half_car import FORCES, STATES
from sim_core.vehicle.make import is_linear, make_vehicle
from sim_core.vehicle.model import VehicleModel

_LONGEST_BLOCK, _BLOCK_AFTER_LIMIT = 1024, 16  # control steps
_SAME_FORCE = 1e-6  # [N]: rounding


@dataclass(frozen=True, slots=True, eq=False, kw_only=True)
class Trajectory:
    """States at the control instants (steps, n), commands (steps, 2) [N], and in how many steps a limit bound."""

    states: FloatArray
    commands: FloatArray
    limited: int


class ClosedLoop:
    """One run's loop; the actuator changes a force by at most `most_change` a step and gives at most `most_force` [N].

    Both may be infinite. What it gives is the controller's previous command.
    """

    def __init__(
        self,
        controller: Controller,
        car: VehicleModel,
        most_change: float,
        most_force: float = np.inf,
    ) -> None:
        self._controller = controller
        self._car = car
        self._most_change = most_change
        self._most_force = most_force
        self._limited_actuator = most_change < np.inf or most_force < np.inf

    def run(self, stages: list[tuple[str, int, int]]) -> Trajectory:
        """Drive the stages (name, first step, one past the last) from rest, without a command before the first."""
        car, steps = self._car, stages[-1][2]
        n = car.size
        loop = np.zeros((steps + 1, n + FORCES))  # [plant state; previous command] at every control instant
        limited = 0
        for stage, first, last in stages:
            law, before = self._controller.law(stage), limited
            feed = self._controller.feed(stage, first, last)
            k, block = first, _LONGEST_BLOCK
            while k < last:
                stop = min(k + block, last)
                z = car.free_run(law, k, loop[k], feed[k - first : stop - first])
                free = self._free(stage, z, k)
                count = len(free) if free.all() else int(free.argmin())
                loop[k : k + count + 1] = z[: count + 1]
                k += count
                block, limit_binds = min(2 * block, _LONGEST_BLOCK), k < stop
                while limit_binds and k < last:
                    state, previous = loop[k, :n], loop[k, n:]
                    wanted, limit_binds = self._controller.step(k, stage, state[:STATES], previous)
                    command = self._actuated(wanted, previous)
                    limit_binds |= command is not wanted
                    loop[k + 1, :n] = car.advance(k, state, command)
                    loop[k + 1, n:] = command
                    limited, k, block = limited + limit_binds, k + 1, _BLOCK_AFTER_LIMIT
            if law.force_limit < np.inf:  # which the car may have met by itself
                wanted = loop[first:last, :STATES] @ law.gain[:, :STATES].T + feed
                limited = before + int(
                    (np.abs(loop[first + 1 : last + 1, n:] - wanted) > _SAME_FORCE).any(axis=1).sum()
                )
        return Trajectory(states=loop[:-1, :n], commands=loop[1:, n:], limited=limited)

    def _actuated(self, wanted: FloatArray, previous: FloatArray) -> FloatArray:
        """What the actuator gives after the previous command (2,) [N]: or `wanted` itself."""
        if not self._limited_actuator:
            return wanted
        change = np.clip(wanted - previous, -self._most_change, self._most_change)
        reached = np.where(change == wanted - previous, wanted, previous + change)
        command = np.clip(reached, -self._most_force, self._most_force)
        return wanted if np.array_equal(command, wanted) else command

    def _free(self, stage: str, z: FloatArray, k: int) -> BoolArray:
        """In which steps of a block speculated from step k on no limit binds (n,)."""
        n = self._car.size
        now, commands = z[:-1], z[1:, n:]
        measured = now if n == STATES else np.hstack([now[:, :STATES], now[:, n:]])
        free = self._controller.holds(k, stage, measured, commands)
        if self._limited_actuator:
            free &= (np.abs(commands - now[:, n:]) <= self._most_change).all(axis=1)
            free &= (np.abs(commands) <= self._most_force).all(axis=1)
        return free


def drive_controller(
    scenario: Scenario,
    strategy: Strategy,
    motion: SpeedProfile,
    excitation: Excitation,
    stages: list[tuple[str, int, int]],
) -> Recording:
    """Drive a strategy's controller over a road; `stages` as `segments` gives them.

    Raises:
        RidelabError: The vehicle and weights admit no stabilising controller.
    """
    passive = strategy.suspension is SuspensionPolicy.PASSIVE
    actuator = Actuator() if passive else scenario.actuator
    before = excitation.drive.before
    controller = make_controller(scenario, strategy, motion, excitation)
    dampers, disturbance = semi_active_dampers(scenario, strategy), excitation.disturbance
    estimator = make_filter(scenario, strategy.suspension, motion, excitation, disturbance)
    car = make_vehicle(
        *(scenario.real_vehicle, actuator, excitation.step, disturbance, before),
        estimator=estimator,
        dampers=dampers,
        road=None if is_linear(scenario.real_vehicle, dampers) else under_axles(excitation),
    )
    most_change = np.inf if actuator.rate_limit is None else actuator.rate_limit * excitation.step
    most_force = np.inf if actuator.saturation is None else actuator.saturation
    loop = ClosedLoop(controller, car, most_change, most_force)
    trajectory = loop.run(stages)
    return Recording(
        table=car.record(trajectory.states[before:], trajectory.commands[before:]),
        excitation=excitation,
        report=controller.report,
        limited=trajectory.limited,
    )
