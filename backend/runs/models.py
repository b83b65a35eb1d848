"""The shapes of a run's request and answers, also over several roads; beside `backend.models`."""

from typing import Annotated, Any, Literal

from pydantic import AfterValidator, ConfigDict, Field, ValidationInfo, create_model, field_validator
from pydantic_core import PydanticCustomError

from backend.models import (
    DEFAULT_POINTS,
    Answer,
    CachedFailure,
    CachedResult,
    CautionAnswer,
    CharacteristicsAnswer,
    DriveResult,
    Histories,
    Points,
    RequestModel,
    RoadCount,
    SentScenario,
    ShownStrategy,
    SignalName,
    StrategiesRequest,
    StrategyFailure,
    StrategyName,
    StrategyResult,
    TypedArray,
    WithId,
    by_strategy,
    check_baseline_runs,
    keys_of,
)
from backend.requirements import RequirementResult, Requirements
from sim_core.catalogue import COMFORT, METRIC_SIGNALS, PAPER_METRICS, SIGNALS, WINDOWS
from sim_core.scenario import Scenario
from sim_core.scenario.recorded import recording_id

Against = Annotated[
    str | None,
    Field(
        max_length=64,
        description="Id of a run that the `changes_against` of `comparison` refer to, such as the state before an "
        "edit; over several roads it has to be of the same ones",
    ),
]


class ChangeAnswer(Answer):
    """The change of a metric against the baseline's."""

    change: float | None = Field(description="[%], over several roads of the mean; null where the baseline has a zero")
    low: float | None = Field(description="Of its 95 % interval over roads [%]; null on one road")
    high: float | None = Field(description="Likewise")
    beyond_variation: bool = Field(
        description="Whether it is more than random variation: on one road at least `one_road_resolution`, over "
        "several an interval without zero; never where both values show as the same digits"
    )


class VerdictAnswer(Answer):
    """The verdict of a comparison: the best strategy by metric, and as text."""

    text: str = Field(description="Whole sentences: who is best, by how much the ride differs, at which speeds")
    best: dict[str, str | None] = Field(
        description="Metric -> the strategy that is lower than every other one beyond random variation; null where "
        "none is. Of the paper's eight metrics those that all simulated strategies have",
        json_schema_extra={"propertyNames": {"enum": list(PAPER_METRICS)}},
    )
    mixed: bool = Field(description="Every strategy has a metric in which another one is lower beyond random variation")


class ComparisonAnswer(Answer):
    """Comparison of several strategies' results."""

    baseline: str = Field(description="The strategy that changes refer to, by its id; it may have failed")
    changes: dict[str, Annotated[dict[str, ChangeAnswer], Field(description="By metric, by its flat name")]] = (
        by_strategy("By strategy that succeeded; not of the baseline, and none where that failed")
    )
    verdict: VerdictAnswer
    cautions: list[CautionAnswer] = Field(
        description="Warnings about values outside a car's usual range and about results that are not fully comparable"
    )
    changes_against: dict[str, Annotated[dict[str, ChangeAnswer], Field(description="By metric, by its flat name")]] = (
        by_strategy("Against the same strategy of the run `against`, of those that both have; empty without one")
    )
    requirements: list[RequirementResult] = Field(
        description="The results under `requirements`, in their order, of all strategies of the run; as "
        "`requirement_results`, and empty without"
    )


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
    against: Against = None


class LiveRequest(StrategiesRequest):
    """A run while somebody drags: nothing is stored, the answer has time histories."""

    baseline: Annotated[StrategyName | None, AfterValidator(check_baseline_runs)] = Field(
        None,
        description="What the changes of `comparison` refer to, one of the strategies; null is passive, or the first "
        "strategy where passive does not run",
    )
    requirements: Requirements = Field([])
    against: Against = None
    points: Points = DEFAULT_POINTS
    signals: list[SignalName] | None = Field(None, description="Time and position always come; none is all.")
    part: Literal["bump"] | None = Field(
        None,
        description="Samples of the bump and some road around it alone; null is the whole road.",
    )
    encoding: Literal["base64", "binary"] = Field(
        "base64",
        description="Of time histories: typed arrays in JSON, or float32 behind it (`application/octet-stream`)",
    )


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


class Interval(Answer):
    """A mean over roads, or a change of means [%], with its 95 % interval (Student's t)."""

    mean: float
    low: float
    high: float


class RoadsStatistics(Answer):
    """One signal in one window, over several roads."""

    rms: Interval
    peak: Interval


class Changes(Answer):
    """One signal in one window: paired change of the mean against the baseline's [%]; null where that is zero."""

    rms: Interval | None
    peak: Interval | None


WindowRoads = Annotated[
    dict[str, RoadsStatistics], keys_of(METRIC_SIGNALS, "By signal (catalogue: metric_signals), SI units")
]
WindowChanges = Annotated[dict[str, Changes], keys_of(METRIC_SIGNALS, "By signal (catalogue: metric_signals), in %")]


class RoadsResult(DriveResult):
    """One strategy's figures over several roads."""

    metrics: dict[str, WindowRoads] = keys_of(WINDOWS, "By window (catalogue: windows)")
    comfort: dict[str, Interval] = keys_of(COMFORT, "Catalogue: comfort")


_CHANGES: dict[str, Any] = dict.fromkeys(WINDOWS, WindowChanges)
StrategyChanges = create_model(
    "StrategyChanges",
    __base__=Answer,
    __doc__="One strategy's paired changes over several roads, by window (catalogue: windows), and of its comfort.",
    **_CHANGES,
    comfort=(dict[str, Interval | None], keys_of(COMFORT, "Catalogue: comfort; in %")),
)


class CachedRoadsResult(RoadsResult):
    """A result over several roads, and whether it was computed for this request."""

    cached: bool = Field(description="No road was computed for this request")


class RoadsRunBase(JudgedRun):
    """Fields of every form of a run over several roads."""

    roads: int = Field(description="Seeds road.seed, road.seed + 1, …; time histories and events are the first's")
    baseline: str = Field(description="The strategy that changes refer to: the one asked for, else the run's own")
    changes: dict[str, StrategyChanges] = by_strategy(
        "Against `baseline`, by strategy; not of the baseline, nor of failures"
    )


class RoadsRun(RoadsRunBase):
    """A stored run over several roads; it never changes."""

    strategies: dict[str, Annotated[RoadsResult | StrategyFailure, Field(discriminator="status")]] = by_strategy()


class CreatedRoadsRun(RoadsRunBase):
    """The answer to the request that created a run over several roads."""

    strategies: dict[str, Annotated[CachedRoadsResult | CachedFailure, Field(discriminator="status")]] = by_strategy()


class PairedChanges(Answer):
    """Changes of the strategies of a run over several roads, paired by road."""

    against: str | None = Field(description="Id of the run, over the same roads, whose same strategies they refer to")
    baseline: str | None = Field(description="The strategy of this run that they refer to instead")
    roads: int
    changes: dict[str, StrategyChanges] = by_strategy("By strategy that succeeded in both runs; not of the baseline")


class Band(Answer):
    """One strategy's time histories over the roads: at each sample the mean, the smallest and the largest value."""

    mean: Histories
    minimum: Histories = Field(description="Without what is the same on every road, such as time, position and speed")
    maximum: Histories = Field(description="Of the same signals as `minimum`")


class Bands(Answer):
    """Time histories over several roads: samples lie at the same times and positions on each."""

    core_version: str
    roads: int
    units: dict[str, str]
    strategies: dict[str, Band]
