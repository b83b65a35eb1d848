"""Controller and plant over a run's control steps: speculative blocks of the linear closed loop.

The half-car is linear and every controller is a linear law until a limit binds. So a block of control steps is
driven as if none did and accepted up to the first step at which one would; that step and those after it are decided
exactly by the controller until none binds any more, and so on (docs/decisions/0002-speculative-blocks.md).
"""

from dataclasses import dataclass

import numpy as np

from sim_core.arrays import BoolArray, FloatArray
from sim_core.caching import cached
from sim_core.car.half_car import FORCES, STATES
from sim_core.car.plant import Plant, plant
from sim_core.control.controller import Controller, LinearLaw
from sim_core.controllers import make_controller
from sim_core.drive.sampling import RoadInput
from sim_core.drive.speed_profile import Drive
from sim_core.recording import Recording
from sim_core.recurrence import Recurrence, recurrence
from sim_core.scenario import Actuator, Scenario
from sim_core.strategies import Strategy, SuspensionPolicy

_LONGEST_BLOCK, _BLOCK_AFTER_LIMIT = 1024, 16


@dataclass(frozen=True, slots=True, eq=False, kw_only=True)
class Trajectory:
    """States at the control instants (steps, n), commands (steps, 2) [N], and in how many steps a limit bound."""

    states: FloatArray
    commands: FloatArray
    limited: int


def closed_loop_matrix(plant: Plant, law: LinearLaw) -> FloatArray:
    """One control step of [plant state; previous command] while no limit binds (n + 2, n + 2)."""
    n = plant.size
    gain = np.zeros((FORCES, n + FORCES))
    gain[:, :STATES], gain[:, n:] = law.gain[:, :STATES], law.gain[:, STATES:]
    free = np.hstack([plant.A, np.zeros((n, FORCES))])
    return np.vstack([free + plant.B @ gain, gain])


@cached
def _free_run(plant: Plant, law: LinearLaw) -> Recurrence:
    """The loop over a block while no limit binds."""
    return recurrence(closed_loop_matrix(plant, law), _LONGEST_BLOCK)


class ClosedLoop:
    """One run's loop; the actuator changes a force by at most `most_change` a step and gives at most `most_force` [N].

    Both may be infinite. What it gives is what the controller is told as its previous command.
    """

    def __init__(
        self,
        controller: Controller,
        plant: Plant,
        forcing: FloatArray,
        most_change: float,
        most_force: float = np.inf,
    ) -> None:
        self._controller = controller
        self._plant = plant
        self._forcing = forcing
        self._most_change = most_change
        self._most_force = most_force
        self._limited_actuator = most_change < np.inf or most_force < np.inf

    def run(self, stages: list[tuple[str, int, int]]) -> Trajectory:
        """Drive the stages (name, first step, one past the last) from rest, without a command before the first."""
        plant, steps = self._plant, len(self._forcing)
        n = plant.size
        loop = np.zeros((steps + 1, n + FORCES))  # [plant state; previous command] at every control instant
        limited = 0
        for stage, first, last in stages:
            law = self._controller.law(stage)
            feed = self._controller.feed(stage, first, last)
            inputs = np.hstack([self._forcing[first:last] + feed @ plant.B.T, feed])
            free_run = _free_run(plant, law)
            k, block = first, _LONGEST_BLOCK
            while k < last:
                stop = min(k + block, last)
                z = free_run.run(loop[k], inputs[k - first : stop - first])
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
                    loop[k + 1, :n] = plant.A @ state + plant.B @ command + self._forcing[k]
                    loop[k + 1, n:] = command
                    limited, k, block = limited + limit_binds, k + 1, _BLOCK_AFTER_LIMIT
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
        n = self._plant.size
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
    motion: Drive,
    road_input: RoadInput,
    stages: list[tuple[str, int, int]],
) -> Recording:
    """Drive a strategy's controller over a road; `stages` as `segments` gives them.

    Raises:
        RidelabError: The vehicle and weights admit no stabilising controller.
    """
    actuator = Actuator() if strategy.suspension is SuspensionPolicy.PASSIVE else scenario.actuator
    car = plant(scenario.real_vehicle, actuator, road_input.step, road_input.fine)
    controller = make_controller(scenario, strategy, motion, road_input)
    most_change = np.inf if actuator.rate_limit is None else actuator.rate_limit * road_input.step
    most_force = np.inf if actuator.saturation is None else actuator.saturation
    loop = ClosedLoop(controller, car, road_input.disturbance @ car.E, most_change, most_force)
    trajectory = loop.run(stages)
    from_start = slice(road_input.drive.before, None)
    return Recording(
        table=car.record(
            trajectory.states[from_start], trajectory.commands[from_start], road_input.disturbance[from_start]
        ),
        road_input=road_input,
        report=controller.report,
        limited=trajectory.limited,
    )
