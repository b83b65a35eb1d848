"""The shapes of what is asked and answered about the controller as an ECU's program."""

from typing import Literal

from pydantic import Field

from backend.models import Answer, RequestModel, SentScenario
from sim_core.scenario import Scenario


class ControllerRequest(RequestModel):
    """Whose controller; an omitted part of the scenario takes the paper's default."""

    scenario: SentScenario = Scenario()


class ControllerPart(Answer):
    """The microcontroller."""

    name: str
    clock: float = Field(description="[Hz]")
    flash: int = Field(description="[bytes]")
    ram: int = Field(description="[bytes]")
    stack: int = Field(description="Kept free for the controller's calls [bytes]")


class Operations(Answer):
    """Floating-point operations of one step: a multiplication with its addition is one."""

    least: int = Field(description="In this drive; where no limit binds")
    most: int = Field(description="In this drive")


class StepTime(Answer):
    """About how long one step takes on the part [s]."""

    least: float
    most: float


ChangesByWindow = dict[str, dict[str, float | None]]


class ControllerRow(Answer):
    """One controller, measured for the part and driven over the scenario."""

    prediction_horizon: int
    control_horizon: int
    checked: Literal["all", "few"] = Field(
        description="all limits of the horizon, or a few: the first move's forces and every third deflection"
    )
    checked_rows: int
    iterations: int = Field(description="Its solver stops after so many")
    code: int = Field(description="Flash, the compiler's arithmetic included [bytes]")
    constants: int = Field(description="Flash: tables [bytes]")
    variables: int = Field(description="RAM without the stack [bytes]")
    operations: Operations
    time: StepTime
    most_iterations: int = Field(description="That a step of this drive took")
    unfinished: int = Field(description="Steps of this drive whose iterations ran out")
    fits: bool
    reasons: list[str] = Field(description="Why it does not fit")
    changes: ChangesByWindow = Field(
        description="Against `lv` simulated, by window and signal [%]: Tables 9 and 10's figures"
    )


class ControllerReport(Answer):
    """The scenario's own controller and smaller ones on a small microcontroller: which of them fit."""

    part: ControllerPart
    sample_time: float = Field(description="Between two steps [s]")
    cycles_per_operation: float = Field(description="Measured by emulation of the part's processor")
    spread: float = Field(description="Share by which the emulated cycles lie around that")
    rows: list[ControllerRow]


class Compilers(Answer):
    """What a report needs that is not there: nothing any more, since nothing is compiled for one."""

    report: str | None = Field(description="Always null")
