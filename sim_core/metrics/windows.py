"""Where windows of a drive lie in its record, by the time the front axle spends in each."""

from collections.abc import Sequence
from dataclasses import dataclass
from itertools import pairwise
from math import ceil, nan

import numpy as np

from sim_core.arrays import FloatArray
from sim_core.caching import cached
from sim_core.loop.excitation import TimeGrid
from sim_core.loop.run import Run
from sim_core.speed.profile import SpeedProfile

_SNAP = 1e-6  # of a fine step: a section that ends so near to a sample ends there


def section_ends(spans: Sequence[tuple[float, float]]) -> FloatArray:
    """Ends (sections, 2) of sections that begin and end so many fine steps from x = 0: at a sample where near one."""
    steps = np.array(spans)
    nearest = np.round(steps)
    return np.where(np.abs(steps - nearest) < _SNAP, nearest, steps)


@dataclass(frozen=True, slots=True, eq=False, kw_only=True)
class Windows:
    """Where a record's windows lie.

    Attributes:
        ends: First and last place of the rough road, the bump, and what follows it (3, 2) [fine steps]; together the
            whole run.
        step_distance: The longest fine step in each section (3,) [m].
        arrival_speed: Speed of the car as the front axle meets the bump [m/s]; NaN where there is none.
    """

    ends: FloatArray
    step_distance: FloatArray
    arrival_speed: float


def windows_of(run: Run) -> Windows:
    """Return where a run's windows lie."""
    scenario = run.scenario
    start, end, length = scenario.bump_start, scenario.bump_left, scenario.road.length
    return _windows(run.excitation.grid, run.speed_profile, start, min(end, length), length)


@cached
def _windows(grid: TimeGrid, speed_profile: SpeedProfile, start: float, end: float, length: float) -> Windows:
    """Return those of the road up to the bump's start [m], from there to its end, and from there on."""
    h = grid.fine_step
    bounds = [0.0, *(speed_profile.time_at(position) / h for position in (start, end, length))]
    ends = section_ends(list(pairwise(bounds)))
    distance = np.diff(grid.axles[0, grid.on_record.start :])
    arrival = float(speed_profile.at(np.array(speed_profile.time_at(start)))[1]) if start < length else nan
    return Windows(
        ends=ends,
        step_distance=np.array([distance[int(first) : ceil(last)].max(initial=0) for first, last in ends.tolist()]),
        arrival_speed=arrival,
    )
