"""What a drive leaves behind: the signals of every fine step and what its controller reports."""

from dataclasses import dataclass

from sim_core.arrays import FloatArray
from sim_core.control.controller import SolverReport
from sim_core.loop.excitation import Excitation


@dataclass(slots=True)
class LoopStatistics:
    """What happened between plant and ECU in a run.

    Attributes:
        limited: Control steps in which a limit shaped the commands.
        unfinished: Of those, how many the solver did not finish.
        iterations: The solver's most in one step.
        slack: Largest predicted deflection beyond the limit [cm].
        clipped: Measured values beyond their range.
        held: Commands that never took effect: lost, late, or overtaken by a later one.
    """

    limited: int = 0
    unfinished: int = 0
    iterations: int = 0
    slack: float = 0.0
    clipped: int = 0
    held: int = 0


@dataclass(frozen=True, slots=True, eq=False, kw_only=True)
class Recording:
    """One drive.

    Attributes:
        table: plant.RECORDED (10, fine steps of a command + 1, commands) from x = 0 on.
        excitation: What it drove over.
        report: What the controller's QP solver did.
        limited: Control steps in which a limit shaped the command.
        loop: What happened between car and ECU, of a strategy that has one.
    """

    table: FloatArray
    excitation: Excitation
    report: SolverReport
    limited: int
    loop: LoopStatistics | None = None
