"""The shapes of what is answered of tunings, made from what is stored."""

from collections.abc import Sequence
from datetime import datetime
from typing import Any, Literal, Self

from pydantic import Field

from backend.jobs.problem import JobProblem
from backend.json_types import JsonObject
from backend.models import Answer, Source
from backend.store import StoredJob
from backend.store.job import State
from backend.store.trials import StoredTrial
from backend.tunings import front
from backend.tunings.comparison_models import TunedValue, TuningComparison
from backend.tunings.objectives import Limit, Objective
from backend.tunings.space import has_own_weights


class ObjectiveAnswer(Answer):
    """An objective with its name; `window` is never null for `paper` and `peaks`."""

    kind: Literal["paper", "peaks", "figure"]
    q: list[float]
    window: str | None
    figure: str | None
    label: str
    unit: str


class LimitAnswer(Answer):
    """A limit with its name."""

    figure: str
    at_most: float
    label: str
    unit: str


class Trial(Answer):
    """A set of weights and what it gave on the training roads."""

    number: int
    generation: int
    weights: dict[str, TunedValue] = Field(
        description="The strategy's weights, and what else was searched, by dotted name, to be put into the scenario "
        "as they are"
    )
    status: Literal["ok", "failed"]
    reason: str | None = Field(description="Of a failed one")
    feasible: bool = Field(description="Within every limit on every training road; failed ones are not")
    values: list[float] | None = Field(description="An objective each: its mean, or quantile, over the training roads")
    limits: list[float] | None = Field(description="A limit each: the largest over the training roads")


class Generation(Answer):
    """How far the search was after a generation."""

    generation: int
    trials: int = Field(description="So far")
    feasible: int = Field(description="So far")
    best: list[float | None] = Field(description="Smallest feasible value of each objective so far")
    hypervolume: float | None = Field(
        description="Share of the box between zero and the paper's weights' values that the front dominates: with one "
        "objective how much smaller it got; null where the paper's value of an objective is zero or missing"
    )

    @classmethod
    def of(cls, event: JsonObject) -> Self:
        """Make it from its event, which counts the generations that are complete."""
        return cls(
            generation=event["generation"] - 1,
            trials=event["done"] + event["failed"],
            feasible=event["feasible"],
            best=event["best"],
            hypervolume=event["hypervolume"],
        )


class TrialCounts(Answer):
    """Numbers of trials."""

    total: int
    done: int
    failed: int
    feasible: int


class TuningItem(Answer):
    """A tuning in a list."""

    id: str
    state: State
    reason: str | None = Field(description="Why it failed, or does not advance")
    problem: JobProblem | None = Field(None, description="Where planning it failed: what a dry run would have answered")
    step: Literal["search", "comparison"] = Field(description="What it does, or did last")
    label: str | None
    position: int = Field(description="Runs waiting before it: 0, its batches have positions of their own")
    strategy: str
    source: Source | None = Field(None, description="What the controller is; null for Ridelab's own")
    objectives: list[ObjectiveAnswer]
    limits: list[LimitAnswer]
    search: dict[str, list[float]]
    previews: list[str] | None = Field(
        None, description="Kinds of preview searched; null where only the scenario's is used"
    )
    seeds: list[int]
    fresh_seeds: list[int]
    uncertain: bool = False
    quantile: float | None = Field(None, description="Of the objectives over the roads; null for their means")
    population: int
    seed: int
    trials: TrialCounts
    generation: int = Field(description="Generations that are complete")
    batch: str | None = Field(description="The batch it waits for, or waited for last")
    core_version: str
    estimated_cost: float | None = Field(description="Estimate [s of one core]; null until it is planned")
    created_at: datetime
    started_at: datetime | None
    finished_at: datetime | None

    @classmethod
    def of(cls, job: StoredJob) -> Self:
        """Make the answer of a stored tuning."""
        return cls(**cls._fields(job))

    @staticmethod
    def _fields(job: StoredJob) -> dict[str, Any]:
        names = ("id", "state", "reason", "label", "core_version", "created_at", "started_at", "finished_at")
        trials = TrialCounts(total=job.total, done=job.done, failed=job.failed, feasible=job.progress["feasible"])
        return {
            **job.request,
            **job.progress,
            **{name: getattr(job, name) for name in names},
            "position": 0,
            "estimated_cost": job.estimated_cost if job.is_planned else None,
            "objectives": [Objective.model_validate(each) for each in job.request["objectives"]],
            "limits": [Limit.model_validate(each) for each in job.request["limits"]],
            "trials": trials,
            "scenario": job.scenario,
        }


class Tuning(TuningItem):
    """A tuning in its present state."""

    scenario: JsonObject
    paper: Trial | None = Field(
        description="The paper's weights, or the defaults of a custom controller; null until the first generation is "
        "complete"
    )
    own: Trial | None = Field(description="The scenario's own weights where they are not the paper's")
    best: list[Trial | None] = Field(description="An objective each: the feasible trial with its smallest value")
    knee: Trial | None = Field(description="Of several objectives: the point of the front nearest to its ideal corner")
    front: list[Trial] = Field(description="Feasible trials that no other one betters, by the first objective")
    history: list[Generation]
    comparison: TuningComparison | None

    @classmethod
    def whole(cls, job: StoredJob, trials: Sequence[StoredTrial], history: Sequence[JsonObject]) -> Self:
        """Make the answer of a stored tuning with its trials and the events of its generations."""
        request = job.request
        members = front.front(trials)
        return cls(
            **cls._fields(job),
            paper=trials[0] if trials else None,
            own=trials[1] if has_own_weights(request, trials) else None,
            best=[front.best(trials, index) for index in range(len(request["objectives"]))],
            knee=front.knee(members),
            front=members,
            history=[Generation.of(event) for event in history],
            comparison=job.answer,
        )


class Tunings(Answer):
    """A page of tunings, the newest first."""

    tunings: list[TuningItem]
    next: str | None = Field(description="Cursor of the next page; null on the last one")


class Trials(Answer):
    """Every trial, in order."""

    tuning: str
    trials: list[Trial]


class TuningEstimate(Answer):
    """The size and the estimated time of a tuning."""

    runs: int = Field(description="Of the search and the comparison, the passive car's included")
    generations: int
    estimated_cost: float = Field(description="Estimate, which is compared with the limit [s of one core]")
    estimated_seconds: float | None = Field(description="By some runs tried just now [s]; none where trying takes long")
