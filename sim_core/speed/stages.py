"""Driving stages (section 3.3).

They follow the bump's geometry, also at height 0: cruise, brake from the detection to the bump, bump until both
axles have left it, cruise again. A car at constant speed has no brake stage; a road without a bump has cruise alone.
"""

from collections.abc import Sequence
from itertools import pairwise
from typing import NamedTuple

from sim_core.arrays import FloatArray
from sim_core.result import Span
from sim_core.scenario import Scenario
from sim_core.speed.profile import POSITION_TOLERANCE, SpeedPlan, SpeedProfile


class Segment(NamedTuple):
    """The control steps of a stage: its name, the first one, one past the last."""

    stage: str
    first: int
    last: int


def spans(scenario: Scenario, plan: SpeedPlan, profile: SpeedProfile) -> tuple[Span, ...]:
    """Return the stages from x = 0 to the road's end, without gaps and without empty ones."""
    stages, edges = ["cruise", "bump", "cruise"], [0.0, scenario.bump_start, scenario.bump_left, scenario.road.length]
    if plan == "planned":
        stages.insert(1, "brake")
        edges.insert(1, scenario.braking_start)
    positions = [min(each, scenario.road.length) for each in edges]
    return make_spans(stages, positions, [profile.time_at(each) for each in positions])


def make_spans(stages: Sequence[str], positions: Sequence[float], times: Sequence[float]) -> tuple[Span, ...]:
    """Return stages between positions [m] and times [s], of which there is one more; empty ones are left out."""
    ends = zip(stages, pairwise(positions), pairwise(times), strict=True)
    return tuple(
        Span(stage=stage, start_time=t0, end_time=t1, start_position=x0, end_position=x1)
        for stage, (x0, x1), (t0, t1) in ends
        if x1 > x0
    )


def segments(stages: tuple[Span, ...], position: FloatArray) -> list[Segment]:
    """Return the control steps of each stage for ascending front-axle positions (n,) [m].

    A stage begins with the first step at its start or not further before it than `POSITION_TOLERANCE`.
    """
    firsts = [0] + [int(position.searchsorted(span.start_position - POSITION_TOLERANCE)) for span in stages[1:]]
    lasts = [*firsts[1:], len(position)]
    every = map(Segment, [span.stage for span in stages], firsts, lasts)
    return [each for each in every if each.last > each.first]
