"""The largest value of one quantity that keeps a metric at or below a limit.

First a scan of the whole range, so that a metric that rises and falls is seen; then Brent's method (R. P. Brent 1973,
Algorithms for Minimization without Derivatives, chapter 4) between the last value that keeps the limit and the next.
Here are the numbers alone: `next_indices` says which values to drive next, given those that were.
"""

import math
from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from itertools import pairwise

SCAN_INTERVALS = 16
MAX_REFINEMENTS = 16  # bisection needs 10: a sixteenth of 9999 steps
MAX_VALUES = SCAN_INTERVALS + 1 + MAX_REFINEMENTS

# By the index of a value: what is held to the limit; infinite where the car cannot be driven with it.
Bounds = Mapping[int, float]


@dataclass(frozen=True, slots=True, kw_only=True)
class Axis:
    """The values that may be tried: both ends of a range and between them the multiples of a decimal step.

    Attributes:
        low: Lowest value, index 0.
        high: Highest value, index `last`.
        exponent: The step is 10 to this power.
        first: Index 1 is this multiple of the step.
        last: Index of the highest value.
    """

    low: float
    high: float
    exponent: int
    first: int
    last: int

    @classmethod
    def of(cls, low: float, high: float, *, whole: bool) -> "Axis":
        """Between 1000 and 9999 steps over the range, or steps of 1 where the values are whole numbers and fewer."""
        exponent = math.floor(math.log10(high - low)) - 3
        exponent = max(0, exponent) if whole else exponent
        step = 10.0**exponent
        slack = 1e-6 + 1e-15 * max(abs(low), abs(high)) / step  # both divisions round
        first, after = math.floor(low / step + slack) + 1, math.ceil(high / step - slack)
        return cls(low=low, high=high, exponent=exponent, first=first, last=after - first + 1)

    def value(self, index: int) -> float:
        """The value of that index, short in decimals."""
        if index in (0, self.last):
            return self.low if index == 0 else self.high
        return round((self.first + index - 1) * 10.0**self.exponent, -self.exponent)

    def resolved(self, index: int, width: float) -> float:
        """The value of that index in as many decimals as values within `width` steps are told apart; never above it."""
        exponent = math.floor(math.log10(width / 2)) + self.exponent if width > 0 else self.exponent
        if exponent <= self.exponent:
            return self.value(index)
        step = 10.0**exponent
        down = math.floor(self.value(index) / step + 1e-9) * step
        return max(self.low, round(down, -exponent))

    @property
    def scan(self) -> list[int]:
        """The indices tried first, evenly over the range with both ends."""
        return sorted({round(self.last * part / SCAN_INTERVALS) for part in range(SCAN_INTERVALS + 1)})


class _NotTriedError(Exception):
    """Brent's method asks for a value that was not tried yet; ends its replay with that value's index."""

    def __init__(self, index: int) -> None:
        self.index = index


def next_indices(axis: Axis, limit: float, bounds: Bounds) -> list[int]:
    """Return the indices of the values to try next; none where the bracket is one step wide, or enough were tried."""
    scan = axis.scan
    if missing := [index for index in scan if index not in bounds]:
        return missing
    low, high = bracket(axis, limit, bounds)
    left = MAX_REFINEMENTS - (len(bounds) - len(scan))
    if low is None or high - low <= 1 or left == 0:
        return []
    start = max(index for index in scan if index <= low)
    # Brent's method is slow where the metric touches the limit: bisection, when no more steps than it needs are left.
    tight = high - low > 2 ** (left - 1)
    asked = None if tight else _brent(start, min(index for index in scan if index > start), limit, bounds)
    return [(low + high) // 2 if asked is None else asked]


def bracket(axis: Axis, limit: float, bounds: Bounds) -> tuple[int | None, int]:
    """The largest value tried that keeps the limit (None: none does), and the next larger one tried or itself."""
    low = max((index for index, bound in bounds.items() if bound <= limit), default=None)
    if low is None or low == axis.last:
        return low, axis.last
    return low, min(index for index in bounds if index > low)


def _brent(low: int, high: int, limit: float, bounds: Bounds) -> int | None:
    """Return the index that Brent's method asks for next between these; None where it has ended.

    SciPy's method is replayed from its start over the values tried; the exception of the first one that is missing
    carries its index out.
    """
    from scipy.optimize import brentq  # takes a tenth of a second: most processes never need it

    finite = [abs(bounds[end] - limit) for end in (low, high) if math.isfinite(bounds[end])]
    far = max(finite) or 1.0  # how far off a bound counts that is infinite, or at the limit as a whole plateau may be

    def margin(index: float) -> float:
        nearest = round(index)
        if nearest not in bounds:
            raise _NotTriedError(nearest)
        difference = bounds[nearest] - limit
        if difference == 0:
            return -far
        return difference if math.isfinite(difference) else far

    try:
        brentq(margin, low, high, xtol=0.5)
    except _NotTriedError as missing:
        return missing.index
    return None


def alike(limit: float, bounds: Bounds, best: int, share: float) -> tuple[float, float]:
    """Between which indices the metric differs from the limit by less than that share of it [1], about the best value.

    Straight between values tried. Where the metric jumps over the limit, both ends lie between two of them.
    """
    indices = sorted(bounds)
    place = indices.index(best)

    def end(indices_outwards: Sequence[int], target: float) -> float:
        for one, other in pairwise(indices_outwards):
            if not math.isfinite(bounds[other]):
                return one
            step = bounds[other] - bounds[one]
            if step and (bounds[other] - target) * (bounds[best] - target) <= 0:
                return one + (target - bounds[one]) / step * (other - one)
        return indices_outwards[-1]

    tolerance = share * abs(limit)
    if bounds[best] < limit - tolerance:  # a jump
        return best, best
    return end(indices[place::-1], limit - tolerance), end(indices[place:], limit + tolerance)


def spans_over(limit: float, bounds: Bounds, below: int) -> list[tuple[int, int]]:
    """Return the stretches below that index that exceed the limit, each with its first and last index tried."""
    spans: list[tuple[int, int]] = []
    below_limit = True
    for index in sorted(index for index in bounds if index < below):
        over = bounds[index] > limit
        if over:
            spans.append((index, index) if below_limit else (spans.pop()[0], index))
        below_limit = not over
    return spans


def turning_points(bounds: Bounds, resolution: float) -> list[int]:
    """Return the indices where bounds cease to rise or to fall, with both ends; fewer than three if they are monotone.

    Args:
        bounds: Finite ones.
        resolution: A turn back by no more than this share of the greatest magnitude is none [1].
    """
    indices = sorted(bounds)
    least = resolution * max(map(abs, bounds.values()), default=0.0)
    points, extreme, direction = indices[:1], indices[:1], 0
    for index in indices[1:]:
        step = bounds[index] - bounds[extreme[0]]
        if step * direction > 0 or (direction == 0 and abs(step) > least):
            direction = direction or (1 if step > 0 else -1)
            extreme = [index]
        elif direction and abs(step) > least:
            points.append(extreme[0])
            extreme, direction = [index], -direction
    return points + extreme if direction else points
