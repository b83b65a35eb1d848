"""The shapes of what is answered of many runs together; made in workers, so no web here."""

from typing import Annotated, Any

from pydantic import Field, WithJsonSchema

from backend.json_types import NUMBERS_SCHEMA
from backend.models import Answer

Cell = Annotated[
    Any,  # a whole number stays one
    WithJsonSchema(
        {
            "anyOf": [
                {"type": "number"},
                {"type": "string"},
                {"type": "boolean"},
                NUMBERS_SCHEMA,
                {"type": "object", "additionalProperties": {"type": "string"}},  # a controller's file and digest
                {"type": "null"},
            ]
        }
    ),
]


class Place(Answer):
    """A run, its value, and the swept fields' values there."""

    run: int
    value: float
    at: dict[str, Cell]


class Distribution(Answer):
    """Statistics of the runs that have the value; percentiles by linear interpolation (numpy's "linear" method)."""

    n: int
    mean: float | None
    quantiles: list[float] | None = Field(description="At the percentages in the answer's `quantiles`")
    lowest: Place | None
    highest: Place | None


class Sensitivity(Answer):
    """How a value follows one swept field."""

    field: str
    spearman: float = Field(description="Rank correlation: direction and strength of a monotone effect")
    p_value: float = Field(
        description="Probability of as much without any effect: the smaller of both tests', doubled (Bonferroni)"
    )
    effect: float = Field(
        description="Share of the ranks' variance this field alone explains, whatever the shape: Kruskal-Wallis' H "
        "over up to ten groups of its values, (H - k + 1)/(n - k)"
    )


class SensitiveDistribution(Distribution):
    """A distribution, and which fields it follows, the one that explains most first; seeds have no order."""

    sensitivity: list[Sensitivity]


class MarginSummary(SensitiveDistribution):
    """Change against the baseline strategy at the same point [%], over the points where both have the figure."""

    nominal: float | None = Field(description="Of the batch's own scenario [%]")
    pairs: int = Field(description="Points compared; `n` of them have a change, the others' baseline is 0")
    better: float | None = Field(description="Share of the pairs with a lower value than the baseline's")
    worse: float | None = Field(description="Share of the pairs with a higher one")


class FigureSummary(SensitiveDistribution):
    """One figure under one strategy; lower is better."""

    nominal: float | None = Field(description="Of the batch's own scenario, nothing swept")
    above_zero: int = Field(description="Runs with more than 0, of figures such as travel exceeded")
    margin: MarginSummary | None = Field(description="None for the baseline itself")


class StabilitySummary(SensitiveDistribution):
    """Least damping ratio of the closed loop near rest [1]; below 0 the loop is unstable."""

    known: int = Field(description="Runs whose loop could be judged")
    unstable: int
    nominal: float | None


class StrategySummary(Answer):
    """One strategy over all points."""

    ok: int
    failed: int
    unfinished: int = Field(description="Waiting or cancelled")
    reasons: dict[str, int] = Field(description="The commonest why runs failed")
    stability: StabilitySummary
    figures: dict[str, FigureSummary]


class UncertainRange(Answer):
    """A field nobody knows exactly, the range that a study samples, and where that range comes from."""

    field: str
    title: str
    unit: str
    low: float
    high: float
    why: str


class RobustnessDefaults(Answer):
    """The uncertain fields of a robustness study by default."""

    ranges: list[UncertainRange]
    samples: int
    strategies: list[str]
    baseline: str
    figures: list[str]
