"""The shapes of what is answered of many runs together; made in workers, so no web here."""

from typing import Literal

from pydantic import Field

from backend.models import Answer

TunedValue = int | float | str | list[float]  # a weight, three of them, a time, a number of steps, a choice

Verdict = Literal["better", "worse", "unclear"]


class TunedChange(Answer):
    """Change of a mean against the paper's weights, paired by road, with its 95 % interval [%]."""

    value: float
    low: float | None = Field(description="Null on one road")
    high: float | None


class TunedFigures(Answer):
    """One figure of one set of weights over some roads."""

    mean: float
    worst: float = Field(description="The largest over the roads")
    quantile: float | None = Field(None, description="At the tuning's `quantile`; null where it has none")
    change: TunedChange | None = Field(description="Null for the paper's weights themselves and against zero")


class ComparedFigure(Answer):
    """A column of the comparison."""

    key: str = Field(description="objectives.0, limits.0, or a figure's name")
    label: str
    unit: str


class ComparedPoint(Answer):
    """One set of weights beside the paper's."""

    trial: int
    roles: list[str] = Field(description="paper, scenario, best.0 (of the first objective), knee")
    weights: dict[str, TunedValue]
    training: dict[str, TunedFigures] = Field(description="By the figures' keys, over the training roads")
    fresh: dict[str, TunedFigures] = Field(description="By figure over the validation roads")
    verdict: list[Verdict] | None = Field(
        description="One for each objective, on the validation roads against the paper's weights: whether the interval "
        "of the change lies below zero, above it, or holds it; null for the paper's own"
    )
    failures: list[str] = Field(description="Roads it could not be run on; the figures leave them out")


class TuningComparison(Answer):
    """The paper's weights and the tuned ones over the training roads and over fresh ones."""

    batch: str = Field(description="The batch whose rows give these figures")
    figures: list[ComparedFigure]
    points: list[ComparedPoint] = Field(description="The paper's weights first")
