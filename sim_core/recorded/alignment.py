"""Where a recording lies on a road: offset and scale of its distance, found by correlation with simulated drives."""

from collections.abc import Iterator, Mapping, Sequence
from dataclasses import dataclass, replace
from math import ceil, sqrt
from typing import NamedTuple

import numpy as np
from scipy.fft import irfft, next_fast_len, rfft
from scipy.optimize import fmin

from sim_core.arrays import FloatArray
from sim_core.recorded.significance import SignificanceTest

# Of the coarse search: least distance between samples [m], most samples, and most scales on either side of 1.
COARSE_SPACING, MOST_POINTS, MOST_SCALES = 0.05, 20_000, 20
FINE_SPACING, MOST_FINE_POINTS = 0.02, 15_000  # of the refinement
LARGEST_SCALE_ERROR = 0.03  # a clock, or a wheel's circumference, is no further off
SHIFTED = 0.2  # a step of scale shifts both ends of a recording by this at most from where they are found [m]
LEAST_OVERLAP = 15.0  # of both drives [m], or half of the shorter one
MOST_RIVAL_SHARE = 0.9  # another position has at most this share of the best one's likeness
EXCLUSION_DISTANCE = 2.0  # positions nearer to the best one are no other [m]
COARSE_EVALUATIONS, FINE_EVALUATIONS = 60, 400  # of a refinement's objective, at most
LEAST_OVERLAP_FOR_SCALE = 50.0  # a shorter overlap does not determine the scale [m]

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
        signs: Of its signals, with which they match that drive.
    """

    offset: float
    scale: float
    likeness: float
    reference: str
    signs: Signs


def find_placement(
    distance: FloatArray,
    recorded: FloatArray,
    references: Mapping[str, Reference],
    signs: Sequence[Signs],
    *,
    smooth: bool = False,
) -> Placement | None:
    """Find where a recording lies by the signals that it shares with simulated drives of the same road.

    A coarse search takes the normalised cross-correlation with the highest score (`significance.SignificanceTest`) over
    all drives, signs, offsets and some scales (J. P. Lewis, Fast Normalized Cross-Correlation, 1995, with the means
    subtracted once); a simplex search refines offset and scale, and what overlaps there decides.

    Args:
        distance: Of the recording, not descending, its zero anywhere (m,) [m].
        recorded: Its signals, NaN where there is no value (signals, m).
        references: By name the simulated drives.
        signs: Those that its signals may have.
        smooth: The road is smooth but for its bumps.

    Returns:
        None where no position matches a simulated drive better than chance, or several do.

    Example:
        >>> import numpy as np
        >>> x = np.arange(0, 100, 0.1)
        >>> road = np.convolve(np.random.default_rng(1).normal(size=1000), np.hanning(11), "same")[None]
        >>> placement = find_placement(x[:500], road[:, 350:850], {"passive": (x, road)}, [(1,)])
        >>> placement.reference, round(placement.offset, 2)
        ('passive', 35.0)
    """
    return _Search(distance, recorded, references, smooth=smooth).best_match(signs)


def correlations(where: FloatArray, recorded: FloatArray, position: FloatArray, simulated: FloatArray) -> FloatArray:
    """Return the correlation coefficient of each signal at positions `where` [m] (signals,); 0 of a constant one."""
    if len(where) < 3:
        return np.zeros(len(recorded))
    weight = np.gradient(where)  # samples may be dense where the car is slow
    total = max(weight.sum(), 1e-12)
    coefficients = []
    for one, row in zip(recorded, simulated, strict=True):
        other = np.interp(where, position, row)
        a, b = one - (weight @ one) / total, other - (weight @ other) / total
        size = sqrt((weight @ (a * a)) * (weight @ (b * b)))
        coefficients.append(float(weight @ (a * b) / size) if size else 0.0)
    return np.array(coefficients)


def _spacing(length: float, least: float, most: int) -> float:
    return max(least, length / most)


def evenly(distance: FloatArray, signals: FloatArray, spacing: float) -> tuple[FloatArray, FloatArray]:
    """Return even distances (n,) [m] and the signals there (signals, n), interpolated linearly where values lack."""
    even = np.arange(distance[0], distance[-1] + spacing / 2, spacing)
    there = [np.isfinite(row) for row in signals]
    rows = [
        np.interp(even, distance[finite], row[finite]) if finite.any() else np.zeros_like(even)
        for row, finite in zip(signals, there, strict=True)
    ]
    return even, np.array(rows)


class ReferenceDrive:
    """A simulated drive, also at even distances and normalised locally, to be correlated with a recording.

    Args:
        position: Ascending (n,) [m].
        simulated: Its signals there (signals, n).
        most: Samples of a recording, at most.
        significance: Its spacing is that of the even distances.

    Attributes:
        informative: Length of road that shows the position [m].
    """

    def __init__(self, position: FloatArray, simulated: FloatArray, most: int, significance: SignificanceTest) -> None:
        self.position, self.simulated = position, simulated
        self.even, rows = evenly(position, simulated, significance.spacing)
        self.informative = significance.informative_length(self.even, rows)
        self.rows = significance.normalise_locally(rows)
        self.autocorrelations = significance.autocorrelations(self.rows)
        self._size = next_fast_len(self.rows.shape[1] + most, real=True)
        self._spectrum, self._energy = rfft(self.rows, self._size), _energies(self.rows)

    def correlate(self, rows: FloatArray) -> tuple[FloatArray, FloatArray]:
        """Return each signal's normalised correlation by shift (signals, shifts), and the overlap in samples (shifts,).

        Shift k has the recording's last sample at the k-th of the drive.
        """
        count, own = self.rows.shape[1], rows.shape[1]
        cross = irfft(self._spectrum * rfft(rows[:, ::-1], self._size), self._size)[:, : count + own - 1]
        shift = np.arange(count + own - 1)
        first, last = np.maximum(0, shift - own + 1), np.minimum(count, shift + 1)
        before, energy = shift - own + 1, _energies(rows)
        size = (self._energy[:, last] - self._energy[:, first]) * (energy[:, last - before] - energy[:, first - before])
        least = 1e-6 * self._energy[:, -1:] * energy[:, -1:]  # a constant signal would match anything
        return cross / np.sqrt(np.maximum(size, np.maximum(least, 1e-300))), (last - first).astype(np.float64)


def _energies(rows: FloatArray) -> FloatArray:
    """Return sums of squares up to each sample (signals, n + 1)."""
    return np.pad(np.cumsum(rows**2, axis=1), ((0, 0), (1, 0)))


class _Match(NamedTuple):
    """The best position for one drive, scale and choice of signs.

    Attributes:
        score: `SignificanceTest.score`.
        placement: On the grid of the coarse search.
        distinct: Whether no other position comes near to it.
        tried: Of how many independent positions it is the best.
    """

    score: float
    placement: Placement
    distinct: bool
    tried: float


class _Search:
    """The search for a recording's position among simulated drives; arguments are those of `find_placement`."""

    def __init__(
        self, distance: FloatArray, recorded: FloatArray, references: Mapping[str, Reference], *, smooth: bool
    ) -> None:
        longest = max(float(np.ptp(each)) for each in (distance, *(position for position, _ in references.values())))
        spacing = _spacing(longest, COARSE_SPACING, MOST_POINTS)
        self.significance = SignificanceTest(spacing=spacing, smooth=smooth)
        self.distance, self.recorded = distance, recorded
        most = ceil((1 + LARGEST_SCALE_ERROR) * float(np.ptp(distance)) / spacing) + 2
        self.drives = {name: ReferenceDrive(*each, most, self.significance) for name, each in references.items()}

    def best_match(self, signs: Sequence[Signs]) -> Placement | None:
        """Return the best placement; None where none is significant, or several are about as good."""
        matches = sorted(self._coarse_matches(signs), key=lambda match: match.score)
        if not matches[-1].distinct:
            return None
        # Coarse samples hardly tell the drives apart, and the best scale lies between those tried: refine each.
        best = {match.placement.reference: match.placement for match in matches}
        refined = [self._refine(placement, COARSE_EVALUATIONS) for placement in best.values()]
        placement = self._refine(max(refined, key=self._score), FINE_EVALUATIONS)
        tried = sum(match.tried for match in matches)
        return placement if self._score(placement) >= self.significance.threshold(tried) else None

    def _scales(self) -> list[float]:
        """Return the scales that the coarse search tries; 1 alone where the references do not determine it."""
        drives = self.drives.values()
        if min(drive.informative for drive in drives) < LEAST_OVERLAP_FOR_SCALE:
            return [1.0]
        shared = min(float(np.ptp(each)) for each in (self.distance, *(drive.position for drive in drives)))
        steps = min(MOST_SCALES, ceil(LARGEST_SCALE_ERROR * shared / (4 * SHIFTED)))
        scales: list[float] = (1 + np.linspace(-LARGEST_SCALE_ERROR, LARGEST_SCALE_ERROR, 2 * steps + 1)).tolist()
        return scales

    def _coarse_matches(self, signs: Sequence[Signs]) -> Iterator[_Match]:
        """Yield the best position of every drive, scale and choice of signs."""
        significance, spacing = self.significance, self.significance.spacing
        own = significance.autocorrelations(
            significance.normalise_locally(evenly(self.distance, self.recorded, spacing)[1])
        )
        for scale in self._scales():
            even, rows = evenly(scale * self.distance, self.recorded, spacing)
            rows = significance.normalise_locally(rows)
            for name, drive in self.drives.items():
                by_signal, samples = drive.correlate(rows)
                enough = samples > min(LEAST_OVERLAP / spacing, drive.rows.shape[1] / 2, rows.shape[1] / 2) - 0.5
                for each in signs:
                    sign = np.array(each, dtype=np.float64)
                    likeness = np.where(enough, sign @ by_signal / len(sign), 0.0)
                    signed = sign[:, None, None] * sign[:, None] * own
                    per_independent = significance.samples_per_independent_one(signed, drive.autocorrelations)
                    score = significance.score(likeness, samples, per_independent)
                    at = int(score.argmax())
                    start = drive.even[0] + (at - (rows.shape[1] - 1)) * spacing  # of the recording's first sample
                    offset, like = float(start - even[0]), float(likeness[at])
                    placement = Placement(offset=offset, scale=scale, likeness=like, reference=name, signs=each)
                    distinct = _is_distinct(at, score, likeness, samples, spacing)
                    yield _Match(float(score[at]), placement, distinct, len(samples) / per_independent)

    def _refine(self, coarse: Placement, evaluations: int) -> Placement:
        """Refine offset and scale about the middle of the overlap, with its likeness.

        Where the overlap, or the part of it that shows the position, is short, the scale is 1.
        """
        drive, distance = self.drives[coarse.reference], self.distance
        recorded = apply_signs(self.recorded, coarse.signs)
        position, offset, scale = drive.position, coarse.offset, coarse.scale
        start, end = np.clip((position[[0, -1]] - offset) / scale, distance[0], distance[-1]).tolist()
        part = (distance >= start - EXCLUSION_DISTANCE) & (distance <= end + EXCLUSION_DISTANCE)
        even, clean = evenly(distance[part], recorded[:, part], _spacing(end - start, FINE_SPACING, MOST_FINE_POINTS))
        free = min(end - start, drive.informative) >= LEAST_OVERLAP_FOR_SCALE
        middle = (start + end) / 2  # about which a change of scale shifts nothing

        def placement(at: FloatArray) -> Placement:
            new = float(np.clip(scale + at[1], 1 - LARGEST_SCALE_ERROR, 1 + LARGEST_SCALE_ERROR)) if free else 1.0
            moved = float(offset + scale * middle + at[0] - new * middle)
            where = moved + new * even
            inside = (where >= position[0]) & (where <= position[-1])
            likeness = correlations(where[inside], clean[:, inside], position, drive.simulated)
            return replace(coarse, offset=moved, scale=new, likeness=float(np.mean(likeness)))

        def unlikeness(at: FloatArray) -> float:
            return -placement(at).likeness

        inward = -1 if scale > 1 else 1  # a scale at its limit can only go there
        simplex = np.array([[0.0, 0.0], [COARSE_SPACING, 0.0], [0.0, inward * 0.1 / (end - start)]])
        best = fmin(
            unlikeness, simplex[0], xtol=1e-7, ftol=1e-10, maxfun=evaluations, disp=False, initial_simplex=simplex
        )
        return placement(best)

    def _score(self, placement: Placement) -> float:
        """Return the score of a placement by the parts of both drives that overlap there."""
        significance, drive = self.significance, self.drives[placement.reference]
        where = placement.offset + placement.scale * self.distance
        own, signals = evenly(where, apply_signs(self.recorded, placement.signs), significance.spacing)
        inside = (own >= drive.even[0]) & (own <= drive.even[-1])
        if np.count_nonzero(inside) < 3:
            return 0.0
        ours = significance.normalise_locally(signals)[:, inside]
        theirs = np.array([np.interp(own[inside], drive.even, each) for each in drive.rows])
        ours, theirs = (each - each.mean(axis=1, keepdims=True) for each in (ours, theirs))
        size = np.sqrt((ours**2).sum(axis=1) * (theirs**2).sum(axis=1)) + 1e-300
        likeness = np.mean((ours * theirs).sum(axis=1) / size, keepdims=True)
        per_independent = significance.samples_per_independent_one(
            significance.autocorrelations(ours), significance.autocorrelations(theirs)
        )
        return float(significance.score(likeness, np.array([ours.shape[1]]), per_independent)[0])


def apply_signs(recorded: FloatArray, signs: Signs) -> FloatArray:
    """Return the signals with those signs (signals, m)."""
    return np.array(signs, dtype=np.float64)[:, None] * recorded


def _is_distinct(at: int, score: FloatArray, likeness: FloatArray, samples: FloatArray, spacing: float) -> bool:
    """Check whether no other shift comes near to the best one's score, or with a like overlap to its likeness."""
    if not likeness[at] > 0:
        return False
    far = np.abs(np.arange(len(score)) - at) * spacing > EXCLUSION_DISTANCE
    like = far & (samples >= samples[at] / 2)
    nearest = score[far].max(initial=0.0) / max(score[at], 1e-300), likeness[like].max(initial=0.0) / likeness[at]
    return bool(max(nearest) <= MOST_RIVAL_SHARE)
