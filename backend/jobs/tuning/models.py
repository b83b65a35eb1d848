"""The shapes of tuning requests and answers."""

from collections.abc import Mapping, Sequence
from dataclasses import asdict
from datetime import datetime
from typing import Annotated, Any, Literal, Self

from pydantic import AfterValidator, BeforeValidator, ConfigDict, Field, model_validator
from pydantic_core import PydanticCustomError

from backend.analysis import front
from backend.analysis.objectives import objective_label, objective_unit
from backend.jobs.models import Label
from backend.jobs.tuning.space import LARGEST, STRATEGIES, default_search, first_weights, searchable
from backend.models import Answer, RequestModel
from backend.store import StoredJob
from backend.store.jobs import State
from backend.store.trials import StoredTrial
from sim_core.catalogue import METRICS, NUMBERS, WINDOWS
from sim_core.scenario import Scenario

MOST_TRIALS = 5000
MOST_POPULATION = 256
MOST_SEEDS = 64
NORMALISED_WINDOW = {"paper": "whole", "peaks": "bump"}  # where a request names none


def _known_figure(name: str) -> str:
    if name not in NUMBERS:
        raise PydanticCustomError("unknown_figure", "Unknown figure; there are {names}", {"names": ", ".join(NUMBERS)})
    return name


def _increasing(ends: tuple[float, float]) -> tuple[float, float]:
    if not ends[0] < ends[1]:
        raise PydanticCustomError("empty_range", "A range is [lowest, highest], the first smaller than the second")
    return ends


def _each_once(seeds: list[int]) -> list[int]:
    if len(set(seeds)) != len(seeds):
        raise PydanticCustomError("repeated", "Each seed may be there once")
    return seeds


def _known_weights(search: Any) -> Any:
    """Names first: what an unknown one holds is of no use."""
    for name in search if isinstance(search, dict) else ():
        if name not in WEIGHTS:
            context = {"key": name, "what": "weight", "known": WEIGHTS}
            raise PydanticCustomError("unknown_key", "Unknown weight", context)
    return search


WEIGHTS = list(dict.fromkeys(name for strategy in STRATEGIES for name in searchable(strategy)))
Figure = Annotated[str, AfterValidator(_known_figure), Field(json_schema_extra={"enum": list(NUMBERS)})]
Coefficient = Annotated[float, Field(ge=0, le=1000)]
End = Annotated[float, Field(gt=0, le=LARGEST)]
Range = Annotated[tuple[End, End], Field(strict=False), AfterValidator(_increasing)]
Seed = Annotated[int, Field(ge=0, le=2**32 - 1)]
Seeds = Annotated[list[Seed], AfterValidator(_each_once)]


def _at(field: str, message: str) -> PydanticCustomError:
    return PydanticCustomError("inconsistent", "{reason}", {"field": field, "reason": message})


class Objective(RequestModel):
    """What to make small, as its mean over the training roads.

    `paper` is Eq. 16: q1 (a/a_p)² + q2 (r/r_p)² + q3 (F/F_p)² of the RMS of body and pitch acceleration and tyre load
    (both tyres) over the passive car's on the same road; `peaks` the same with peaks; `figure` one figure of a run.
    """

    kind: Literal["paper", "peaks", "figure"]
    q: Annotated[tuple[Coefficient, Coefficient, Coefficient], Field(strict=False)] = Field(
        (1, 1, 1), description="Of paper and peaks: q1 body acceleration, q2 pitch acceleration, q3 tyre load"
    )
    window: Literal["rough_road", "bump", "whole"] | None = Field(
        None, description="Of paper (without one whole) and peaks (bump)", json_schema_extra={"enum": [*WINDOWS, None]}
    )
    figure: Figure | None = Field(None, description="Of figure: a name of a batch's columns")

    @model_validator(mode="after")
    def _fits_its_kind(self) -> Self:
        if (self.figure is not None) != (self.kind == "figure"):
            raise _at("figure", "A figure is named with the kind figure, and only there")
        if self.kind == "figure" and (self.window is not None or self.q != (1, 1, 1)):
            raise _at("q" if self.window is None else "window", "Only the kinds paper and peaks take this")
        if not any(self.q):
            raise _at("q", "At least one coefficient must be greater than 0")
        return self

    def stored(self) -> dict[str, Any]:
        """Written out, as it is kept; a figure is as it is and its `q` is not used."""
        window = self.window or NORMALISED_WINDOW.get(self.kind)
        return {"kind": self.kind, "q": list(self.q), "window": window, "figure": self.figure}


class Limit(RequestModel):
    """A figure that may not be exceeded on any training road."""

    figure: Figure
    at_most: float = Field(ge=-1e12, le=1e12)


class TuningRequest(RequestModel):
    """What to tune, for what, on which roads."""

    model_config = ConfigDict(
        json_schema_extra={
            "examples": [
                {
                    "strategy": "lv",
                    "objectives": [{"kind": "paper"}],
                    "limits": [{"figure": "events.travel_exceeded_mm", "at_most": 0}],
                    "trials": 32,
                },
                {
                    "strategy": "lqr",
                    "objectives": [{"kind": "paper"}, {"kind": "figure", "figure": "bump.body_acceleration.peak"}],
                    "search": {"lqr.weights.0": [0.1, 10], "lqr.weights.2": [0.1, 10]},
                    "trials": 8,
                    "population": 4,
                    "dry_run": True,
                },
            ]
        }
    )

    scenario: Scenario = Scenario()
    strategy: Literal["lv", "suspension_only", "lqr"] = Field("lv", json_schema_extra={"enum": list(STRATEGIES)})
    objectives: list[Objective] = Field([Objective(kind="paper")], min_length=1, max_length=3)
    limits: list[Limit] = Field([], max_length=8)
    search: Annotated[dict[str, Range] | None, BeforeValidator(_known_weights)] = Field(
        None,
        min_length=1,
        max_length=16,
        description="Weight -> [lowest, highest], searched on a logarithmic scale; what is not named keeps the "
        "scenario's value. Without it every weight of the strategy, 0.05 to 50.",
        json_schema_extra={"propertyNames": {"enum": [*WEIGHTS]}},
    )
    seeds: Seeds = Field([1, 2, 3, 4], min_length=1, max_length=MOST_SEEDS, description="Roads trained on")
    fresh_seeds: Seeds = Field(
        list(range(101, 111)), min_length=2, max_length=MOST_SEEDS, description="Roads compared on, none trained on"
    )
    trials: int = Field(
        200, ge=1, le=MOST_TRIALS, description="Sets of weights, the paper's and the scenario's included"
    )
    population: int = Field(16, ge=1, le=MOST_POPULATION, description="Sets of weights tried at once: a generation")
    seed: int = Field(0, ge=0, le=2**32 - 1, description="Of the search: same request, same trials")
    label: Label = None
    dry_run: bool = Field(False, description="Only check and estimate: nothing is stored or computed")

    @model_validator(mode="after")
    def _consistent(self) -> Self:
        if set(self.seeds) & set(self.fresh_seeds):
            raise _at("fresh_seeds", "A fresh road is none that was trained on")
        written = [objective.stored() for objective in self.objectives]
        if any(each in written[:index] for index, each in enumerate(written)):
            raise _at("objectives", "Each objective may be there once")
        known = searchable(self.strategy)
        if self.search is not None and not set(self.search) <= set(known):
            raise _at("search", f"The weights of this strategy are {', '.join(known)}")
        return self

    @property
    def ranges(self) -> dict[str, Range]:
        """What is searched, the default written out, in the strategy's order."""
        wanted = default_search(self.strategy) if self.search is None else self.search
        return {name: wanted[name] for name in searchable(self.strategy) if name in wanted}

    def stored(self) -> dict[str, Any]:
        """All written out, without the number of trials, which resuming may change."""
        return {
            **self.model_dump(mode="json", exclude={"trials", "dry_run", "label"}),
            "objectives": [objective.stored() for objective in self.objectives],
            "search": {name: list(ends) for name, ends in self.ranges.items()},
        }


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
    weights: dict[str, float | list[float]] = Field(
        description="The strategy's weights by dotted name, to be put into the scenario as they are"
    )
    status: Literal["ok", "failed"]
    reason: str | None = Field(description="Of a failed one")
    feasible: bool = Field(description="Within every limit on every training road; failed ones are not")
    values: list[float] | None = Field(description="An objective each: means over the training roads")
    limits: list[float] | None = Field(description="A limit each: the largest over the training roads")

    @classmethod
    def of(cls, trial: StoredTrial) -> Self:
        """A stored trial."""
        return cls(**asdict(trial))


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
    def of(cls, told: Mapping[str, Any]) -> Self:
        """From what its event told, which counts the generations that are complete."""
        return cls(
            generation=told["generation"] - 1,
            trials=told["done"] + told["failed"],
            feasible=told["feasible"],
            best=told["best"],
            hypervolume=told["hypervolume"],
        )


class TunedChange(Answer):
    """Change of a mean against the paper's weights, paired by road, with its 95 % interval [%]."""

    value: float
    low: float | None = Field(description="Null on one road")
    high: float | None


class TunedFigures(Answer):
    """One figure of one set of weights over some roads."""

    mean: float
    worst: float = Field(description="The largest over the roads")
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
    weights: dict[str, float | list[float]]
    training: dict[str, TunedFigures] = Field(description="By the figures' keys, over the training roads")
    fresh: dict[str, TunedFigures] = Field(description="The same over the fresh roads")
    verdict: list[Literal["better", "worse", "unclear"]] | None = Field(
        description="An objective each, on the fresh roads against the paper's weights: whether the interval of the "
        "change lies below zero, above it, or holds it; null for the paper's own"
    )
    failures: list[str] = Field(description="Roads it could not be run on; the figures leave them out")


class Comparison(Answer):
    """The paper's weights and the tuned ones over the training roads and over fresh ones."""

    batch: str = Field(description="Whose rows these figures are made of")
    figures: list[ComparedFigure]
    points: list[ComparedPoint] = Field(description="The paper's weights first")


class TrialCounts(Answer):
    """Trials."""

    total: int
    done: int
    failed: int
    feasible: int


class TuningItem(Answer):
    """A tuning in a list."""

    id: str
    state: State
    reason: str | None = Field(description="Why it failed")
    step: Literal["search", "comparison"] = Field(description="What it does, or did last")
    label: str | None
    position: int = Field(description="Runs waiting before it: 0, its batches have positions of their own")
    strategy: str
    objectives: list[ObjectiveAnswer]
    limits: list[LimitAnswer]
    search: dict[str, list[float]]
    seeds: list[int]
    fresh_seeds: list[int]
    population: int
    seed: int
    trials: TrialCounts
    generation: int = Field(description="Generations that are complete")
    batch: str | None = Field(description="The batch it waits for, or waited for last")
    core_version: str
    estimated_cost: float = Field(description="Estimate [s of one core]")
    created_at: datetime
    started_at: datetime | None
    finished_at: datetime | None

    @classmethod
    def of(cls, job: StoredJob) -> Self:
        """A stored tuning."""
        return cls(**cls._fields(job))

    @staticmethod
    def _fields(job: StoredJob) -> dict[str, Any]:
        request, progress = job.request, job.progress
        times = ("created_at", "started_at", "finished_at")
        same = ("id", "state", "reason", "label", "core_version", "estimated_cost", *times)
        asked = ("strategy", "search", "seeds", "fresh_seeds", "population", "seed")
        return {
            **{name: getattr(job, name) for name in same},
            **{name: request[name] for name in asked},
            "position": 0,
            "step": progress["step"],
            "generation": progress["generation"],
            "batch": progress["batch"],
            "objectives": [
                {**each, "label": objective_label(each), "unit": objective_unit(each)} for each in request["objectives"]
            ],
            "limits": [
                {**each, "label": METRICS[each["figure"]].label, "unit": METRICS[each["figure"]].unit}
                for each in request["limits"]
            ],
            "trials": TrialCounts(total=job.total, done=job.done, failed=job.failed, feasible=progress["feasible"]),
        }


class Tuning(TuningItem):
    """A tuning as it stands."""

    scenario: dict[str, Any]
    paper: Trial | None = Field(description="The paper's weights; null until the first generation is complete")
    own: Trial | None = Field(description="The scenario's own weights where they are not the paper's")
    best: list[Trial | None] = Field(description="An objective each: the feasible trial with its smallest value")
    knee: Trial | None = Field(description="Of several objectives: the point of the front nearest to its ideal corner")
    front: list[Trial] = Field(description="Feasible trials that no other one betters, by the first objective")
    history: list[Generation]
    comparison: Comparison | None

    @classmethod
    def whole(cls, job: StoredJob, trials: Sequence[StoredTrial], history: Sequence[Mapping[str, Any]]) -> Self:
        """A stored tuning with its trials and what the events of its generations told."""
        request = job.request
        own = len(first_weights(request["scenario"], request["strategy"], request["search"])) > 1
        members = front.front(trials)
        return cls(
            **cls._fields(job),
            scenario=request["scenario"],
            paper=_trial(trials[0] if trials else None),
            own=_trial(trials[1] if own and len(trials) > 1 else None),
            best=[_trial(front.best(trials, index)) for index in range(len(request["objectives"]))],
            knee=_trial(front.knee(members)),
            front=[Trial.of(each) for each in members],
            history=[Generation.of(told) for told in history],
            comparison=None if job.answer is None else Comparison.model_validate(job.answer),
        )


def _trial(trial: StoredTrial | None) -> Trial | None:
    return None if trial is None else Trial.of(trial)


class Tunings(Answer):
    """The newest first."""

    tunings: list[TuningItem]
    next: str | None = Field(description="Cursor of the next page; null on the last one")


class Trials(Answer):
    """Every trial, in order."""

    tuning: str
    trials: list[Trial]


class TuningEstimate(Answer):
    """What a tuning would be."""

    runs: int = Field(description="Of the search and the comparison, the passive car's included")
    generations: int
    estimated_cost: float = Field(description="Estimate, which is compared with the limit [s of one core]")
    estimated_seconds: float | None = Field(description="By some runs tried just now [s]; none where trying takes long")
