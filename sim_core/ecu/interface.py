"""What the loop needs of an ECU: a frame goes to it, a reply comes back."""

from abc import ABC, abstractmethod
from collections.abc import Callable
from contextlib import AbstractContextManager
from dataclasses import dataclass

from sim_core.ecu.calibration import Calibration
from sim_core.ecu.channels import Codes


@dataclass(frozen=True, slots=True, eq=False, kw_only=True)
class Frame:
    """One control step's measurements: codes (8 + 3 · preview_length,), the stage's number in channels.STAGES."""

    step: int
    stage: int
    codes: Codes


@dataclass(frozen=True, slots=True, kw_only=True)
class Reply:
    """The ECU's answer.

    Attributes:
        commands: Codes of both forces.
        limited: Whether a limit shaped them.
        iterations: Of the solver.
        unfinished: The solver stopped before it was done; the forces are clipped.
        slack: Largest predicted deflection beyond the limit [cm].
        operations: Floating-point operations that it took, a multiplication with its addition being one; 0 where they
            are not counted.
            are not counted.
    """

    commands: tuple[int, int]
    limited: bool
    iterations: int
    unfinished: bool
    slack: float
    operations: int = 0


class Ecu(ABC):
    """One run's ECU. Its memory, the last command, starts at zero."""

    @abstractmethod
    def exchange(self, frame: Frame) -> Reply | None:
        """Answer one frame; None where no answer came in time."""


Connect = Callable[[Calibration], AbstractContextManager[Ecu]]
