"""Where a recording lies on a road: offset and scale of its distance, found by its likeness to simulated drives."""

from collections.abc import Iterator, Mapping, Sequence
from dataclasses import dataclass, replace
from math import ceil, sqrt

import numpy as np
from scipy.fft import irfft, next_fast_len, rfft
from scipy.optimize import fmin

from sim_core.arrays import FloatArray
from sim_core.recorded.chance import Chance

# Of a first search: samples at least so far apart [m], at most so many, and scales each way.
GRID, MOST_POINTS, MOST_SCALES = 0.05, 20_000, 20
FINE_GRID, MOST_FINE_POINTS = 0.02, 15_000  # of the refinement
MOST_SCALED = 0.03  # a clock, or a wheel's circumference, is no further off
SHIFTED = 0.2  # a step of scale shifts both ends of a recording by this at most from where they are found [m]
LEAST_OVERLAP = 15.0  # of both drives [m], or half of the shorter one
DISTINCT = 0.9  # another place has at most this part of the best one's likeness
APART = 2.0  # what is so near to the best place is none other [m]
ROUGHLY, EXACTLY = 60, 400  # places that a refinement tries at most
SCALED_FROM = 50.0  # a shorter overlap says nothing of the scale [m]

Reference = tuple[FloatArray, FloatArray]  # position, ascending (n,) [m], and signals there (signals, n)
Signs = tuple[int, ...]  # of each signal: -1 where it is recorded the other way round


@dataclass(frozen=True, slots=True, kw_only=True)
class Placement:
    """Where a recording lies: position on the road = offset + scale * distance of the recording.

    Attributes:
        offset: Position of the recording's distance 0 [m].
        scale: Metres of the road in a metre of the recording; of distances that were integrated over time, what a
            second of the recorder's clock lasts.
        likeness: Correlation coefficient with the simulated drive, the mean over the signals that both have.
        reference: Name of that drive.
        signs: With which it is like it.
    """

    offset: float
    scale: float
    likeness: float
    reference: str
    signs: Signs


def place(
    distance: FloatArray,
    recorded: FloatArray,
    references: Mapping[str, Reference],
    signs: Sequence[Signs],
    *,
    smooth: bool = False,
) -> Placement | None:
    """Find where a recording lies by the signals that it shares with simulated drives of the same road.

    A first search takes the normalised cross-correlation that is furthest beyond chance (`chance.Chance`) over all
    drives, signs, offsets and some scales (J. P. Lewis, Fast Normalized Cross-Correlation, 1995, with the means taken
    off once); a simplex search refines offset and scale, and the place is judged by what overlaps there.

    Args:
        distance: Of the recording, not descending, its zero anywhere (m,) [m].
        recorded: Its signals, NaN where there is no value (signals, m).
        references: By name the simulated drives.
        signs: Those that its signals may have.
        smooth: The road is smooth but for its bumps.

    Returns:
        None where no place is like a simulated drive beyond chance, or several are.

    Example:
        >>> import numpy as np
        >>> x = np.arange(0, 100, 0.1)
        >>> road = np.convolve(np.random.default_rng(1).normal(size=1000), np.hanning(11), "same")[None]
        >>> placement = place(x[:500], road[:, 350:850], {"passive": (x, road)}, [(1,)])
        >>> placement.reference, round(placement.offset, 2)
        ('passive', 35.0)
    """
    longest = max(float(np.ptp(each)) for each in (distance, *(position for position, _ in references.values())))
    spacing = _spacing(longest, GRID, MOST_POINTS)
    chance = Chance(spacing=spacing, smooth=smooth)
    best, tried = dict[str, _Found](), 0.0
    for found in _first_search(distance, recorded, references, signs, chance):
        tried += found.tried
        name = found.placement.reference
        if name not in best or found.score > best[name].score:
            best[name] = found
    if not max(best.values(), key=lambda found: found.score).distinct:
        return None
    # On a coarse grid all drives are about as like; which one is likest shows between its scales.
    refined = [_refined(found.placement, distance, recorded, references, chance, ROUGHLY) for found in best.values()]
    scores = [_score(placement, distance, recorded, references, chance) for placement in refined]
    likest = refined[int(np.argmax(scores))]
    placement = _refined(likest, distance, recorded, references, chance, EXACTLY)
    score = _score(placement, distance, recorded, references, chance)
    return placement if score >= chance.least_score(tried) else None


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


def _spacing(length: float, least: float, most: int) -> float:
    return max(least, length / most)


def evenly(distance: FloatArray, signals: FloatArray, spacing: float) -> tuple[FloatArray, FloatArray]:
    """Even distances (n,) [m] and the signals there (signals, n), straight across what is missing."""
    even = np.arange(distance[0], distance[-1] + spacing / 2, spacing)
    there = [np.isfinite(row) for row in signals]
    rows = [
        np.interp(even, distance[finite], row[finite]) if finite.any() else np.zeros_like(even)
        for row, finite in zip(signals, there, strict=True)
    ]
    return even, np.array(rows)


@dataclass(frozen=True, slots=True, kw_only=True)
class _Found:
    """The best place of one drive, scale and choice of signs.

    Attributes:
        placement: On the grid of the first search.
        score: How far beyond chance it is (`Chance.score`).
        distinct: No other place comes near to it.
        tried: Of how many independent places it is the best.
    """

    placement: Placement
    score: float
    distinct: bool
    tried: float


class _Whole:
    """A simulated drive at even distances, equalised, ready to be correlated with many recordings."""

    def __init__(self, position: FloatArray, simulated: FloatArray, most: int, chance: Chance) -> None:
        even, rows = evenly(position, simulated, chance.spacing)
        self.start, self.rows = float(even[0]), chance.equalised(rows)
        self.memory = chance.memory(self.rows)
        self._size = next_fast_len(self.rows.shape[1] + most, real=True)
        self._spectrum, self._energy = rfft(self.rows, self._size), _energies(self.rows)

    def correlate(self, rows: FloatArray) -> tuple[FloatArray, FloatArray]:
        """Normalised correlation of each signal by shift (signals, shifts), and how many samples overlap (shifts,).

        Shift k has the recording's last sample at the k-th of the whole.
        """
        count, own = self.rows.shape[1], rows.shape[1]
        cross = irfft(self._spectrum * rfft(rows[:, ::-1], self._size), self._size)[:, : count + own - 1]
        shift = np.arange(count + own - 1)
        first, last = np.maximum(0, shift - own + 1), np.minimum(count, shift + 1)
        before, energy = shift - own + 1, _energies(rows)
        size = (self._energy[:, last] - self._energy[:, first]) * (energy[:, last - before] - energy[:, first - before])
        least = 1e-6 * self._energy[:, -1:] * energy[:, -1:]  # what stands still is like anything
        return cross / np.sqrt(np.maximum(size, np.maximum(least, 1e-300))), (last - first).astype(np.float64)


def _energies(rows: FloatArray) -> FloatArray:
    """Sums of squares up to each sample (signals, n + 1)."""
    return np.pad(np.cumsum(rows**2, axis=1), ((0, 0), (1, 0)))


def _first_search(
    distance: FloatArray,
    recorded: FloatArray,
    references: Mapping[str, Reference],
    signs: Sequence[Signs],
    chance: Chance,
) -> Iterator[_Found]:
    """The best place of every drive, scale and choice of signs."""
    own = float(np.ptp(distance))
    most = ceil((1 + MOST_SCALED) * own / chance.spacing) + 2
    wholes = {name: _Whole(*reference, most, chance) for name, reference in references.items()}
    shared = min(own, *(float(np.ptp(position)) for position, _ in references.values()))
    informative = min(
        chance.telling(*evenly(position, simulated, chance.spacing)) for position, simulated in references.values()
    )
    # What is short says nothing of the scale: the refinement takes 1, and so does this search.
    steps = 0 if informative < SCALED_FROM else min(MOST_SCALES, ceil(MOST_SCALED * shared / (4 * SHIFTED)))
    memory = chance.memory(chance.equalised(evenly(distance, recorded, chance.spacing)[1]))
    for scale in (1 + np.linspace(-MOST_SCALED, MOST_SCALED, 2 * steps + 1)).tolist():
        even, rows = evenly(scale * distance, recorded, chance.spacing)
        rows = chance.equalised(rows)
        for name, whole in wholes.items():
            by_signal, samples = whole.correlate(rows)
            enough = samples > min(LEAST_OVERLAP / chance.spacing, whole.rows.shape[1] / 2, rows.shape[1] / 2) - 0.5
            for each in signs:
                sign = np.array(each, dtype=np.float64)
                likeness = np.where(enough, sign @ by_signal / len(sign), 0.0)
                apart = chance.samples_apart(sign[:, None, None] * sign[:, None] * memory, whole.memory)
                score = chance.score(likeness, samples, apart)
                at = int(score.argmax())
                start = whole.start + (at - (rows.shape[1] - 1)) * chance.spacing  # of the recording's first sample
                yield _Found(
                    placement=Placement(
                        offset=start - float(even[0]),
                        scale=scale,
                        likeness=float(likeness[at]),
                        reference=name,
                        signs=each,
                    ),
                    score=float(score[at]),
                    distinct=_is_distinct(at, score, likeness, samples, chance.spacing),
                    tried=len(samples) / apart,
                )


def _is_distinct(at: int, score: FloatArray, likeness: FloatArray, samples: FloatArray, spacing: float) -> bool:
    """Check whether no other shift comes near to the best one's score, or with a like overlap to its likeness."""
    if not likeness[at] > 0:
        return False
    far = np.abs(np.arange(len(score)) - at) * spacing > APART
    like = far & (samples >= samples[at] / 2)
    nearest = score[far].max(initial=0.0) / max(score[at], 1e-300), likeness[like].max(initial=0.0) / likeness[at]
    return bool(max(nearest) <= DISTINCT)


def _refined(
    found: Placement,
    distance: FloatArray,
    recorded: FloatArray,
    references: Mapping[str, Reference],
    chance: Chance,
    evaluations: int,
) -> Placement:
    """Refine offset and scale about the middle of the overlap, with its likeness.

    Where the overlap, or what of it tells anything, is short, the scale is 1.
    """
    position, simulated = references[found.reference]
    recorded = _turned(recorded, found.signs)
    telling = chance.telling(*evenly(position, simulated, chance.spacing))
    offset, scale = found.offset, found.scale
    start, end = np.clip((position[[0, -1]] - offset) / scale, distance[0], distance[-1]).tolist()
    part = (distance >= start - APART) & (distance <= end + APART)
    even, clean = evenly(distance[part], recorded[:, part], _spacing(end - start, FINE_GRID, MOST_FINE_POINTS))
    free = min(end - start, telling) >= SCALED_FROM
    middle = (start + end) / 2  # about which a change of scale shifts nothing

    def placed(at: FloatArray) -> Placement:
        new = float(np.clip(scale + at[1], 1 - MOST_SCALED, 1 + MOST_SCALED)) if free else 1.0
        moved = float(offset + scale * middle + at[0] - new * middle)
        where = moved + new * even
        inside = (where >= position[0]) & (where <= position[-1])
        likeness = correlations(where[inside], clean[:, inside], position, simulated)
        return replace(found, offset=moved, scale=new, likeness=float(np.mean(likeness)))

    def unlikeness(at: FloatArray) -> float:
        return -placed(at).likeness

    inward = -1 if scale > 1 else 1  # a scale at its limit can only go there
    simplex = np.array([[0.0, 0.0], [GRID, 0.0], [0.0, inward * 0.1 / (end - start)]])
    best = fmin(unlikeness, simplex[0], xtol=1e-7, ftol=1e-10, maxfun=evaluations, disp=False, initial_simplex=simplex)
    return placed(best)


def _turned(recorded: FloatArray, signs: Signs) -> FloatArray:
    """Return the signals with those signs (signals, m)."""
    return np.array(signs, dtype=np.float64)[:, None] * recorded


def _score(
    placement: Placement,
    distance: FloatArray,
    recorded: FloatArray,
    references: Mapping[str, Reference],
    chance: Chance,
) -> float:
    """Return the score of a place by the parts of both drives that overlap there."""
    position, simulated = references[placement.reference]
    place, recorded = placement.offset + placement.scale * distance, _turned(recorded, placement.signs)
    (own, rows), (whole, others) = (
        (even, chance.equalised(signals))
        for even, signals in (evenly(place, recorded, chance.spacing), evenly(position, simulated, chance.spacing))
    )
    inside = (own >= whole[0]) & (own <= whole[-1])
    if np.count_nonzero(inside) < 3:
        return 0.0
    ours = rows[:, inside]
    theirs = np.array([np.interp(own[inside], whole, each) for each in others])
    ours, theirs = (each - each.mean(axis=1, keepdims=True) for each in (ours, theirs))
    size = np.sqrt((ours**2).sum(axis=1) * (theirs**2).sum(axis=1)) + 1e-300
    likeness = np.mean((ours * theirs).sum(axis=1) / size, keepdims=True)
    apart = chance.samples_apart(chance.memory(ours), chance.memory(theirs))
    return float(chance.score(likeness, np.array([ours.shape[1]]), apart)[0])
