"""The shapes of requests and answers: OpenAPI, and with it the browser's client, is made from them.

What is answered is built as its model, a large table and what is stored as JSON apart; requests are validated strictly.
"""

import re
from functools import partial
from typing import Annotated, Any, Literal

from pydantic import AfterValidator, BaseModel, BeforeValidator, ConfigDict, Field, ValidationInfo, WithJsonSchema
from pydantic_core import PydanticCustomError

from backend.digest import STRATEGY_PATTERN
from backend.json_types import JsonObject
from backend.means_over_roads import MAX_ROADS
from backend.unknown_names import unknown_name
from sim_core.catalogue import COMFORT, EVENTS, METRIC_SIGNALS, NUMBERS, REFERENCES, SIGNALS, STAGES, WINDOWS
from sim_core.errors import RidelabError
from sim_core.scenario import Scenario, dotted
from sim_core.scenario.fields import at
from sim_core.scenario.recorded import NAME_PATTERN
from sim_core.scenario.road import MAX_SEED
from sim_core.strategies import STRATEGIES, strategies

DEFAULT_POINTS = 800
MAX_POINTS = 100_000
MAX_LIVE_POINTS = 10_000  # of an answer that stays in memory: nine strategies take 7 MB


class RequestModel(BaseModel):
    """Base of request models: no other fields, no conversions."""

    model_config = ConfigDict(extra="forbid", strict=True, frozen=True, hide_input_in_errors=True)


class Answer(BaseModel):
    """Base of answer models: every field is always present; can be built from the core's objects.

    Most are parts of others: where each has its validator only once it is asked for, a service starts sooner.
    """

    model_config = ConfigDict(json_schema_serialization_defaults_required=True, from_attributes=True, defer_build=True)


def _listed(values: Any) -> Any:
    return values.tolist() if hasattr(values, "tolist") else values


Vector = Annotated[list[float], BeforeValidator(_listed)]  # of an array of numbers
Matrix = Annotated[list[list[float]], BeforeValidator(_listed)]  # row by row


def inconsistent(field: str, message: str, key: str | None = None) -> PydanticCustomError:
    """Return an error of a request, or of a part of it, that belongs to one field in it, dotted, or to a key there."""
    return PydanticCustomError("inconsistent", "{reason}", {"field": field, "key": key, "reason": message})


def _check_strategy(name: str) -> str:
    if re.fullmatch(NAME_PATTERN, name):
        raise PydanticCustomError("recorded", "A recording is taken by runs alone: nothing drives it")
    if name not in STRATEGIES and name not in (offered := strategies()):
        raise PydanticCustomError("unknown_strategy", "{said}", {"said": unknown_name("strategy", name, list(offered))})
    return name


def _check_options(scenario: Scenario) -> Scenario:
    """Check that a scenario has options of existing controllers alone, with values that they take."""
    if not scenario.own.controllers:
        return scenario
    by_id = strategies()
    offered = [name for name, each in by_id.items() if each.options()]
    for controller, options in scenario.own.controllers.items():
        if controller not in offered:
            raise at(f"{dotted.OWN}{controller}", unknown_name("controller with options", controller, offered))
        for option, value in options.items():
            name = f"{dotted.OWN}{controller}.{option}"
            if option not in by_id[controller].options():
                raise at(name, unknown_name("option", option, list(by_id[controller].options())))
            try:
                dotted.field(name).checked(value)
            except RidelabError as error:
                raise at(name, error.message) from None
    return scenario


SentScenario = Annotated[Scenario, AfterValidator(_check_options)]


def _check_listed(what: str, offered: list[str], name: str) -> str:
    if name not in offered:
        raise PydanticCustomError("unknown_name", "{said}", {"said": unknown_name(what, name, offered)})
    return name


# The API's description lists those that there are when it is asked for.
StrategyName = Annotated[str, AfterValidator(_check_strategy), Field(json_schema_extra={"enum": list(STRATEGIES)})]


def _check_shown(name: str) -> str:
    return name if name in STRATEGIES or re.fullmatch(NAME_PATTERN, name) else _check_strategy(name)


# Of what is stored: its controller's file may have gone since.
StrategyId = Annotated[str, Field(pattern=STRATEGY_PATTERN)]
# One of a run's: simulated, or a recording, which nothing else takes.
ShownStrategy = Annotated[
    str, AfterValidator(_check_shown), WithJsonSchema({"type": "string", "pattern": STRATEGY_PATTERN})
]
_check_signal = AfterValidator(partial(_check_listed, "signal", list(SIGNALS)))
_check_metric = AfterValidator(partial(_check_listed, "metric", list(NUMBERS)))
SignalName = Annotated[str, _check_signal, Field(json_schema_extra={"enum": list(SIGNALS)})]
MetricName = Annotated[str, _check_metric, Field(json_schema_extra={"enum": list(NUMBERS)})]
Points = Annotated[
    int, Field(ge=2, le=MAX_LIVE_POINTS, description="At most how many samples; up to half of them are peaks.")
]


def _seeds_exist(roads: int, info: ValidationInfo) -> int:
    scenario = info.data.get("scenario")
    if scenario is not None and roads > 1 and scenario.road.profile is not None:
        raise PydanticCustomError("one_road", "A measured road is one road: roads can only be 1")
    if scenario is not None and scenario.road.seed + roads - 1 > MAX_SEED:
        raise PydanticCustomError("no_seed", "The last road's seed would be over {most}", {"most": MAX_SEED})
    return roads


RoadCount = Annotated[  # behind a field `scenario`
    int,
    Field(ge=1, le=MAX_ROADS, description="Seeds road.seed, road.seed + 1, …; each strategy drives all"),
    AfterValidator(_seeds_exist),
]


class StrategiesRequest(RequestModel):
    """Strategies over a scenario; an omitted part of it takes the paper's default."""

    scenario: SentScenario = Scenario()
    strategies: list[StrategyName] = Field(min_length=1, max_length=32)


def check_baseline_runs(baseline: str | None, info: ValidationInfo) -> str | None:
    """Check that a baseline is one of the strategies that run, behind the field `strategies`."""
    names = info.data.get("strategies")
    if baseline is not None and names is not None and baseline not in names:
        message = "One of the strategies that run: {names}"
        raise PydanticCustomError("baseline_not_run", message, {"names": ", ".join(names)})
    return baseline


def keys_of(names: Any, description: str) -> Any:
    """Return a mapping's field whose keys are these names."""
    return Field(description=description, json_schema_extra={"propertyNames": {"enum": list(names)}})


def by_strategy(description: str = "By strategy") -> Any:
    """Return a mapping's field whose keys are names of strategies, perhaps of some that are there no more."""
    return Field(description=description, json_schema_extra={"propertyNames": {"pattern": STRATEGY_PATTERN}})


class Statistics(Answer):
    """One signal in one window; null where a recording does not have it."""

    rms: float | None
    peak: float | None


WindowMetrics = Annotated[
    dict[str, Statistics], keys_of(METRIC_SIGNALS, "By signal (catalogue: metric_signals), SI units")
]


class Stage(Answer):
    """One driving stage, by the front axle."""

    stage: Annotated[str, Field(json_schema_extra={"enum": list(STAGES)})]
    start_time: float = Field(description="[s]")
    end_time: float = Field(description="[s]")
    start_position: float = Field(description="[m]")
    end_position: float = Field(description="[m]")


# A count stays a whole number.
Event = Annotated[
    bool | int | float | None, WithJsonSchema({"anyOf": [{"type": "boolean"}, {"type": "number"}, {"type": "null"}]})
]


class Source(Answer):
    """The file of a custom controller."""

    file: str = Field(description="Its name, or that of a package's entry point")
    digest: str = Field(description="SHA-256 of it and of the files it names")


class DriveResult(Answer):
    """What a strategy's result has beside its metrics; of several roads, the first one's."""

    status: Literal["ok"]
    source: Source | None = Field(description="What the controller was when it was driven; null for Ridelab's own")
    core_version: str | None = Field(
        None, description="That computed it; only there where it is another one than the run's, see `unavailable`"
    )
    compute_ms: float = Field(description="The worker's own time [ms]; work shared between strategies counts once")
    events: dict[str, Event] = keys_of(EVENTS, "Catalogue: events")
    reference: dict[str, float | None] = keys_of(REFERENCES, "Lines a plot draws; catalogue: references")
    stages: list[Stage]
    travel_time: float | None = Field(description="[s]; the same on every road; null where it was not recorded")
    arrival_speed_kmh: float | None = Field(description="[km/h]; likewise")


class RecordingReport(Answer):
    """How a recording became a result."""

    offset: float | None = Field(description="Where on the road its distance is 0 [m]; null where no place was found")
    scale: float | None = Field(description="Metres of the road, or seconds, in one of the recording; likewise")
    likeness: float | None = Field(description="Correlation with the drive it was placed by; likewise")
    reference: str | None = Field(description="The strategy that drives it; likewise")
    samples: int = Field(description="Of each signal, in the whole file")
    start: float = Field(description="Where on the road it begins [m]")
    end: float = Field(description="Where on the road it ends [m]")
    missing: list[str] = Field(description="Signals that it does not have")
    notes: list[str] = Field(description="All of this in words, and what may be wrong")


class StrategyResult(DriveResult):
    """One strategy's figures over the scenario."""

    model_config = ConfigDict(json_schema_serialization_defaults_required=False)

    metrics: dict[str, WindowMetrics] = keys_of(WINDOWS, "By window (catalogue: windows)")
    comfort: dict[str, float | None] = keys_of(COMFORT, "Catalogue: comfort; null where a recording does not have it")
    recording: RecordingReport | None = Field(None, description="How a recording became this; only there for one")


class StrategyFailure(Answer):
    """A strategy that failed, and why."""

    status: Literal["failed"]
    compute_ms: float
    reason: str
    kind: Literal["refused", "too-expensive", "unavailable"] = Field(
        "refused",
        description="`refused` and `too-expensive` follow from scenario and program; of the latter the run would take "
        "more computing than one may: change one of `fields`. `unavailable` may have passed: it is not stored, and is "
        "tried again when it is asked for",
    )
    fields: list[str] = Field([], description="Dotted names of scenario fields that make it cheaper")


class CachedResult(StrategyResult):
    """A result, and whether it was computed for this request."""

    cached: bool = Field(
        description="Taken from store or memory, or from an equal request under way: not computed for this one"
    )


class CachedFailure(StrategyFailure):
    """A failure, and whether it was computed for this request."""

    cached: bool


class TypedArray(Answer):
    """Little-endian float32 in base64: plotly's typed-array form."""

    dtype: Literal["f4"]
    bdata: str


class WithId(Answer):
    """What has an id; as the last base its id stands first."""

    id: str


class AxlesAnswer(Answer):
    """A number of the front and of the rear axle."""

    front: float = Field(description="Of the front axle")
    rear: float = Field(description="Of the rear axle")


class ModesAnswer(Answer):
    """A number of the body above each axle, and of each axle's wheel."""

    front_body: float = Field(description="Of the body above the front axle")
    rear_body: float = Field(description="Of the body above the rear axle")
    front_wheel: float = Field(description="Of the front wheel")
    rear_wheel: float = Field(description="Of the rear wheel")


class CharacteristicsAnswer(Answer):
    """What a vehicle's parameters come to, each axle by itself, dampers at their mean; no part of a scenario."""

    static_sag: AxlesAnswer = Field(
        description="By how much the body's weight compresses each suspension [m]; travel is counted from there"
    )
    natural_frequencies: ModesAnswer = Field(description="Undamped [Hz]")
    damping_ratios: ModesAnswer = Field(description="Over critical [1]")


class CautionAnswer(Answer):
    """Something that a reader of the numbers should beware of."""

    kind: str = Field(description="What it is about, by which programs go")
    text: str = Field(description="Whole sentences")
    field: str | None = Field(description="The dotted scenario field to look at; null where there is none")
    strategy: str | None = Field(description="Whose it is; null where it is of all")


Histories = Annotated[
    dict[str, list[float | None] | TypedArray], keys_of(SIGNALS, "Lists, or typed arrays with encoding=base64")
]


class Series(Answer):
    """Time histories of one strategy."""

    core_version: str
    strategy: str
    units: dict[str, str]
    series: Histories


class SeriesOfSeveral(Answer):
    """Time histories of several strategies."""

    core_version: str
    units: dict[str, str]
    strategies: dict[str, Histories]


class Figures(Answer):
    """Plotly figures by name, in the order of display."""

    figures: dict[str, JsonObject]
