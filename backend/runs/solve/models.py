"""The request and the answer of `POST /solve`; beside `backend.models`."""

from collections.abc import Mapping
from typing import Annotated, Self

from pydantic import AfterValidator, Field, ValidationInfo, field_validator, model_validator
from pydantic_core import PydanticCustomError

from backend.models import Answer, MetricName, RequestModel, RoadCount, SentScenario, StrategyName, inconsistent
from backend.requirements import RequirementResult, Requirements
from backend.runs.models import Interval
from backend.runs.solve.limit_search import Axis
from backend.unknown_names import unknown_name
from sim_core.catalogue import METRICS
from sim_core.errors import RidelabError
from sim_core.scenario import Scenario, dotted

UNORDERED = ("road.seed", "hil.seed")  # a greater seed is another road or other noise, not more of anything
NARROWEST, LEAST_WIDTH = 1e-9, 1e-15  # of a range: as a share of its larger end, and in the field's unit

Value = int | float  # a whole-number field's stays one


def _solvable(fields: Mapping[str, dotted.DottedField]) -> list[str]:
    """Return the names of fields that have a largest value."""
    return [name for name, each in fields.items() if each.kind in ("number", "integer") and name not in UNORDERED]


def _check_field(name: str) -> str:
    fields = dotted.fields()
    solvable = _solvable(fields)
    if name in fields and name not in solvable:
        raise PydanticCustomError("no_order", "{name} has no largest value: its values have no order", {"name": name})
    if name not in solvable:
        offered = [each for each in dotted.offered(name) if each in solvable] or solvable
        raise PydanticCustomError("unknown_field", "{said}", {"said": unknown_name("field", name, offered)})
    return name


class SolveRequest(RequestModel):
    """The question how large a field may be while a metric keeps its limit, or while every requirement holds."""

    scenario: SentScenario = Scenario()
    strategy: StrategyName
    field: Annotated[str, AfterValidator(_check_field), Field(json_schema_extra={"examples": ["road.bump.height"]})] = (
        Field(description="By its dotted name; one that takes a number")
    )
    range: Annotated[tuple[float, float], Field(strict=False)] = Field(description="[lowest, highest], its unit")
    metric: MetricName | None = Field(None, description="By its flat name, a column of a batch's table")
    limit: float | None = Field(
        None, ge=-1e12, le=1e12, description="The metric's unit; over several roads its interval keeps it"
    )
    roads: RoadCount = 1
    baseline: StrategyName | None = Field(
        None, description="What a requirement's change is against, driven beside the strategy; null is passive"
    )
    requirements: Requirements = Field([], description="In place of metric and limit: all that has to hold")

    @field_validator("range")
    @classmethod
    def _field_takes_it(cls, ends: tuple[float, float], info: ValidationInfo) -> tuple[float, float]:
        if not ends[0] < ends[1]:
            raise PydanticCustomError("empty_range", "A range is [lowest, highest], the first smaller than the second")
        if ends[1] - ends[0] < max(NARROWEST * max(map(abs, ends)), LEAST_WIDTH):
            context = {"share": NARROWEST}
            raise PydanticCustomError(
                "narrow_range", "A range is as wide as {share} of its larger end at least", context
            )
        name = info.data.get("field")
        for index, end in enumerate(ends if name is not None else ()):
            try:
                dotted.field(str(name)).checked(int(end) if cls._whole(str(name)) and end.is_integer() else end)
            except RidelabError as error:
                raise inconsistent(str(index), error.message) from None
        return ends

    @model_validator(mode="after")
    def _one_question(self) -> Self:
        if (self.metric is None) != (self.limit is None) or (self.metric is None) == (not self.requirements):
            missing = "metric" if self.metric is None else "limit"
            raise inconsistent(missing, "Either metric and limit have to be given, or requirements")
        for index, requirement in enumerate(self.requirements):
            if self.strategy not in (requirement.strategies or [self.strategy]):
                raise inconsistent(f"requirements.{index}.strategies", f"It is searched for {self.strategy}")
            if requirement.max_change is not None and self.strategy == self.against:
                message = f"A change of {self.strategy} takes another baseline"
                raise inconsistent(f"requirements.{index}.max_change", message)
        return self

    @property
    def against(self) -> str:
        """The strategy that a requirement's change is against."""
        return self.baseline or "passive"

    @property
    def driven(self) -> list[str]:
        """The strategies that are driven at each value."""
        changes = any(requirement.max_change is not None for requirement in self.requirements)
        return [self.strategy, self.against] if changes else [self.strategy]

    @property
    def bound(self) -> float:
        """The greatest value that satisfies: of the limit, or as a share of all requirements' limits."""
        return 1.0 if self.limit is None else self.limit

    @property
    def held(self) -> str:
        """The metric that is held to it, in words."""
        return self.metric or "the largest part of a limit that is used"

    @property
    def held_unit(self) -> str:
        """The unit of what is held to the limit, 1 for none."""
        return "1" if self.metric is None else METRICS[self.metric].unit

    @staticmethod
    def _whole(name: str) -> bool:
        return dotted.field(name).kind == "integer"

    @property
    def axis(self) -> Axis:
        """The values that may be tried."""
        return Axis.of(*self.range, whole=self._whole(self.field))

    def value(self, index: int) -> Value:
        """Return the value of an index, as the field takes it."""
        return self._typed(self.axis.value(index))

    def resolved(self, index: int, width: float) -> Value:
        """The same in as many digits as values within `width` steps are told apart."""
        return self._typed(self.axis.resolved(index, width))

    def _typed(self, value: float) -> Value:
        return int(value) if self._whole(self.field) else value


class TriedValue(Answer):
    """One value that was tried."""

    value: Value
    metric_value: float | None = Field(description="What is held to the limit; null where there is none")
    run_id: str | None = Field(description="The run at that value; null where the scenario has none")
    reason: str | None = Field(description="Why there is no metric; null where there is")


class Solution(Answer):
    """The largest value that keeps the limit."""

    value: Value = Field(description="The field's unit")
    metric_value: float = Field(
        description="What is held to the limit; over several roads the interval's upper end. Of requirements the "
        "largest part of a limit that is used, 1 where one is just kept"
    )
    interval: Interval | None = Field(description="The metric at that value over the roads; null for one road")
    resolution: float | None = Field(
        description="Smallest change of the metric [%] that is more than random variation: on one road the strategy's "
        "`one_road_resolution`, over several half the interval; null of metrics and roads without one"
    )
    resolved_value: Value = Field(
        description="The value in no more digits than `resolution` leaves it, rounded down; not driven itself"
    )
    bracket: tuple[Value, Value] = Field(
        description="The value, and the next larger one, which does not keep the limit or could not be tried; twice "
        "the value at the top of the range"
    )
    runs: int = Field(description="How many runs it took, one a road and value tried; equal ones are stored once")
    run_id: str = Field(description="The run at that value")
    unit: str = Field(description="Of the field; 1 for none")
    metric_unit: str = Field(description="1 for none")
    warnings: list[str] = Field(description="Where the metric is not monotone, and what else the value does not tell")
    tried: list[TriedValue] = Field(description="Every value tried, in order")
    requirement_results: list[RequirementResult] = Field(
        description="How they are kept at the value; empty without any"
    )
    core_version: str
