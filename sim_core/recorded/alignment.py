"""Where a recording lies on a road: offset and scale of its distance, found by its likeness to a simulated drive."""

from dataclasses import dataclass
from math import ceil, sqrt

import numpy as np
from scipy.fft import irfft, next_fast_len, rfft
from scipy.optimize import fmin

from sim_core.arrays import FloatArray

# Of a first search: samples at least so far apart [m], at most so many, and scales each way.
GRID, MOST_POINTS, MOST_SCALES = 0.05, 20_000, 20
FINE_GRID, MOST_FINE_POINTS = 0.02, 15_000  # of the refinement
MOST_SCALED = 0.03  # a clock, or a wheel's circumference, is no further off
SHIFTED = 0.4  # a step of scale shifts both ends of a recording by this at most from where they are found [m]
LEAST_OVERLAP = 15.0  # of both drives [m], or half of the shorter one
LEAST_LIKENESS = 0.5
DISTINCT = 0.9  # another place has at most this part of the best one's likeness
APART = 2.0  # what is so near to the best place is none other [m]
SCALED_FROM = 50.0  # a shorter overlap says nothing of the scale [m]


@dataclass(frozen=True, slots=True, kw_only=True)
class Placement:
    """Where a recording lies: position on the road = offset + scale * distance of the recording.

    Attributes:
        offset: Position of the recording's distance 0 [m].
        scale: Metres of the road in a metre of the recording; of distances that were integrated over time, what a
            second of the recorder's clock lasts.
        likeness: Correlation coefficient with the simulated drive, the mean over the signals that both have.
    """

    offset: float
    scale: float
    likeness: float


def place(distance: FloatArray, recorded: FloatArray, position: FloatArray, simulated: FloatArray) -> Placement | None:
    """Find where a recording lies by the signals that it shares with a simulated drive of the same road.

    A first search takes the largest normalised cross-correlation over all offsets and some scales (J. P. Lewis, Fast
    Normalized Cross-Correlation, 1995, with the means taken off once); a simplex search refines both.

    Args:
        distance: Of the recording, not descending, its zero anywhere (m,) [m].
        recorded: Its signals, NaN where there is no value (signals, m).
        position: Of the simulated drive, ascending (n,) [m].
        simulated: The same signals of it (signals, n).

    Returns:
        None where no place is like the simulated drive, or several are.

    Example:
        >>> import numpy as np
        >>> x = np.arange(0, 100, 0.1)
        >>> bump = np.exp(-((x - 60) ** 2)) * np.sin(3 * x)
        >>> placement = place(x[:500], bump[None, 350:850], x, bump[None])
        >>> round(placement.offset, 2)
        35.0
    """
    longer = max(distance[-1] - distance[0], position[-1] - position[0])
    spacing = _spacing(longer, GRID, MOST_POINTS)
    coarse = _first_search(*_evenly(distance, recorded, spacing), *_evenly(position, simulated, spacing))
    if coarse is None:
        return None
    offset, scale = coarse.offset, coarse.scale
    start, end = np.clip((position[[0, -1]] - offset) / scale, distance[0], distance[-1]).tolist()
    part = (distance >= start - APART) & (distance <= end + APART)
    spacing = _spacing(end - start, FINE_GRID, MOST_FINE_POINTS)
    distance, clean = _evenly(distance[part], recorded[:, part], spacing)
    free = end - start >= SCALED_FROM
    middle = (start + end) / 2  # about which a change of scale shifts nothing

    def placed(at: FloatArray) -> Placement:
        new = scale + at[1] if free else 1.0
        return _judged(offset + scale * middle + at[0] - new * middle, new, distance, clean, position, simulated)

    simplex = np.array([[0.0, 0.0], [GRID, 0.0], [0.0, 0.1 / (end - start)]])

    def unlikeness(at: FloatArray) -> float:
        return -placed(at).likeness

    best = fmin(
        unlikeness,
        simplex[0],
        xtol=1e-7,
        ftol=1e-10,
        maxfun=400,
        disp=False,
        initial_simplex=simplex,
    )
    placement = placed(best)
    return placement if placement.likeness >= LEAST_LIKENESS else None


def _spacing(length: float, least: float, most: int) -> float:
    return max(least, length / most)


def _evenly(distance: FloatArray, signals: FloatArray, spacing: float) -> tuple[FloatArray, FloatArray]:
    """Even distances (n,) [m] and the signals there (signals, n), straight across what is missing."""
    even = np.arange(distance[0], distance[-1] + spacing / 2, spacing)
    there = [np.isfinite(row) for row in signals]
    rows = [
        np.interp(even, distance[finite], row[finite]) if finite.any() else np.zeros_like(even)
        for row, finite in zip(signals, there, strict=True)
    ]
    return even, np.array(rows)


def _judged(
    offset: float,
    scale: float,
    distance: FloatArray,
    recorded: FloatArray,
    position: FloatArray,
    simulated: FloatArray,
) -> Placement:
    """The likeness where both drives overlap."""
    place = offset + scale * distance
    inside = (place >= position[0]) & (place <= position[-1])
    likeness = correlations(place[inside], recorded[:, inside], position, simulated)
    return Placement(offset=float(offset), scale=float(scale), likeness=float(np.mean(likeness)))


def correlations(place: FloatArray, recorded: FloatArray, position: FloatArray, simulated: FloatArray) -> FloatArray:
    """Correlation coefficient of each signal at those places of the road (signals,); 0 of one that stands still."""
    if len(place) < 3:
        return np.zeros(len(recorded))
    weight = np.gradient(place)  # samples may be dense where the car is slow
    total = max(weight.sum(), 1e-12)
    coefficients = []
    # A signal that stands still is like nothing.
    for one, row in zip(recorded, simulated, strict=True):
        other = np.interp(place, position, row)
        a, b = one - (weight @ one) / total, other - (weight @ other) / total
        size = sqrt((weight @ (a * a)) * (weight @ (b * b)))
        coefficients.append(float(weight @ (a * b) / size) if size else 0.0)
    return np.array(coefficients)


def _first_search(
    distance: FloatArray, recorded: FloatArray, position: FloatArray, simulated: FloatArray
) -> Placement | None:
    """The best place on a grid of offsets and scales, of drives with one even spacing; None where there is no one."""
    spacing = float(position[1] - position[0])
    whole = simulated - simulated.mean(axis=1, keepdims=True)
    best, at, scale, likeness = 0.0, 0, 1.0, np.zeros(1)
    shared = min(distance[-1] - distance[0], position[-1] - position[0])
    steps = min(MOST_SCALES, ceil(MOST_SCALED * shared / (4 * SHIFTED)))
    for each in (1 + np.linspace(-MOST_SCALED, MOST_SCALED, 2 * steps + 1)).tolist():
        own, rows = _evenly(each * distance, recorded, spacing)
        least = int(min(LEAST_OVERLAP / spacing, len(position) / 2, len(own) / 2))
        correlation = _likeness_by_shift(whole, rows - rows.mean(axis=1, keepdims=True), least)
        if correlation.max() > best:
            best, at, scale, likeness, count = (
                float(correlation.max()),
                int(correlation.argmax()),
                each,
                correlation,
                len(own),
            )
    far = np.abs(np.arange(len(likeness)) - at) * spacing > APART
    if best < LEAST_LIKENESS / 2 or likeness[far].max(initial=0) > DISTINCT * best:
        return None
    start = position[0] + (at - (count - 1)) * spacing  # of the recording's first sample
    return Placement(offset=float(start - scale * distance[0]), scale=scale, likeness=best)


def _likeness_by_shift(whole: FloatArray, rows: FloatArray, least: int) -> FloatArray:
    """Mean normalised correlation by shift; shift k has the recording's last sample at the k-th of the whole."""
    shifts = whole.shape[1] + rows.shape[1] - 1
    size = next_fast_len(shifts, real=True)

    def folded(a: FloatArray, b: FloatArray) -> FloatArray:
        return np.asarray(irfft(rfft(a, size) * rfft(b[..., ::-1], size), size)[..., :shifts])

    ones, own_ones = np.ones(whole.shape[1]), np.ones(rows.shape[1])
    energy = folded(whole * whole, own_ones) * folded(ones, rows * rows)
    floor = 1e-6 * (whole * whole).sum(axis=1) * (rows * rows).sum(axis=1)  # what stands still is like anything
    likeness = folded(whole, rows) / np.sqrt(np.maximum(energy, np.maximum(floor, 1e-300)[:, None]))
    return np.where(folded(ones, own_ones) > least - 0.5, likeness.mean(axis=0), 0.0)
