"""The linear car on its road: its steps are exact, and many of them are one matrix product.

See docs/decisions/0002-speculative-blocks.md.
"""

import numpy as np

from sim_core.arrays import FloatArray
from sim_core.caching import cached
from sim_core.car.driven_car import DrivenCar, LinearLaw
from sim_core.car.half_car import FORCES, STATES
from sim_core.car.plant import Plant
from sim_core.recurrence import Recurrence, recurrence

LONGEST_RUN = 1024  # control steps in one `free_run`


def closed_loop_matrix(plant: Plant, law: LinearLaw) -> FloatArray:
    """One control step of [plant state; previous command] while no limit binds (n + 2, n + 2)."""
    n = plant.size
    gain = np.zeros((FORCES, n + FORCES))
    gain[:, :STATES], gain[:, n:] = law.gain[:, :STATES], law.gain[:, STATES:]
    free = np.hstack([plant.A, np.zeros((n, FORCES))])
    return np.vstack([free + plant.B @ gain, gain])


@cached
def _block(plant: Plant, law: LinearLaw) -> Recurrence:
    return recurrence(closed_loop_matrix(plant, law), LONGEST_RUN)


class LinearCar(DrivenCar):
    """A linear car on its road, `disturbance` and `before` being as in `on_road`."""

    def __init__(self, plant: Plant, disturbance: FloatArray, before: int) -> None:
        self.size = plant.size
        self._plant = plant
        self._disturbance = disturbance
        self._before = before
        self._forcing = disturbance @ plant.E

    def free_run(self, law: LinearLaw, first: int, start: FloatArray, feed: FloatArray) -> FloatArray:
        """As DrivenCar says."""
        forcing = self._forcing[first : first + len(feed)] + feed @ self._plant.B.T
        return _block(self._plant, law).run(start, np.hstack([forcing, feed]))

    def advance(self, step: int, state: FloatArray, command: FloatArray) -> FloatArray:
        """As DrivenCar says."""
        return np.asarray(self._plant.A @ state + self._plant.B @ command + self._forcing[step])

    def record(self, states: FloatArray, commands: FloatArray) -> FloatArray:
        """As DrivenCar says."""
        return self._plant.record(states, commands, self._disturbance[self._before :])
