"""The shapes of batch requests and answers."""

from datetime import datetime
from typing import Annotated, Literal, Self

from pydantic import ConfigDict, Field

from backend.batches.points import Sweep
from backend.batches.summary_models import Cell, StrategySummary
from backend.jobs.models import Label
from backend.jobs.problem import JobProblem
from backend.json_types import JsonObject
from backend.models import Answer, RequestModel, SentScenario, StrategyName
from backend.requirements import JudgedRequirement, Requirement, Requirements
from backend.store import StoredJob
from backend.store.job import State
from sim_core.comparison.requirements import Result
from sim_core.scenario import Scenario, dotted


class BatchRequest(RequestModel):
    """What to run: each point of the sweep under each strategy."""

    scenario: SentScenario = Scenario()
    strategies: list[StrategyName] = Field(min_length=1, max_length=32)
    baseline: StrategyName | None = Field(
        None, description="What a requirement's change is against, at the same point; null is passive, or the first"
    )
    requirements: Requirements = Field([])
    sweep: Sweep
    label: Label = None
    dry_run: bool = Field(False, description="Only check and estimate: nothing is stored or computed")


class BatchField(Answer):
    """A field the sweep changes."""

    name: str
    title: str
    unit: str
    linked_to: str | None = Field(None, description="The swept field whose value it takes")


class BatchItem(Answer):
    """A batch in a list; `done` runs succeeded, `failed` runs did not and say why in their rows."""

    id: str
    state: State
    reason: str | None = Field(description="Why the batch as a whole failed, or does not advance")
    problem: JobProblem | None = Field(description="Where planning it failed: what a dry run would have answered")
    label: str | None
    position: int = Field(description="Runs of batches accepted earlier that wait, until it runs: then they take turns")
    total: int | None = Field(description="Runs; null until it is planned")
    done: int
    failed: int
    core_version: str = Field(description="That accepted it; each row names the one that computed it")
    scenario: JsonObject
    strategies: list[str]
    fields: list[BatchField] | None = Field(description="What the sweep changes; null until it is planned")
    baseline: str | None = Field(None, description="What its requirements' changes are against; null is passive")
    requirements: list[Requirement] = Field([], description="What its runs are held to; `/requirements` says how")
    estimated_cost: float | None = Field(description="Estimate [s of one core]; null until it is planned")
    created_at: datetime
    started_at: datetime | None
    finished_at: datetime | None

    @classmethod
    def from_stored(cls, job: StoredJob, position: int, **more: object) -> Self:
        """Make the answer of a stored sweep with its place in the queue."""
        linked = job.request.get("linked", {})
        leaders = {field: name for name, fields in linked.items() for field in fields}
        own = {name: getattr(job, name) for name in cls.model_fields if hasattr(job, name)}
        own["fields"] = [_field(name, leaders.get(name)) for name in job.request["fields"]]
        if not job.is_planned:
            own |= dict.fromkeys(("total", "fields", "estimated_cost"))
        return cls(**job.request | own, problem=job.progress.get("problem"), position=position, **more)


def _field(name: str, leader: str | None) -> BatchField:
    described = dotted.fields().get(name)
    title, unit = (name, "1") if described is None else (described.title, described.unit)
    return BatchField(name=name, title=title, unit=unit, linked_to=leader)


class Batch(BatchItem):
    """A batch in its present state; its sweep has an address of its own."""

    resumable: bool = Field(description="Whether it has ended and something of it can be run, or planned, again")


class Estimate(Answer):
    """The size and the estimated time of a batch."""

    points: int
    total: int = Field(description="Runs: points times strategies")
    contradictory: int = Field(description="Runs whose fields contradict each other: they would be failed rows")
    estimated_cost: float = Field(description="Estimate, which is compared with the limit [s of one core]")
    estimated_seconds: float | None = Field(description="By some runs tried just now [s]; none where trying takes long")


class Batches(Answer):
    """A page of batches, the newest first."""

    batches: list[BatchItem]
    next: str | None = Field(description="Cursor of the next page; null on the last one")


class FailingRun(Answer):
    """A run that fails a requirement."""

    run: int
    value: float = Field(description="What is held to the limit")
    at: dict[str, Cell] = Field(description="The swept fields' values there, by dotted name")


class BatchRequirementResult(JudgedRequirement):
    """How the runs of one strategy keep one requirement."""

    result: Result = Field(description="`pass` where all runs do, `uncertain` while none fails and some have not ended")
    counts: dict[str, int] = Field(
        description="How many runs `pass`, `fail`, are `not_computed`, which is no pass either, and are `unfinished`"
    )
    first_failure: FailingRun | None = Field(description="The first run that fails, in order; null without any")
    worst_failure: FailingRun | None = Field(description="The one furthest beyond the limit; likewise")
    reason: str | None = Field(description="Why the first run that is not computed has no value; null without any")


class BatchRequirements(Answer):
    """How a batch's runs keep its requirements; empty where it has none."""

    batch: str
    state: State
    requirement_results: list[BatchRequirementResult]
    runs: list[Result | None] = Field(
        description="Of each run in order the worst of its results; null where it has none, or has not ended"
    )


class BatchTable(Answer):
    """A batch's rows column by column."""

    batch: str
    state: State
    units: dict[str, str]
    columns: dict[str, list[Cell]]


class BatchRow(Answer):
    """A run of a batch; further members are the swept fields by name and, of a run with status ok, its figures."""

    model_config = ConfigDict(json_schema_serialization_defaults_required=False)

    run: int
    strategy: str
    status: Literal["ok", "failed", "waiting", "cancelled"]
    reason: Annotated[str | None, Field(description="Of a failed run")] = None
    kind: Annotated[
        Literal["refused", "too-expensive"] | None,
        Field(
            description="Of a failure that follows from scenario and program; `too-expensive` where the run would take "
            "more computing than one may"
        ),
    ] = None
    fields: Annotated[list[str] | None, Field(description="Which scenario fields make such a run cheaper")] = None


class BatchResults(Answer):
    """The runs of a batch, in order."""

    batch: str
    core_version: str
    scenario: JsonObject
    sweep: JsonObject
    units: dict[str, str]
    rows: list[BatchRow]
    next: int | None = Field(description="Cursor of the next page; null on the last one")


class BatchSummary(Answer):
    """What a batch's finished runs say as a whole."""

    batch: str
    state: State
    core_version: str = Field(
        description="That computes `nominal` and `stability`; the rows' metrics are those of the versions rows name"
    )
    points: int
    baseline: str
    quantiles: list[float] = Field(description="Percentages of every list of quantiles below")
    units: dict[str, str]
    strategies: dict[str, StrategySummary]
