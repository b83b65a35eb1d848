"""What every suspension controller is: a linear law while no limit binds, and an exact step where one does.

That split is what makes a run fast: the simulation drives the linear closed loop over many steps at once, looks
where the law stops being valid, and asks the controller only there (docs/decisions/0002-speculative-blocks.md).
"""

from abc import ABC, abstractmethod
from dataclasses import dataclass

import numpy as np

from sim_core.half_car import FORCES, STATES
from sim_core.result import FloatArray

MEASURED = STATES + FORCES  # what a law multiplies: the state, then the previous command


@dataclass(frozen=True, slots=True, eq=False, kw_only=True)
class LinearLaw:
    """u = gain·z + feed, exact as long as |checks·z + offsets| <= bounds in every row.

    z (10,) = [state (8); previous command (2) in N]; gain (2, 10); checks (rows, 10); bounds (rows,).
    """

    gain: FloatArray
    checks: FloatArray
    bounds: FloatArray


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

    def ahead(self, stage: str, first: int, last: int) -> tuple[FloatArray, FloatArray]:
        """What preview adds in control steps first to last - 1 of a stage: feed (n, 2) [N] and offsets (n, rows)."""
        count = last - first
        return np.zeros((count, FORCES)), np.zeros((count, len(self.law(stage).bounds)))

    @abstractmethod
    def step(self, step: int, stage: str, state: FloatArray, previous: FloatArray) -> FloatArray:
        """The command (2,) [N] of one control step, limits included.

        Args:
            step: Index of the control step.
            stage: Driving stage.
            state: Measured state (8,).
            previous: Previous command (2,) [N].
        """


class PassiveController(Controller):
    """No force, ever."""

    def law(self, stage: str) -> LinearLaw:
        """Zero, without a limit."""
        return LinearLaw(gain=np.zeros((FORCES, MEASURED)), checks=np.zeros((0, MEASURED)), bounds=np.zeros(0))

    def step(self, step: int, stage: str, state: FloatArray, previous: FloatArray) -> FloatArray:
        """Zero."""
        return np.zeros(FORCES)
