"""What a service answers, typed. Values are in SI units, speeds that people type in km/h; `units` names each."""

import math
from collections.abc import Iterator, Mapping
from dataclasses import dataclass, field
from typing import Any, Literal, Self, TypedDict

from backend.client.batch import Batch
from sim_core.catalogue import COMFORT, EVENTS, METRIC_SIGNALS, RUN_FIGURES, SIGNALS, STATISTICS, WINDOWS

Figure = float | bool | None


class Statistics(TypedDict):
    """One signal in one window, in the signal's unit."""

    rms: float
    peak: float


class Stage(TypedDict):
    """One driving stage, by the front axle: times [s], positions [m]."""

    stage: str
    start_time: float
    end_time: float
    start_position: float
    end_position: float


def units() -> dict[str, str]:
    """Unit of each figure by its flat name (`bump.body_acceleration.peak`); `1` for none."""
    found = {
        f"{window}.{signal}.{statistic}": SIGNALS[signal].unit
        for window in WINDOWS
        for signal in METRIC_SIGNALS
        for statistic in STATISTICS
    }
    found |= {f"comfort.{key}": quantity.unit for key, quantity in COMFORT.items()}
    found |= {f"events.{key}": quantity.unit for key, quantity in EVENTS.items()}
    return found | {key: quantity.unit for key, quantity in RUN_FIGURES.items()}


@dataclass(frozen=True, slots=True, kw_only=True)
class Outcome:
    """One strategy of a run. A failed one has a reason, no metrics, and NaN for its figures.

    Attributes:
        strategy: Its id.
        status: Whether the core could run it.
        reason: Why not, where it failed.
        cached: Not computed for this request; None where the answer does not tell.
        compute_ms: The worker's own time [ms].
        metrics: window -> signal -> statistic.
        comfort: ISO 2631-1 and what stands beside it.
        events: Counts, times, true or false; None where it does not apply.
        reference: Lines a plot draws.
        stages: The driving stages in order.
        travel_time: Front axle from x = 0 to the road's end [s].
        arrival_speed_kmh: Speed when the front axle meets the bump [km/h].
    """

    strategy: str
    status: Literal["ok", "failed"]
    compute_ms: float
    reason: str | None = None
    cached: bool | None = None
    metrics: Mapping[str, Mapping[str, Statistics]] = field(default_factory=dict)
    comfort: Mapping[str, float] = field(default_factory=dict)
    events: Mapping[str, Figure] = field(default_factory=dict)
    reference: Mapping[str, float | None] = field(default_factory=dict)
    stages: list[Stage] = field(default_factory=list)
    travel_time: float = math.nan
    arrival_speed_kmh: float = math.nan

    @classmethod
    def of(cls, strategy: str, answer: Mapping[str, Any]) -> Self:
        """The outcome in a run's answer; what a newer service tells beside it is passed over."""
        known = {key: value for key, value in answer.items() if key in cls.__dataclass_fields__ and key != "strategy"}
        return cls(strategy=strategy, **known)

    def figures(self) -> dict[str, Figure]:
        """Every figure by its flat name, as the columns of a batch's table are named; empty where it failed."""
        if self.status != "ok":
            return {}
        found: dict[str, Figure] = {
            f"{window}.{signal}.{statistic}": value
            for window, signals in self.metrics.items()
            for signal, statistics in signals.items()
            for statistic, value in (("rms", statistics["rms"]), ("peak", statistics["peak"]))
        }
        found |= {f"comfort.{key}": value for key, value in self.comfort.items()}
        found |= {f"events.{key}": value for key, value in self.events.items()}
        return {**found, "travel_time": self.travel_time, "arrival_speed_kmh": self.arrival_speed_kmh}


@dataclass(frozen=True, slots=True, kw_only=True)
class RunResult:
    """A run; `run["lv"]` is one strategy's outcome.

    Attributes:
        id: Names it for ever; None where only a file holds it.
        core_version: What computed it.
        scenario: All of it, defaults included.
        strategies: Outcomes by strategy id, in the catalogue's order.
        answer: The JSON as the service sent it.
    """

    id: str
    core_version: str
    scenario: dict[str, Any]
    strategies: dict[str, Outcome]
    answer: dict[str, Any] = field(repr=False)

    @classmethod
    def of(cls, answer: Mapping[str, Any]) -> Self:
        """The run in an answer, or in a file that holds one.

        Raises:
            KeyError: It is no run.
        """
        return cls(
            id=answer["id"],
            core_version=answer["core_version"],
            scenario=answer["scenario"],
            strategies={name: Outcome.of(name, entry) for name, entry in answer["strategies"].items()},
            answer=dict(answer),
        )

    @property
    def units(self) -> dict[str, str]:
        """Unit of each figure by its flat name; `1` for none."""
        return units()

    def __getitem__(self, strategy: str) -> Outcome:
        return self.strategies[strategy]

    def __iter__(self) -> Iterator[Outcome]:
        return iter(self.strategies.values())


@dataclass(frozen=True, slots=True, kw_only=True)
class LinkedResult:
    """What a shared link pins: the run or the batch as it was, and how it was looked at."""

    slug: str
    url: str
    created_at: str
    kind: Literal["run", "batch"]
    core_version: str
    current_core_version: str
    scenario: dict[str, Any]
    view: dict[str, Any]
    run: RunResult | None
    batch: Batch | None
    series_pinned: bool
