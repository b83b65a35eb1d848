"""Requirements as they are sent and answered; `sim_core.comparison.requirements` decides what satisfies them."""

from typing import Annotated, Self

from pydantic import AfterValidator, Field, TypeAdapter, ValidationError, ValidationInfo, model_validator

from backend.errors import InvalidError
from backend.models import Answer, MetricName, RequestModel, StrategyId, inconsistent
from sim_core.comparison import requirements as core
from sim_core.comparison.requirements import LIMITS, Result, baseline_of

MOST_REQUIREMENTS = 64

Limit = Annotated[float, Field(ge=-1e12, le=1e12)]


class Requirement(RequestModel):
    """A limit that one metric has to satisfy: exactly one of `max`, `min` and `max_change`; the limit itself does."""

    metric: MetricName = Field(description="By its flat name, a column of a batch's table")
    max: Limit | None = Field(None, description="At most so much, in the metric's unit")
    min: Limit | None = Field(None, description="At least so much, in the metric's unit")
    max_change: Limit | None = Field(
        None, description="At most this change against the baseline [%]; -20 is: at least a fifth less than it"
    )
    # Any name: a stored requirement outlives the file of a controller. `_fits` refuses those that do not run.
    strategies: Annotated[list[StrategyId], Field(min_length=1, max_length=32)] | None = Field(
        None, description="Which have to satisfy it; null is all that run but the baseline"
    )

    @model_validator(mode="after")
    def _one_limit(self) -> Self:
        if sum(getattr(self, name) is not None for name in LIMITS) != 1:
            raise inconsistent("max", "A requirement has exactly one of max, min and max_change")
        return self

    def to_core(self) -> core.Requirement:
        """Return the same for the core, which decides what satisfies it."""
        return core.Requirement(**self.model_dump())


class JudgedRequirement(Answer):
    """A requirement of one strategy, whose result follows."""

    metric: str = Field(description="By its flat name")
    strategy: str
    baseline: str | None = Field(description="What a change is against, at the same point of a batch; null of others")
    max: float | None = Field(description="The requirement's limit, one of these three")
    min: float | None = Field(description="Likewise")
    max_change: float | None = Field(description="Likewise [%]")


class RequirementResult(JudgedRequirement):
    """The result of one strategy under one requirement."""

    result: Result = Field(description="`uncertain` where the interval over roads contains the limit")
    value: float | None = Field(
        description="What is held to the limit: the metric, over several roads its mean, or its change against the "
        "baseline [%]; null where there is none"
    )
    low: float | None = Field(description="Of its 95 % interval over roads; null on one road")
    high: float | None = Field(description="Likewise")
    reason: str | None = Field(description="Why there is no value, and so it fails; null where there is one")


def _fits(requirements: list[Requirement], info: ValidationInfo) -> list[Requirement]:
    """Check that requirements are about strategies that run, behind fields `strategies` and `baseline`."""
    names: list[str] = info.data.get("strategies", [])
    baseline = info.data.get("baseline")
    for index, requirement in enumerate(requirements if names else ()):
        judged, base = requirement.to_core().strategies_judged(names, baseline), baseline_of(names, baseline)
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


def read(text: str | None) -> list[Requirement]:
    """Return the requirements in a parameter of an address, as JSON; none where it was omitted.

    Raises:
        InvalidError: They are none.
    """
    try:
        return [] if text is None else _LIST.validate_json(text)
    except ValidationError as error:
        first = error.errors(include_input=False, include_url=False)[0]
        place = ".".join(map(str, first["loc"]))
        raise InvalidError(f"{place}: {first['msg']}".removeprefix(": "), parameter="requirements") from None


_LIST: TypeAdapter[list[Requirement]] = TypeAdapter(Annotated[list[Requirement], Field(max_length=MOST_REQUIREMENTS)])
