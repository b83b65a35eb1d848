"""Where windows of a drive lie in its record, by the time the front axle spends in each."""

from collections.abc import Sequence
from dataclasses import dataclass
from itertools import pairwise
from math import ceil

import numpy as np
from numpy.typing import NDArray

from sim_core.arrays import FloatArray
from sim_core.caching import cached
from sim_core.drive.sampling import SampledDrive
from sim_core.drive.speed_profile import Drive

SNAP = 1e-6  # of a fine step: a section that ends so near to a sample ends there
_NEAR = 1e-3  # of a fine step: a kink met so near to a section's end is met at it


def section_ends(spans: Sequence[tuple[float, float]]) -> FloatArray:
    """Ends (sections, 2) of sections that begin and end so many fine steps from x = 0: at a sample where near one."""
    return np.array([[_snapped(first), _snapped(last)] for first, last in spans])


def _snapped(place: float) -> float:
    nearest = round(place)
    return float(nearest) if abs(place - nearest) < SNAP else place


@dataclass(frozen=True, slots=True, eq=False, kw_only=True)
class Windows:
    """Where a record's windows lie, and the kinks of the road in it.

    Attributes:
        ends: First and last place of the rough road, the bump, and what follows it (3, 2) [fine steps]; together the
            whole run.
        inner: The commands wholly in each of them.
        fine_step: In s.
        first_kink: Index of the first kink met under each command or after it, in (axle, command), flattened, and at
            last how many there are (2 · commands + 1,).
        kink_ends: First and one past the last kink of each axle in each section (2, sections, 2).
        step_distance: The longest fine step in each section (3,) [m].
        arrival_speed: Speed of the car as the front axle meets the bump [m/s].
    """

    ends: FloatArray
    inner: tuple[slice, ...]
    fine_step: float
    first_kink: NDArray[np.intp]
    kink_ends: NDArray[np.intp]
    step_distance: FloatArray
    arrival_speed: float


@cached
def windows_of(
    sampled: SampledDrive,
    drive: Drive,
    bump_start: float,
    bump_end: float,
    length: float,
    fine: int,
    commands: int,
) -> Windows:
    """The windows of a record of so many held commands.

    Args:
        sampled: The drive, sampled.
        drive: The same.
        bump_start: Of the bump [m].
        bump_end: Where the front axle is when the rear one has left it [m].
        length: Of the road [m].
        fine: Fine steps in a command.
        commands: On record.
    """
    h = sampled.fine_step
    places = [0.0, *(drive.time_at(place) / h for place in (bump_start, min(bump_end, length), length))]
    ends = section_ends(list(pairwise(places)))
    spans = ends.tolist()
    kinks = sampled.kinks
    kink_command = kinks.step // fine
    kink_command[kinks.rear :] += commands
    kink_ends = np.empty((2, len(spans), 2), dtype=np.intp)
    for axle, part in enumerate((slice(kinks.rear), slice(kinks.rear, None))):
        met, offset = kinks.step[part] + kinks.share[part], axle * kinks.rear
        kink_ends[axle] = [met.searchsorted((first - _NEAR, last + _NEAR)) + offset for first, last in spans]
    distance = np.diff(sampled.position[0, sampled.on_record.start :])
    return Windows(
        ends=ends,
        inner=tuple(slice(ceil(first / fine), int(last // fine)) for first, last in spans),
        fine_step=h,
        first_kink=kink_command.searchsorted(np.arange(2 * commands + 1)),
        kink_ends=kink_ends,
        step_distance=np.array([distance[int(first) : ceil(last)].max(initial=0) for first, last in spans]),
        arrival_speed=float(drive.at(np.array(drive.time_at(bump_start)))[1]),
    )
