"""What a drive leaves behind: the signals of every fine step and what its controller reports."""

from dataclasses import dataclass

from sim_core.arrays import FloatArray
from sim_core.control.controller import Report
from sim_core.loop.excitation import Excitation


@dataclass(frozen=True, slots=True, eq=False, kw_only=True)
class Recording:
    """One drive.

    Attributes:
        table: plant.RECORDED (10, fine steps of a command + 1, commands) from x = 0 on.
        excitation: What it drove over.
        report: What the controller says of it.
        limited: Control steps in which a limit shaped the command.
        held_commands: Commands that never took effect: lost, late, or overtaken by a later one; None where each takes
            effect at once.
    """

    table: FloatArray
    excitation: Excitation
    report: Report
    limited: int
    held_commands: int | None
