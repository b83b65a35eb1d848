"""The shapes of batch requests and answers."""

from datetime import datetime
from typing import Annotated, Any, Literal, Self

from pydantic import ConfigDict, Field

from backend.jobs.models import Label
from backend.jobs.sweep.sweeps import Sweep
from backend.models import Answer, RequestModel, StrategyName
from backend.store import StoredJob
from backend.store.jobs import State
from sim_core.scenario import Scenario, dotted


class BatchRequest(RequestModel):
    """What to run: each point of the sweep under each strategy."""

    model_config = ConfigDict(
        json_schema_extra={
            "examples": [
                {"strategies": ["lv", "passive"], "sweep": {"grid": {"road.bump.height": [0.05, 0.1]}}},
                {
                    "strategies": ["lqr"],
                    "sweep": {"latin_hypercube": {"ranges": {"speed.target_speed_kmh": [20, 40]}, "samples": 3}},
                },
                {"strategies": ["passive"], "sweep": {"list": [{"road.seed": 2}, {"road.seed": 3}]}, "dry_run": True},
            ]
        }
    )

    scenario: Scenario = Scenario()
    strategies: list[StrategyName] = Field(min_length=1, max_length=32)
    sweep: Sweep
    label: Label = None
    dry_run: bool = Field(False, description="Only check and estimate: nothing is stored or computed")


class BatchField(Answer):
    """A field the sweep changes."""

    name: str
    title: str
    unit: str


class BatchItem(Answer):
    """A batch in a list; `done` runs succeeded, `failed` runs did not and say why in their rows."""

    id: str
    state: State
    reason: str | None = Field(description="Why the batch as a whole failed")
    label: str | None
    position: int = Field(description="Runs of batches accepted earlier that wait; they take turns with this one's")
    total: int
    done: int
    failed: int
    core_version: str = Field(description="That accepted it; each row names the one that computed it")
    scenario: dict[str, Any]
    strategies: list[str]
    fields: list[BatchField]
    estimated_cost: float = Field(description="Estimate [s of one core]")
    created_at: datetime
    started_at: datetime | None
    finished_at: datetime | None

    @classmethod
    def of(cls, job: StoredJob, position: int) -> Self:
        """A stored sweep with its place in the queue."""
        known = dotted.fields()
        fields = [
            BatchField(name=name, title=known[name].title, unit=known[name].unit)
            if name in known
            else BatchField(name=name, title=name, unit="1")
            for name in job.request["fields"]
        ]
        own = {name: getattr(job, name) for name in cls.model_fields if hasattr(job, name)}
        return cls(**own, **job.request | {"fields": fields}, position=position)


class Batch(BatchItem):
    """A batch as it stands."""

    sweep: dict[str, Any]


class Estimate(Answer):
    """What a batch would be."""

    points: int
    total: int = Field(description="Runs: points times strategies")
    contradictory: int = Field(description="Runs whose fields contradict each other: they would be failed rows")
    estimated_cost: float = Field(description="Estimate, which is compared with the limit [s of one core]")
    estimated_seconds: float | None = Field(description="By some runs tried just now [s]; none where trying takes long")


class Batches(Answer):
    """The newest first."""

    batches: list[BatchItem]
    next: str | None = Field(description="Cursor of the next page; null on the last one")


class BatchTable(Answer):
    """A batch's rows column by column."""

    batch: str
    state: State
    units: dict[str, str]
    columns: dict[str, list[float | str | bool | list[float] | None]]


class BatchRow(Answer):
    """A run of a batch; further members are the swept fields by name and, of a run with status ok, its figures."""

    model_config = ConfigDict(json_schema_serialization_defaults_required=False)

    run: int
    strategy: str
    status: Literal["ok", "failed", "waiting", "cancelled"]
    reason: Annotated[str | None, Field(description="Of a failed run")] = None
    kind: Annotated[
        Literal["too-expensive"] | None,
        Field(description="`too-expensive` where a failed run would take more computing than one may"),
    ] = None
    fields: Annotated[list[str] | None, Field(description="Which scenario fields make such a run cheaper")] = None


class BatchResults(Answer):
    """Every run of a batch, in order."""

    batch: str
    core_version: str
    scenario: dict[str, Any]
    sweep: dict[str, Any]
    units: dict[str, str]
    rows: list[BatchRow]


Cell = float | str | bool | list[float] | None


class Place(Answer):
    """A run, its value, and the swept fields' values there."""

    run: int
    value: float
    at: dict[str, Cell]


class Distribution(Answer):
    """Of the runs that have the value; percentiles lie between two values by distance (numpy's "linear" method)."""

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
    """Least damping ratio of the closed loop's modes near rest [1]; below 0 the loop is unstable."""

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


class BatchSummary(Answer):
    """What a batch's finished runs say as a whole."""

    batch: str
    state: State
    points: int
    baseline: str
    quantiles: list[float] = Field(description="Percentages of every list of quantiles below")
    units: dict[str, str]
    strategies: dict[str, StrategySummary]


class UncertainRange(Answer):
    """A field nobody knows exactly and the range a study takes it from."""

    field: str
    title: str
    unit: str
    low: float
    high: float
    why: str


class RobustnessDefaults(Answer):
    """What a robustness study varies unless told otherwise."""

    ranges: list[UncertainRange]
    samples: int
    strategies: list[str]
    baseline: str
    figures: list[str]
