"""What a drive leaves behind: the signals of every fine step and what its controller reports."""

from dataclasses import dataclass

from sim_core.control.controller import SolverReport
from sim_core.drive.sampling import RoadInput
from sim_core.ecu.interface import LoopStatistics
from sim_core.result import FloatArray


@dataclass(frozen=True, slots=True, eq=False, kw_only=True)
class Recording:
    """One drive.

    Attributes:
        table: plant.RECORDED (10, fine steps of a command + 1, commands) from x = 0 on.
        road_input: What it drove over.
        report: What the controller's QP solver did.
        limited: Control steps in which a limit shaped the command.
        loop: What happened between car and ECU, of a strategy that has one.
    """

    table: FloatArray
    road_input: RoadInput
    report: SolverReport
    limited: int
    loop: LoopStatistics | None = None
