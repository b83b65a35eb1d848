"""What every suspension controller is: a linear law while no limit binds, and an exact step where one does.

That split is what makes a run fast: the simulation drives the linear closed loop over many steps at once, looks
where the law stops being valid, and asks the controller only there (docs/decisions/0002-speculative-blocks.md).
"""

from abc import ABC, abstractmethod
from dataclasses import dataclass

import numpy as np

from sim_core.arrays import BoolArray, FloatArray
from sim_core.vehicle.half_car import FORCES
from sim_core.vehicle.model import LAW_INPUTS, LinearLaw

WITHIN = 1 - 1e-9  # of a limit: so that rounding does not pass it


@dataclass(slots=True)
class SolverReport:
    """What a controller's QPs came to in a run; the one thing about it that changes."""

    solves: int = 0
    fallbacks: int = 0
    failures: int = 0
    max_slack: float = 0.0  # [m]


class Controller(ABC):
    """One run's suspension controller; its memory is the previous command, which the caller keeps."""

    def __init__(self) -> None:
        self.report = SolverReport()

    @abstractmethod
    def law(self, stage: str) -> LinearLaw:
        """The law of a driving stage while no limit binds."""

    def feed(self, stage: str, first: int, last: int) -> FloatArray:
        """What preview adds to the law's force in control steps first to last - 1 of a stage (n, 2) [N]."""
        return np.zeros((last - first, FORCES))

    @abstractmethod
    def holds(self, first: int, stage: str, measured: FloatArray, commands: FloatArray) -> BoolArray:
        """In which of some control steps the law is exact, because no limit binds (n,).

        Args:
            first: Index of the first of them.
            stage: Driving stage.
            measured: What the law multiplied in each (n, 10).
            commands: What it gave (n, 2) [N].
        """

    @abstractmethod
    def step(self, step: int, stage: str, state: FloatArray, previous: FloatArray) -> tuple[FloatArray, bool]:
        """The command (2,) [N] of one control step, limits included, and whether one of them binds.

        Args:
            step: Index of the control step.
            stage: Driving stage.
            state: Measured state (8,).
            previous: Previous command (2,) [N].
        """


_NO_FORCE = LinearLaw(gain=np.zeros((FORCES, LAW_INPUTS)))


class PassiveController(Controller):
    """No force, ever."""

    def law(self, stage: str) -> LinearLaw:
        """Zero."""
        return _NO_FORCE

    def holds(self, first: int, stage: str, measured: FloatArray, commands: FloatArray) -> BoolArray:
        """Always."""
        return np.ones(len(commands), dtype=np.bool_)

    def step(self, step: int, stage: str, state: FloatArray, previous: FloatArray) -> tuple[FloatArray, bool]:
        """Zero."""
        return np.zeros(FORCES), False
