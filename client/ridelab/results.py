"""A service's answers, typed. Values are in SI units, speeds that people type in km/h; `units` names each."""

import math
from collections.abc import Iterator, Mapping, Sequence
from dataclasses import dataclass, field
from typing import TYPE_CHECKING, Any, Literal, Self, TypedDict
from urllib.parse import quote

from ridelab import notebooks
from ridelab.connection import Connection
from ridelab.jobs import Batch
from ridelab.requirements import RequirementResult

if TYPE_CHECKING:
    import pandas as pd
    import plotly.graph_objects as go


Figure = float | bool | None
_AVERAGED = {"metrics", "comfort"}
_INTERVAL = {"mean", "low", "high"}


@dataclass(frozen=True, slots=True, kw_only=True, repr=False)
class Interval:
    """A mean over roads, or a change of means [%], with its 95 % interval."""

    mean: float
    low: float
    high: float

    def __repr__(self) -> str:
        """Such as `1.09 ± 0.16`: half the width with two digits, the mean with as many decimals."""
        size = math.floor(math.log10(self.half)) if 0 < self.half < math.inf else 0
        decimals = max(0, 1 - size)
        return f"{self.mean:.{decimals}f} ± {self.half:.{decimals}f}"

    @property
    def half(self) -> float:
        """Half the interval's width."""
        return self.high - self.mean


class Statistics(TypedDict):
    """One signal in one window, in the signal's unit; over several roads means with their intervals."""

    rms: float | Interval
    peak: float | Interval


class Stage(TypedDict):
    """One driving stage, by the front axle: times [s], positions [m]."""

    stage: str
    start_time: float
    end_time: float
    start_position: float
    end_position: float


@dataclass(frozen=True, slots=True, kw_only=True)
class Outcome:
    """One strategy of a run. A failed one has a reason, no metrics, and NaN for its figures.

    Attributes:
        strategy: Its id.
        status: Whether the core could run it.
        reason: Why not, where it failed.
        kind: None where it ran. `refused` and `too-expensive`, where it would take more computing than one run may,
            follow from scenario and program; `unavailable` may have passed, and is tried again when it is asked for.
        fields: Which scenario fields make it cheaper, by dotted names.
        cached: Not computed for this request; None where the answer does not tell.
        compute_ms: The worker's own time [ms].
        metrics: window -> signal -> statistic; an `Interval` each where the run is over several roads.
        comfort: ISO 2631-1 and what stands beside it; likewise.
        events: Counts, times, true or false; None where it does not apply.
        reference: Lines a plot draws.
        stages: The driving stages in order.
        travel_time: Front axle from x = 0 to the road's end [s].
        arrival_speed_kmh: Speed when the front axle meets the bump [km/h].
        recording: Of a recording how it became this outcome, whose numbers may be None: where it lies on the road and
            why (`offset` [m], `scale`, `likeness`, `reference`, `start`, `end` [m]), signals `missing`, and `notes`.
    """

    strategy: str
    status: Literal["ok", "failed"]
    compute_ms: float
    reason: str | None = None
    kind: str | None = None
    fields: Sequence[str] = ()
    cached: bool | None = None
    metrics: Mapping[str, Mapping[str, Statistics]] = field(default_factory=dict, repr=False)
    comfort: Mapping[str, float | Interval] = field(default_factory=dict, repr=False)
    events: Mapping[str, Figure] = field(default_factory=dict, repr=False)
    reference: Mapping[str, float | None] = field(default_factory=dict, repr=False)
    stages: list[Stage] = field(default_factory=list, repr=False)
    travel_time: float = math.nan
    arrival_speed_kmh: float = math.nan
    recording: Mapping[str, Any] | None = field(default=None, repr=False)

    @classmethod
    def of(cls, strategy: str, answer: Mapping[str, Any]) -> Self:
        """The outcome in a run's answer; fields of a newer service are ignored."""
        read = {key: value for key, value in answer.items() if key in cls.__dataclass_fields__ and key != "strategy"}
        return cls(strategy=strategy, **{**read, **{key: intervals(read[key]) for key in _AVERAGED & read.keys()}})

    def figures(self) -> dict[str, Figure]:
        """Every metric by its flat name, as the columns of a batch's table are named; empty where it failed.

        Over several roads they are the means.
        """
        if self.status != "ok":
            return {}
        whole = {"travel_time": self.travel_time, "arrival_speed_kmh": self.arrival_speed_kmh}
        parts = {**self.metrics, "comfort": self.comfort, "events": self.events, **whole}
        return {name: value.mean if isinstance(value, Interval) else value for name, value in flat(parts)}


def flat(part: Mapping[str, Any], prefix: str = "") -> Iterator[tuple[str, Any]]:
    """Each value in mappings of any depth, by its dotted name."""
    for key, value in part.items():
        if isinstance(value, Mapping):
            yield from flat(value, f"{prefix}{key}.")
        else:
            yield prefix + key, value


def intervals(value: Any) -> Any:
    """Numbers by name, in mappings of any depth, with an `Interval` for each `{"mean", "low", "high"}`."""
    if not isinstance(value, Mapping):
        return value
    return Interval(**value) if value.keys() == _INTERVAL else {key: intervals(item) for key, item in value.items()}


@dataclass(frozen=True, slots=True, kw_only=True)
class RunResult:
    """A run; `run["lv"]` is one strategy's outcome.

    Attributes:
        id: Names it for ever; None where no service stores it.
        core_version: What computed it.
        scenario: All of it, defaults included.
        strategies: Outcomes by strategy id, in the catalogue's order.
        roads: How many roads every strategy drove; seeds `road.seed`, `road.seed` + 1, ...
        baseline: What the changes refer to; None for a run of one road.
        changes: strategy -> window (or `comfort`) -> signal -> statistic: paired change of the mean against the
            baseline [%]; None against a zero. Empty for a run of one road.
        requirement_results: How the strategies keep the requirements that it was asked for with.
        answer: The JSON as the service sent it.
        service: Where it is from; None of a file's.
    """

    id: str | None
    core_version: str
    scenario: dict[str, Any] = field(repr=False)
    strategies: dict[str, Outcome] = field(repr=False)
    roads: int = 1
    baseline: str | None = None
    changes: Mapping[str, Any] = field(default_factory=dict, repr=False)
    requirement_results: Sequence[RequirementResult] = ()
    answer: dict[str, Any] = field(repr=False)
    service: Connection | None = field(default=None, repr=False, compare=False)

    @classmethod
    def of(cls, answer: Mapping[str, Any], service: Connection | None = None) -> Self:
        """The run in an answer of a service, or in a file that holds one.

        Raises:
            KeyError: It is no run.
        """
        return cls(
            id=answer["id"],
            core_version=answer["core_version"],
            scenario=answer["scenario"],
            strategies={name: Outcome.of(name, entry) for name, entry in answer["strategies"].items()},
            roads=answer.get("roads", 1),
            baseline=answer.get("baseline"),
            changes=intervals(answer.get("changes", {})),
            requirement_results=[RequirementResult.of(each) for each in answer.get("requirement_results", ())],
            answer=dict(answer),
            service=service,
        )

    @property
    def units(self) -> dict[str, str]:
        """Unit of each metric by its flat name, `1` for none: those saved with it, else the service's."""
        saved: dict[str, str] | None = self.answer.get("units")
        if saved is not None:
            return saved
        return {} if self.service is None else self.service.units

    def frame(self) -> "pd.DataFrame":
        """Return its metrics as a pandas frame: a row a strategy, columns as a batch's; over several roads the means.

        `frame.attrs["units"]` has the unit of each metric.

        Raises:
            ImportError: pandas is not installed.
        """
        rows = [{"strategy": outcome.strategy, "status": outcome.status, **outcome.figures()} for outcome in self]
        return notebooks.frame_of(rows, ["strategy"], self.units)

    def plot(self, signal: str = "body_acceleration", *, x: Literal["position", "time"] = "position") -> "go.Figure":
        """A signal of all its strategies as a plotly figure, in the units, colours and dashes of the page.

        Args:
            signal: As the catalogue names it, or `road`.
            x: What is on the x axis.

        Raises:
            ImportError: plotly is not installed.
            ValueError: The run is from a file: no service is asked for its time histories.
        """
        if self.service is None:
            raise ValueError("This run is from a file: get_run(run.id) of a Ridelab has the one that can be drawn")
        return notebooks.figure_of(self.service.get(f"/runs/{self.id}/figures/{signal}", {"x": x}))

    def __repr__(self) -> str:
        ended = ", ".join(f"{outcome.strategy} {outcome.status}" for outcome in self)
        return f"RunResult({self.id}, core {self.core_version}{f', {self.roads} roads' * (self.roads > 1)}: {ended})"

    def __getitem__(self, strategy: str) -> Outcome:
        try:
            return self.strategies[strategy]
        except KeyError:
            raise KeyError(f"{strategy} did not run; there are {', '.join(self.strategies)}") from None

    def __len__(self) -> int:
        return len(self.strategies)

    def __iter__(self) -> Iterator[Outcome]:
        return iter(self.strategies.values())


def compared(a: RunResult, b: RunResult) -> "pd.DataFrame":
    """Every metric of the strategies that both have: `a`, `b`, `change` from a to b [%] and `unit`."""
    both = [outcome for outcome in a if outcome.strategy in b.strategies]
    rows = [
        {
            "strategy": outcome.strategy,
            "metric": metric,
            "a": one,
            "b": other,
            "change": _change(one, other),
            "unit": a.units.get(metric, "1"),
        }
        for outcome in both
        for metric, one in outcome.figures().items()
        for other in [b[outcome.strategy].figures().get(metric)]
    ]
    return notebooks.frame_of(rows, ["strategy", "metric"], a.units)


def _change(one: float | bool | None, other: float | bool | None) -> float | None:
    """In percent; None where there is no number, and from zero."""
    if one is None or other is None or isinstance(one, bool) or isinstance(other, bool) or one == 0:
        return None
    return 100 * (other - one) / abs(one)


def quoted_id(result: RunResult | str) -> str:
    """The id of a run, or the id that is given, as it stands in an address."""
    run_id = result.id if isinstance(result, RunResult) else result
    if run_id is None:
        raise ValueError("No service stores this run: get_run(id) of a Ridelab has one that is stored")
    return quote(run_id, safe="")


@dataclass(frozen=True, slots=True, kw_only=True)
class Solution:
    """The largest value of a field that keeps a metric at or below a limit.

    Attributes:
        value: The value, in `unit`.
        metric_value: What is held to the limit, in `metric_unit`: over several roads the interval's upper end.
        interval: The metric at that value over the roads; None for one road.
        resolution: Smallest change of the metric [%] that is more than random variation; None where nothing is random,
            or none is known.
        resolved_value: The value in no more digits than that leaves it, rounded down; not driven itself.
        bracket: The value, and the next larger one, which does not keep the limit or could not be tried; twice the
            value at the top of the range.
        runs: How many runs it took.
        run_id: The run at that value.
        unit: Of the field, `1` for none.
        metric_unit: `1` for none.
        warnings: Where the metric is not monotone, and what else the value does not tell, in plain words.
        tried: Every value tried, in order: `value`, `metric_value`, `run_id`, `reason`.
        requirement_results: How the requirements are kept at the value; empty without any.
        answer: The JSON as the service sent it.
    """

    value: float
    metric_value: float
    interval: Interval | None
    resolution: float | None
    resolved_value: float
    bracket: tuple[float, float]
    runs: int
    run_id: str
    unit: str
    metric_unit: str
    warnings: list[str]
    tried: list[dict[str, Any]] = field(repr=False)
    answer: dict[str, Any] = field(repr=False)
    requirement_results: Sequence[RequirementResult] = ()

    @classmethod
    def of(cls, answer: Mapping[str, Any]) -> Self:
        """The solution in an answer; fields of a newer service are ignored."""
        read = {key: intervals(value) for key, value in answer.items() if key in cls.__dataclass_fields__}
        judged = [RequirementResult.of(each) for each in answer.get("requirement_results", ())]
        bracket = tuple(answer["bracket"])
        return cls(**{**read, "bracket": bracket, "requirement_results": judged, "answer": dict(answer)})


@dataclass(frozen=True, slots=True, kw_only=True)
class Link:
    """A shared link: `url` opens it in a browser."""

    slug: str
    url: str


@dataclass(frozen=True, slots=True, kw_only=True)
class LinkedResult:
    """The run or the batch that a shared link pins, as it was, and how the page showed it."""

    slug: str
    url: str
    created_at: str
    kind: Literal["run", "batch"]
    core_version: str
    current_core_version: str
    scenario: dict[str, Any] = field(repr=False)
    view: dict[str, Any]
    run: RunResult | None
    batch: Batch | None
    series_pinned: bool
