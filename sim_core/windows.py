"""Where windows lie in a record: shares of its samples and lines, by the time the front axle spends in each."""

from collections.abc import Sequence
from dataclasses import dataclass
from itertools import pairwise
from math import ceil, floor

import numpy as np
from numpy.typing import NDArray

from sim_core.arrays import FloatArray
from sim_core.caching import cached
from sim_core.catalogue import WINDOWS
from sim_core.drive.sampling import SampledDrive
from sim_core.drive.speed_profile import Drive

SNAP = 1e-6  # of a fine step: a window that ends so near to a sample ends there
_NEAR = 1e-3  # of a fine step: a kink met so near to a window's end is met at it


@dataclass(frozen=True, slots=True, eq=False, kw_only=True)
class Windows:
    """Where a record's windows lie in a signal of it (fine steps of a command + 1, commands).

    Attributes:
        weights: Share of each sample, flattened, in a window's mean (windows, samples), by trapezoids.
        segments: Share of each line from a sample to the next of its command in the same (windows, lines).
        within: The samples of the rough road, of the bump, and of what follows it, in blocks of samples and commands.
        ends: Of the windows' ends between two samples, the one before, flattened, and how far on to the next.
        kink_command: Index of the command under which each kink is met, in (axle, command), flattened (k,).
        kinks: Those met on the rough road, on the bump, and after it, by axle.
        duration: Of the whole record [s].
    """

    weights: FloatArray
    segments: FloatArray
    within: tuple[tuple[tuple[slice, slice], ...], ...]
    ends: tuple[tuple[int, float], ...]
    kink_command: NDArray[np.intp]
    kinks: tuple[tuple[slice, ...], ...]
    duration: float


@cached
def windows_of(
    sampled: SampledDrive,
    drive: Drive,
    bump_start: float,
    bump_end: float,
    length: float,
    per_command: int,
    commands: int,
) -> Windows:
    """The windows of a record of so many held commands with so many samples each."""
    h, fine = sampled.fine_step, per_command - 1
    arrival, leaving, end = (drive.time_at(place) / h for place in (bump_start, min(bump_end, length), length))
    edges = [round(place) if abs(place - round(place)) < SNAP else place for place in (0.0, arrival, leaving, end)]
    spans = list(pairwise(edges))

    ends = (spans[0], spans[1], (edges[0], edges[-1]))
    segments = np.stack([segments_of([window], fine, commands) for window in ends])

    def sample(step: int) -> int:
        return step % fine * commands + step // fine

    kinks, driven = sampled.kinks, sampled.position[:, sampled.on_record.start :]
    low, high = driven[kinks.axle, kinks.step], driven[kinks.axle, kinks.step + 1]
    met = kinks.step + (kinks.position - low) / (high - low)

    def met_within(axle: slice) -> tuple[slice, ...]:
        edges = [met[axle].searchsorted((first - _NEAR, last + _NEAR)) + axle.start for first, last in spans]
        return tuple(slice(first, last) for first, last in edges)

    return Windows(
        weights=weights_of(segments).reshape(len(WINDOWS), -1),
        segments=segments.reshape(len(WINDOWS), -1),
        within=tuple(_blocks(ceil(first), floor(last), fine) for first, last in spans),
        ends=tuple((sample(floor(place)), place - floor(place)) for place in edges[1:]),
        kink_command=kinks.step // fine + kinks.axle * commands,
        kinks=(met_within(slice(0, kinks.rear)), met_within(slice(kinks.rear, len(met)))),
        duration=(edges[-1] - edges[0]) * h,
    )


def _blocks(first: int, last: int, fine: int) -> tuple[tuple[slice, slice], ...]:
    """The samples from one fine step to another, both included; where a command ends at the last, its end alone."""
    start, begin = divmod(first, fine)
    stop, after = divmod(last, fine)
    everything = slice(None)
    if last < first:
        return ()
    if start == stop:
        return ((slice(begin, after + 1), slice(start, start + 1)),)
    blocks = [(slice(begin, None), slice(start, start + 1)), (everything, slice(start + 1, stop))]
    if after:
        blocks.append((slice(after + 1), slice(stop, stop + 1)))
    return tuple(blocks)


def segments_of(spans: Sequence[tuple[float, float]], fine: int, commands: int) -> FloatArray:
    """Share of each fine step in the time of these spans, given in fine steps (fine, commands)."""
    steps = np.arange(commands * fine)
    inside = [np.clip(np.minimum(steps + 1, last) - np.maximum(steps, first), 0.0, 1.0) for first, last in spans]
    share = np.sum(inside, axis=0) / sum(last - first for first, last in spans)
    return np.asarray(share.reshape(commands, fine).T)


def weights_of(segments: FloatArray) -> FloatArray:
    """Share of each sample, by trapezoids, where `segments` is that of each fine step (windows, fine + 1, commands)."""
    windows, fine, commands = segments.shape
    weights = np.zeros((windows, fine + 1, commands))
    weights[:, :-1] = segments / 2
    weights[:, 1:] += segments / 2
    return weights
