"""Requirements: metrics with limits. What a run, a sweep, a search or a report is held to is judged here alone."""

from collections.abc import Mapping, Sequence
from math import inf
from typing import Annotated, Literal, Self

from pydantic import AfterValidator, Field, TypeAdapter, ValidationError, ValidationInfo, model_validator

from backend.errors import InvalidError
from backend.json_types import Summary
from backend.models import Answer, MetricName, RequestModel, StrategyId, inconsistent
from sim_core.catalogue import METRICS
from sim_core.comparison.compare import default_baseline
from sim_core.comparison.intervals import Interval, change_with_interval, mean_with_interval

MOST_REQUIREMENTS = 64
LIMITS = ("max", "min", "max_change")
_NOT_RUN = "It did not run"

Limit = Annotated[float, Field(ge=-1e12, le=1e12)]
Result = Literal["pass", "fail", "uncertain"]
# A strategy's summaries on each road, or why it has none.
Driven = Sequence[Summary] | str


class Requirement(RequestModel):
    """What one metric has to keep: exactly one of `max`, `min` and `max_change`, which are kept where they are met."""

    metric: MetricName = Field(description="By its flat name, a column of a batch's table")
    max: Limit | None = Field(None, description="At most so much, in the metric's unit")
    min: Limit | None = Field(None, description="At least so much, in the metric's unit")
    max_change: Limit | None = Field(
        None, description="At most this change against the baseline [%]; -20 is: at least a fifth less than it"
    )
    # Any name: a stored requirement outlives the file of a law. `_fits` refuses those that do not run.
    strategies: Annotated[list[StrategyId], Field(min_length=1, max_length=32)] | None = Field(
        None, description="Which have to keep it; null is all that run but the baseline"
    )

    @model_validator(mode="after")
    def _one_limit(self) -> Self:
        if sum(getattr(self, name) is not None for name in LIMITS) != 1:
            raise inconsistent("max", "A requirement has exactly one of max, min and max_change")
        return self

    @property
    def limit(self) -> float:
        """Return its one limit."""
        limits: list[float | None] = [self.max, self.min, self.max_change]
        return next(limit for limit in limits if limit is not None)

    def strategies_judged(self, names: Sequence[str], baseline: str | None) -> list[str]:
        """Return which of the strategies `names` keep it; where only the baseline runs, it keeps max and min."""
        if self.strategies is not None:
            return self.strategies
        against = baseline_of(names, baseline) if self.max_change is not None else baseline or "passive"
        others = [name for name in names if name != against]
        return others or (list(names) if self.max_change is None else [])


class JudgedRequirement(Answer):
    """A requirement of one strategy, whose result follows."""

    metric: str = Field(description="By its flat name")
    strategy: str
    baseline: str | None = Field(description="What a change is against, at the same point of a batch; null of others")
    max: float | None = Field(description="The requirement's limit, one of these three")
    min: float | None = Field(description="Likewise")
    max_change: float | None = Field(description="Likewise [%]")


class RequirementResult(JudgedRequirement):
    """How one strategy keeps one requirement."""

    result: Result = Field(description="`uncertain` where the interval over roads holds the limit")
    value: float | None = Field(
        description="What is held to the limit: the metric, over several roads its mean, or its change against the "
        "baseline [%]; null where there is none"
    )
    low: float | None = Field(description="Of its 95 % interval over roads; null on one road")
    high: float | None = Field(description="Likewise")
    reason: str | None = Field(description="Why there is no value, and so it fails; null where there is one")


def _fits(requirements: list[Requirement], info: ValidationInfo) -> list[Requirement]:
    """Check that they are about strategies that run, behind fields `strategies` and `baseline`."""
    names: list[str] = info.data.get("strategies", [])
    baseline = info.data.get("baseline")
    for index, requirement in enumerate(requirements if names else ()):
        judged, base = requirement.strategies_judged(names, baseline), baseline_of(names, baseline)
        for place, name in enumerate(judged):
            if name not in names:
                raise inconsistent(f"{index}.strategies.{place}", f"One of those that run: {', '.join(names)}")
        if requirement.max_change is not None and (not judged or base in judged):
            message = f"A change is against {base}: it takes another strategy that runs"
            raise inconsistent(f"{index}.max_change", message)
    return requirements


Requirements = Annotated[
    list[Requirement],
    Field(
        max_length=MOST_REQUIREMENTS,
        description="What has to hold; each is answered among `requirement_results`. They change no id",
    ),
    AfterValidator(_fits),
]


def read(text: str) -> list[Requirement]:
    """Requirements in a parameter of an address, as JSON.

    Raises:
        InvalidError: They are none.
    """
    try:
        return _LIST.validate_json(text)
    except ValidationError as error:
        first = error.errors(include_input=False, include_url=False)[0]
        place = ".".join(map(str, first["loc"]))
        raise InvalidError(f"{place}: {first['msg']}".removeprefix(": "), parameter="requirements") from None


_LIST: TypeAdapter[list[Requirement]] = TypeAdapter(Annotated[list[Requirement], Field(max_length=MOST_REQUIREMENTS)])


def baseline_of(names: Sequence[str], baseline: str | None) -> str:
    """Return what changes are against: the one named, else passive, or the first where passive does not run."""
    return baseline or default_baseline(names)


def judge(
    requirements: Sequence[Requirement], driven: Mapping[str, Driven], baseline: str | None
) -> list[RequirementResult]:
    """Return how each strategy keeps each requirement.

    Args:
        requirements: What has to hold.
        driven: By strategy its summaries on each road, the same roads for all, or why it has none.
        baseline: As it was asked for.
    """
    base = baseline_of(list(driven), baseline)
    return [
        judged(requirement, name, driven, base)
        for requirement in requirements
        for name in requirement.strategies_judged(list(driven), baseline)
    ]


def judged(requirement: Requirement, strategy: str, driven: Mapping[str, Driven], base: str) -> RequirementResult:
    """Return how one strategy keeps a requirement, whose changes are against the strategy `base`."""
    own = driven.get(strategy, _NOT_RUN)
    held = _held(requirement, own, driven.get(base, _NOT_RUN))
    limits: dict[str, float | None] = {name: getattr(requirement, name) for name in LIMITS}
    against = None if requirement.max_change is None else base
    head = {"metric": requirement.metric, "strategy": strategy, "baseline": against, **limits}
    if isinstance(held, str):
        return RequirementResult(**head, result="fail", value=None, low=None, high=None, reason=held)
    low, high = _ends(held)
    worst, best = (low, high) if requirement.min is not None else (high, low)
    result: Result = "pass" if excess(requirement, worst) <= 0 else "uncertain"
    if excess(requirement, best) > 0:
        result = "fail"
    ends = {"low": low, "high": high} if len(own) > 1 else {"low": None, "high": None}
    return RequirementResult(**head, result=result, value=held.value, **ends, reason=None)


def used(requirement: Requirement, own: Driven, base: Driven) -> float:
    """Return how much of a limit is used: 1 where the worse end of the interval meets it; infinite without a value.

    Of a positive `max` it is the metric over its limit, of a positive `min` the limit over the metric, and so on
    where both are negative; beyond a limit 1 and the excess, over the limit's magnitude or 1.
    """
    held = _held(requirement, own, base)
    if isinstance(held, str):
        return inf
    low, high = _ends(held)
    limit, value = requirement.limit, low if requirement.min is not None else high
    beyond = excess(requirement, value) / (abs(limit) or 1)
    # A metric may be above a positive least value by any amount, and below a negative greatest one.
    is_passed = beyond < 0 and (limit > 0 if requirement.min is not None else limit < 0)
    return limit / value if is_passed else max(0.0, 1 + beyond)


def excess(requirement: Requirement, value: float) -> float:
    """By how much a value is beyond the limit, in the limit's unit; not above 0 where it keeps it."""
    return requirement.limit - value if requirement.min is not None else value - requirement.limit


def _ends(held: Interval) -> tuple[float, float]:
    """Return the interval; of one road the value itself."""
    return (held.low, held.high) if held.low <= held.high else (held.value, held.value)


def _held(requirement: Requirement, own: Driven, base: Driven) -> Interval | str:
    """Return what is held to the limit, or why there is nothing."""
    values = _values(requirement.metric, own)
    if isinstance(values, str) or requirement.max_change is None:
        return values if isinstance(values, str) else mean_with_interval(values)
    against = _values(requirement.metric, base)
    if isinstance(against, str):
        return f"The baseline: {against}"
    if sum(against) == 0:
        none = Interval(value=0, low=0, high=0)
        return none if not any(values) else "The baseline's is 0, so there is no change in %"
    return change_with_interval(values, against)


def _values(metric: str, driven: Driven) -> list[float] | str:
    """A metric on each road, or why there is none."""
    if isinstance(driven, str):
        return driven
    values = [METRICS[metric].of(summary) for summary in driven]
    return "It has no such metric" if None in values else [float(value) for value in values]
