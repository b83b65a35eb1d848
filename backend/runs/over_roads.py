"""The shapes of a run over several roads; beside `backend.models`."""

from typing import Annotated, Any

from pydantic import Field, create_model

from backend.models import (
    Answer,
    CachedFailure,
    DriveResult,
    Histories,
    StrategyFailure,
    by_strategy,
    keys_of,
)
from backend.runs.models import JudgedRun
from sim_core.catalogue import COMFORT, METRIC_SIGNALS, WINDOWS


class Interval(Answer):
    """A mean over roads, or a change of means [%], with its 95 % interval (Student's t)."""

    mean: float
    low: float
    high: float


class RoadsStatistics(Answer):
    """One signal in one window, over several roads."""

    rms: Interval
    peak: Interval


class Changes(Answer):
    """One signal in one window: paired change of the mean against the baseline's [%]; null where that is zero."""

    rms: Interval | None
    peak: Interval | None


WindowRoads = Annotated[
    dict[str, RoadsStatistics], keys_of(METRIC_SIGNALS, "By signal (catalogue: metric_signals), SI units")
]
WindowChanges = Annotated[dict[str, Changes], keys_of(METRIC_SIGNALS, "By signal (catalogue: metric_signals), in %")]


class RoadsResult(DriveResult):
    """One strategy's figures over several roads."""

    metrics: dict[str, WindowRoads] = keys_of(WINDOWS, "By window (catalogue: windows)")
    comfort: dict[str, Interval] = keys_of(COMFORT, "Catalogue: comfort")


_CHANGES: dict[str, Any] = dict.fromkeys(WINDOWS, WindowChanges)
StrategyChanges = create_model(
    "StrategyChanges",
    __base__=Answer,
    __doc__="One strategy's paired changes over several roads, by window (catalogue: windows), and of its comfort.",
    **_CHANGES,
    comfort=(dict[str, Interval | None], keys_of(COMFORT, "Catalogue: comfort; in %")),
)


class CachedRoadsResult(RoadsResult):
    """A result over several roads, and whether it was computed for this request."""

    cached: bool = Field(description="No road was computed for this request")


class RoadsRunBase(JudgedRun):
    """Fields of every form of a run over several roads."""

    roads: int = Field(description="Seeds road.seed, road.seed + 1, …; time histories and events are the first's")
    baseline: str = Field(description="The strategy that changes refer to: the one asked for, else the run's own")
    changes: dict[str, StrategyChanges] = by_strategy(
        "Against `baseline`, by strategy; not of the baseline, nor of failures"
    )


class RoadsRun(RoadsRunBase):
    """A stored run over several roads; it never changes."""

    strategies: dict[str, Annotated[RoadsResult | StrategyFailure, Field(discriminator="status")]] = by_strategy()


class CreatedRoadsRun(RoadsRunBase):
    """The answer to the request that created a run over several roads."""

    strategies: dict[str, Annotated[CachedRoadsResult | CachedFailure, Field(discriminator="status")]] = by_strategy()


class PairedChanges(Answer):
    """Changes of the strategies of a run over several roads, paired by road."""

    against: str | None = Field(description="Id of the run, over the same roads, whose same strategies they refer to")
    baseline: str | None = Field(description="The strategy of this run that they refer to instead")
    roads: int
    changes: dict[str, StrategyChanges] = by_strategy("By strategy that succeeded in both runs; not of the baseline")


class Band(Answer):
    """One strategy's time histories over the roads: at each sample the mean, the smallest and the largest value."""

    mean: Histories
    minimum: Histories = Field(description="Without what is the same on every road, such as time, position and speed")
    maximum: Histories = Field(description="Of the same signals as `minimum`")


class Bands(Answer):
    """Time histories over several roads: samples lie at the same times and positions on each."""

    core_version: str
    roads: int
    units: dict[str, str]
    strategies: dict[str, Band]
