"""Driving stages and the coordinator that picks the weights for each (section 3.3).

The stages follow the bump's geometry, also at height 0: cruise, brake from the detection to the bump, bump until
the rear axle has left it, cruise again. A car at constant speed has no brake stage.
"""

from sim_core.arrays import FloatArray
from sim_core.result import Span
from sim_core.scenario import Scenario
from sim_core.scenario.fields import Weights
from sim_core.speed.profile import REACHED, SpeedProfile
from sim_core.strategies import SpeedPolicy, Strategy, SuspensionPolicy


def spans(scenario: Scenario, strategy: Strategy, drive: SpeedProfile) -> tuple[Span, ...]:
    """The stages from x = 0 to the road's end, without gaps and without empty ones."""
    bump, end = scenario.road.bump, scenario.road.length
    edges = [("cruise", 0.0)]
    if strategy.speed is SpeedPolicy.PLANNED:
        edges.append(("brake", max(0.0, bump.start - scenario.speed.detection_distance)))
    edges.append(("bump", bump.start))
    edges.append(("cruise", bump.end + scenario.vehicle.wheelbase))
    stops = [min(position, end) for _, position in edges[1:]] + [end]
    return tuple(
        Span(
            stage=stage,
            start_time=drive.time_at(start),
            end_time=drive.time_at(stop),
            start_position=start,
            end_position=stop,
        )
        for (stage, start), stop in zip(edges, stops, strict=True)
        if stop > start
    )


def segments(stages: tuple[Span, ...], position: FloatArray) -> list[tuple[str, int, int]]:
    """The control steps of each stage: (stage, first, one past the last) for ascending front-axle positions (n,) [m].

    A stage begins with the first step at its start or not further before it than `REACHED`.
    """
    firsts = [0] + [int(position.searchsorted(span.start_position - REACHED)) for span in stages[1:]]
    lasts = [*firsts[1:], len(position)]
    return [(span.stage, first, last) for span, first, last in zip(stages, firsts, lasts, strict=True) if last > first]


def coordinated_weights(scenario: Scenario, strategy: Strategy, stage: str) -> Weights:
    """The MPC's weights in a stage: Table 6 by driving stage, or Table 3 by road."""
    if strategy.suspension is not SuspensionPolicy.MPC_BY_ROAD:
        weights: Weights = getattr(scenario.mpc.stage_weights, stage)
        return weights
    return scenario.mpc.road_weights.bump if stage == "bump" else scenario.mpc.road_weights.rough
