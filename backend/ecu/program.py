"""A program built from exported sources drives the scenario, and is compared with Ridelab's own."""

from collections.abc import Iterator
from dataclasses import dataclass
from functools import partial
from pathlib import Path

from backend.cost import affordable
from backend.ecu.link import connected
from backend.ecu.report import changes
from sim_core import Scenario, simulate
from sim_core.strategies.lv_hil import LvHil


@dataclass(frozen=True, slots=True, kw_only=True)
class ProgramDrive:
    """The outcome of a program's drive.

    Attributes:
        program: Its file.
        same: Whether every metric equals that of Ridelab's own program.
        changes: By window and signal, the change against `lv` simulated [%]; None where there is none.
    """

    program: Path
    same: bool
    changes: dict[str, dict[str, float | None]]

    def lines(self) -> Iterator[str]:
        """Return it in words, line by line."""
        same = "is" if self.same else "is NOT"
        yield f"{self.program} drove the scenario; every metric {same} that of Ridelab's own program"
        for window, row in self.changes.items():
            cells = (f"{key} {'none' if value is None else f'{value:+z.1f} %'}" for key, value in row.items())
            yield f"against lv simulated, {window}: {', '.join(cells)}"


def driven(scenario: Scenario, program: Path) -> ProgramDrive:
    """Drive the scenario with the program, and with Ridelab's own.

    Raises:
        EcuError: It has another scenario's tables, or did not answer.
        RidelabError: The scenario has no controller.
    """
    ours = affordable.simulate(scenario, "lv_hil")
    result = simulate(scenario, LvHil(connect=partial(connected, program=program.resolve())))
    against_lv = changes(result, affordable.simulate(scenario, "lv"))
    return ProgramDrive(program=program, same=result.summary() == ours.summary(), changes=against_lv)
