"""The shapes of a run's request and answers; beside `backend.models`."""

from typing import Annotated

from pydantic import ConfigDict, Field, ValidationInfo, field_validator
from pydantic_core import PydanticCustomError

from backend.models import (
    CachedFailure,
    CachedResult,
    RequestModel,
    RoadCount,
    RunBase,
    SentScenario,
    ShownStrategy,
    StrategyFailure,
    StrategyResult,
    WithId,
    by_strategy,
)
from backend.requirements import RequirementResult, Requirements
from sim_core.scenario import Scenario
from sim_core.scenario.recorded import recording_id


class RunRequest(RequestModel):
    """What to run, on how many roads; an omitted part of the scenario takes the paper's default."""

    scenario: SentScenario = Scenario()
    strategies: list[ShownStrategy] = Field(min_length=1, max_length=32, description="A recording is of one road.")
    roads: RoadCount = 1
    baseline: ShownStrategy | None = Field(
        None,
        description="What the changes over several roads refer to, one of the strategies; null is passive, or the "
        "first strategy where passive does not run",
    )

    @field_validator("roads")
    @classmethod
    def _recorded_once(cls, roads: int, info: ValidationInfo) -> int:
        if roads > 1 and any(recording_id(name) is not None for name in info.data.get("strategies") or ()):
            raise PydanticCustomError("one_road", "A recording is of one road: roads can only be 1")
        return roads

    @field_validator("baseline")
    @classmethod
    def _baseline_runs(cls, baseline: str | None, info: ValidationInfo) -> str | None:
        names = info.data.get("strategies")
        if baseline is not None and names is not None and baseline not in names:
            message = "One of the strategies that run: {names}"
            raise PydanticCustomError("baseline_not_run", message, {"names": ", ".join(names)})
        return baseline

    requirements: Requirements = Field([])


class JudgedRun(RunBase, WithId):
    """What every form of a stored run has."""

    model_config = ConfigDict(json_schema_serialization_defaults_required=False)

    requirement_results: list[RequirementResult] = Field(
        [], description="How the strategies keep `requirements`, in their order; only where some were sent"
    )


class Run(JudgedRun):
    """A stored run; it never changes."""

    strategies: dict[str, Annotated[StrategyResult | StrategyFailure, Field(discriminator="status")]] = by_strategy()


class CreatedRun(JudgedRun):
    """The answer to the request that created a run."""

    strategies: dict[str, Annotated[CachedResult | CachedFailure, Field(discriminator="status")]] = by_strategy()
