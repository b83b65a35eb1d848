"""Driving stages (section 3.3).

They follow the bump's geometry, also at height 0: cruise, brake from the detection to the bump, bump until both
axles have left it, cruise again. A car at constant speed has no brake stage; a road without a bump has cruise alone.
"""

from typing import NamedTuple

from sim_core.arrays import FloatArray
from sim_core.result import Span
from sim_core.scenario import Scenario
from sim_core.speed.profile import REACHED, SpeedPlan, SpeedProfile


class Segment(NamedTuple):
    """The control steps of a stage: its name, the first one, one past the last."""

    stage: str
    first: int
    last: int


def spans(scenario: Scenario, plan: SpeedPlan, profile: SpeedProfile) -> tuple[Span, ...]:
    """Return the stages from x = 0 to the road's end, without gaps and without empty ones."""
    end = scenario.road.length
    edges = [("cruise", 0.0)]
    if plan == "planned":
        edges.append(("brake", scenario.braking_start))
    edges.append(("bump", scenario.bump_start))
    edges.append(("cruise", scenario.bump_left))
    stops = [min(position, end) for _, position in edges[1:]] + [end]
    return tuple(
        Span(
            stage=stage,
            start_time=profile.time_at(start),
            end_time=profile.time_at(stop),
            start_position=start,
            end_position=stop,
        )
        for (stage, start), stop in zip(edges, stops, strict=True)
        if stop > start
    )


def segments(stages: tuple[Span, ...], position: FloatArray) -> list[Segment]:
    """Return the control steps of each stage for ascending front-axle positions (n,) [m].

    A stage begins with the first step at its start or not further before it than `REACHED`.
    """
    firsts = [0] + [int(position.searchsorted(span.start_position - REACHED)) for span in stages[1:]]
    lasts = [*firsts[1:], len(position)]
    every = map(Segment, [span.stage for span in stages], firsts, lasts)
    return [each for each in every if each.last > each.first]
