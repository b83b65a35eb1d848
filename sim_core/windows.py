"""Where windows and other sections of a drive lie in its record, by the time the front axle spends in each."""

from collections.abc import Sequence
from dataclasses import dataclass
from itertools import pairwise
from math import ceil, floor

import numpy as np
from numpy.typing import NDArray

from sim_core.arrays import FloatArray
from sim_core.caching import cached
from sim_core.drive.sampling import SampledDrive
from sim_core.drive.speed_profile import Drive

SNAP = 1e-6  # of a fine step: a section that ends so near to a sample ends there
_NEAR = 1e-3  # of a fine step: a kink met so near to a section's end is met at it


@dataclass(frozen=True, slots=True, eq=False, kw_only=True)
class Sections:
    """Where sections of a drive lie in a record's signals (fine steps of a command + 1, commands).

    Attributes:
        inner: The commands wholly in each section.
        edges: The commands within which a section ends (e,).
        shares: How much of each fine step of those, flattened, is in each section (sections, fine · e).
        durations: Of the sections (sections,) [fine steps].
    """

    inner: tuple[slice, ...]
    edges: NDArray[np.intp]
    shares: FloatArray
    durations: FloatArray


def sections_of(spans: Sequence[tuple[float, float]], fine: int) -> Sections:
    """Sections that begin and end so many fine steps from x = 0, with `fine` of them in a command."""
    spans = [(_snapped(first), _snapped(last)) for first, last in spans]
    edges = np.array(sorted({int(place // fine) for span in spans for place in span if place % fine}), dtype=np.intp)
    steps = fine * edges + np.arange(fine)[:, None]
    shares = [np.clip(np.minimum(steps + 1, last) - np.maximum(steps, first), 0.0, 1.0) for first, last in spans]
    return Sections(
        inner=tuple(slice(ceil(first / fine), int(last // fine)) for first, last in spans),
        edges=edges,
        shares=np.reshape(shares, (len(spans), -1)),
        durations=np.array([last - first for first, last in spans]),
    )


def _snapped(place: float) -> float:
    nearest = round(place)
    return float(nearest) if abs(place - nearest) < SNAP else place


@dataclass(frozen=True, slots=True, eq=False, kw_only=True)
class Windows:
    """Where a record's windows lie, and the kinks of the road in it.

    Attributes:
        sections: The rough road, the bump, and what follows it; together the whole run.
        edge_values: For each of them, the samples at its `edges` that lie in it, and the values between two samples at
            its ends: weights of the edges' samples, flattened ((fine + 1) · e, values).
        fine_step: In s.
        kink_command: Index of the command under which each kink is met, in (axle, command), flattened (k,).
        kink_ends: First and one past the last kink of each axle in each section (2, sections, 2).
        step_distance: The longest fine step in each section (3,) [m].
        arrival_speed: Speed of the car as the front axle meets the bump [m/s].
    """

    sections: Sections
    edge_values: tuple[FloatArray, ...]
    fine_step: float
    kink_command: NDArray[np.intp]
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
    spans = list(pairwise(map(_snapped, places)))
    sections = sections_of(spans, fine)
    kinks = sampled.kinks
    kink_command = kinks.step // fine
    kink_command[kinks.rear :] += commands
    kink_ends = np.empty((2, len(spans), 2), dtype=np.intp)
    for axle, part in enumerate((slice(kinks.rear), slice(kinks.rear, None))):
        met, offset = kinks.step[part] + kinks.share[part], axle * kinks.rear
        kink_ends[axle] = [met.searchsorted((first - _NEAR, last + _NEAR)) + offset for first, last in spans]
    distance = np.diff(sampled.position[0, sampled.on_record.start :])
    return Windows(
        sections=sections,
        edge_values=tuple(_edge_values(first, last, sections.edges, fine) for first, last in spans),
        fine_step=h,
        kink_command=kink_command,
        kink_ends=kink_ends,
        step_distance=np.array([distance[int(first) : ceil(last)].max(initial=0) for first, last in spans]),
        arrival_speed=float(drive.at(np.array(drive.time_at(bump_start)))[1]),
    )


def _edge_values(first: float, last: float, edges: NDArray[np.intp], fine: int) -> FloatArray:
    """One of `Windows.edge_values`, for a section's first and last place in fine steps."""
    columns = []
    for i, begin in enumerate(fine * edges):
        low, high = max(first, begin), min(last, begin + fine)
        for place in sorted({low, high, *range(ceil(low), floor(high) + 1)}) if low < high else ():
            step = min(int(place - begin), fine - 1)
            column = np.zeros((fine + 1, len(edges)))
            column[step, i], column[step + 1, i] = begin + step + 1 - place, place - begin - step
            columns.append(column.reshape(-1))
    return np.reshape(columns, (len(columns), (fine + 1) * len(edges))).T
