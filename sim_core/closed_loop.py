"""Controller and plant over a run's control steps: speculative blocks of the linear closed loop.

The half-car is linear and every controller is a linear law until a limit binds. So a block of control steps is
driven as if none did, accepted up to the first step at which one would, that step is decided exactly by the
controller, and so on. Only steps at a limit cost a call each (docs/decisions/0002-speculative-blocks.md).
"""

from dataclasses import dataclass

import numpy as np

from sim_core.controller import Controller, LinearLaw
from sim_core.half_car import FORCES, STATES
from sim_core.plant import Plant
from sim_core.result import FloatArray

_FIRST_BLOCK, _LONGEST_BLOCK, _BLOCK_AFTER_LIMIT = 64, 512, 4


@dataclass(frozen=True, slots=True, eq=False, kw_only=True)
class Course:
    """States at the control instants (steps, n), commands (steps, 2) [N], and in how many steps a limit bound."""

    states: FloatArray
    commands: FloatArray
    limited: int


def near_rest(plant: Plant, law: LinearLaw) -> FloatArray:
    """One control step of [plant state; previous command] while no limit binds (n + 2, n + 2)."""
    n = plant.size
    gain = np.zeros((FORCES, n + FORCES))
    gain[:, :STATES], gain[:, n:] = law.gain[:, :STATES], law.gain[:, STATES:]
    free = np.hstack([plant.A, np.zeros((n, FORCES))])
    return np.vstack([free + plant.B @ gain, gain])


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

    def run(self, stages: list[tuple[str, int, int]]) -> Course:
        """Drive the stages (name, first step, one past the last) from rest, without a command before the first."""
        plant, steps = self._plant, len(self._forcing)
        n = plant.size
        states, commands = np.empty((steps, n)), np.empty((steps, FORCES))
        state, previous, limited = np.zeros(n), np.zeros(FORCES), 0
        for stage, first, last in stages:
            law = self._controller.law(stage)
            feed, offsets = self._controller.ahead(stage, first, last)
            powers = self._powers(law)
            k, block = first, _FIRST_BLOCK
            while k < last:
                stop = min(k + block, last)
                here = slice(k - first, stop - first)
                z = self._speculate(powers, state, previous, feed[here], k)
                count = self._accepted(law, z, offsets[here])
                states[k : k + count], commands[k : k + count] = z[:count, :n], z[1 : count + 1, n:]
                state, previous = z[count, :n], z[count, n:]
                k += count
                block = min(2 * block, _LONGEST_BLOCK)
                if k < stop:
                    wanted = self._controller.step(k, stage, state[:STATES], previous)
                    change = np.clip(wanted - previous, -self._most_change, self._most_change)
                    given = np.where(change == wanted - previous, wanted, previous + change)
                    previous = np.clip(given, -self._most_force, self._most_force)
                    states[k], commands[k] = state, previous
                    state = plant.A @ state + plant.B @ previous + self._forcing[k]
                    limited, k, block = limited + 1, k + 1, _BLOCK_AFTER_LIMIT
        return Course(states=states, commands=commands, limited=limited)

    def _powers(self, law: LinearLaw) -> list[FloatArray]:
        """Powers 1, 2, 4, … of the closed loop over [plant state; previous command], transposed."""
        powers = [near_rest(self._plant, law).T]
        while 2 ** len(powers) <= _LONGEST_BLOCK:
            powers.append(powers[-1] @ powers[-1])
        return powers

    def _speculate(
        self, powers: list[FloatArray], state: FloatArray, previous: FloatArray, feed: FloatArray, k: int
    ) -> FloatArray:
        """[plant state; previous command] of a block as if no limit bound: row 0 is now, row i after i steps.

        z[i + 1] = M z[i] + f[i] for all i at once: prefix sums with doubling strides (Hillis and Steele 1986).
        """
        count, n = len(feed), self._plant.size
        z = np.empty((count + 1, n + FORCES))
        z[0, :n], z[0, n:] = state, previous
        z[1:, :n] = self._forcing[k : k + count] + feed @ self._plant.B.T
        z[1:, n:] = feed
        stride = 1
        for power in powers:
            if stride > count:
                break
            z[stride:] += z[:-stride] @ power
            stride *= 2
        return z

    def _accepted(self, law: LinearLaw, z: FloatArray, offsets: FloatArray) -> int:
        """How many steps of a speculated block no limit would have changed."""
        n = self._plant.size
        now = z[:-1]
        measured = now if n == STATES else np.hstack([now[:, :STATES], now[:, n:]])
        # `not <=` rather than `>`: a NaN must not pass. The margin keeps rounding from passing a limit.
        broken = ~(np.abs(measured @ law.checks.T + offsets) <= law.bounds * (1 - 1e-9)).all(axis=1)
        if np.isfinite(self._most_change):
            broken |= (np.abs(z[1:, n:] - now[:, n:]) > self._most_change).any(axis=1)
        if np.isfinite(self._most_force):
            broken |= (np.abs(z[1:, n:]) > self._most_force).any(axis=1)
        return int(broken.argmax()) if broken.any() else len(now)
