"""The shape of a comparison in answers about a run."""

from typing import Annotated

from pydantic import Field

from backend.models import Answer, CautionAnswer, by_strategy
from sim_core.catalogue import PAPER_METRICS


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
