"""The shape of what is asked for as an FMU."""

from typing import Literal

from pydantic import Field

from backend.models import RequestModel, SentScenario, StrategyName
from sim_core.scenario import Scenario


class FmuRequest(RequestModel):
    """The model to export; an omitted part of the scenario takes the paper's default."""

    scenario: SentScenario = Scenario()
    strategy: StrategyName = Field("lv", description="Whose controller")
    of: Literal["controller", "vehicle"] = Field("controller", description="What the FMU is")
    version: Literal["2.0", "3.0"] = Field("2.0", description="Of FMI for co-simulation")
    platforms: list[Literal["linux64", "win64", "darwin64"]] = Field(
        ["linux64", "win64", "darwin64"], description="Whose programs are inside, as far as the service has them"
    )
