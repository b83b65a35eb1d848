"""The shapes of a run's request and answers; beside `backend.models`."""

from typing import Annotated

from pydantic import AfterValidator, ConfigDict, Field, ValidationInfo, field_validator
from pydantic_core import PydanticCustomError

from backend.models import (
    Answer,
    CachedFailure,
    CachedResult,
    CautionAnswer,
    CharacteristicsAnswer,
    RequestModel,
    RoadCount,
    SentScenario,
    ShownStrategy,
    StrategyFailure,
    StrategyResult,
    TypedArray,
    WithId,
    by_strategy,
    check_baseline_runs,
    keys_of,
)
from backend.requirements import RequirementResult, Requirements
from backend.runs.comparison_models import ComparisonAnswer
from sim_core.catalogue import SIGNALS
from sim_core.scenario import Scenario
from sim_core.scenario.recorded import recording_id


class RunRequest(RequestModel):
    """A run to compute, on how many roads; an omitted part of the scenario takes the paper's default."""

    scenario: SentScenario = Scenario()
    strategies: list[ShownStrategy] = Field(min_length=1, max_length=32, description="A recording is of one road.")
    roads: RoadCount = 1
    baseline: Annotated[ShownStrategy | None, AfterValidator(check_baseline_runs)] = Field(
        None,
        description="What changes refer to, one of the strategies; null is passive, or the first strategy where "
        "passive does not run",
    )

    @field_validator("roads")
    @classmethod
    def _recorded_once(cls, roads: int, info: ValidationInfo) -> int:
        if roads > 1 and any(recording_id(name) is not None for name in info.data.get("strategies") or ()):
            raise PydanticCustomError("one_road", "A recording is of one road: roads can only be 1")
        return roads

    requirements: Requirements = Field([])


class RunBase(Answer):
    """Fields of every form of a run."""

    core_version: str
    scenario: Scenario
    characteristics: CharacteristicsAnswer
    cautions: list[CautionAnswer]
    comparison: ComparisonAnswer


class LiveResult(CachedResult):
    """Figures and decimated time histories."""

    series: dict[str, TypedArray] = keys_of(SIGNALS, "The same samples for every signal; SI units")


class LiveRun(RunBase):
    """A run that is not stored."""

    strategies: dict[str, Annotated[LiveResult | CachedFailure, Field(discriminator="status")]] = by_strategy()


class JudgedRun(RunBase, WithId):
    """Fields of every form of a stored run."""

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
