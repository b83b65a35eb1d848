"""A change of one number against another, and whether it is more than random variation."""

from dataclasses import dataclass, replace
from math import isfinite, nan

from sim_core.comparison.intervals import Interval
from sim_core.comparison.numbers import LEAST_SHOWN_CHANGE, ZERO_TOLERANCE, significant

# What rounding leaves in a control loop on a smooth road is below this, in any unit that is shown.
_LOOP_TOLERANCE = 1e-6


@dataclass(frozen=True, slots=True, kw_only=True)
class Change:
    """The change of a metric against the baseline's.

    Attributes:
        change: In percent of the baseline's value, of several roads the change of the mean; None where the baseline's
            value is zero.
        low: Lower end of its 95 % interval over several roads [%]; None on one road.
        high: Upper end, likewise.
        beyond_variation: Whether the values differ by more than random variation explains: on one road by more than
            what one road resolves (`variation_of_one_road`), over several where the interval does not contain zero.
            Never where both values show as the same digits in the unit they are shown in.

    Example:
        >>> from sim_core import Scenario, compare, simulate
        >>> comparison = compare({name: simulate(Scenario(), name) for name in ("lqr", "passive")})
        >>> change = comparison.changes["lqr"]["travel_time"]
        >>> round(change.change, 1), change.low, change.beyond_variation
        (82.1, None, True)
    """

    change: float | None
    low: float | None = None
    high: float | None = None
    beyond_variation: bool


def change_on_one_road(value: float, base: float, *, scale: float = 1.0, variation: float = 0.0) -> Change:
    """Return the change of a value against another one on the same road.

    Args:
        value: In SI units.
        base: What it is compared with.
        scale: From the SI unit to the unit in which both are shown.
        variation: Smaller changes [%] may be random; 0 where nothing is random.

    Example:
        >>> change_on_one_road(0.9, 1.0, variation=15)
        Change(change=-10.0, low=None, high=None, beyond_variation=False)
    """
    change = 100 * (value - base) / abs(base) if base else nan
    return _change(change, value, base, scale, is_sure=abs(change) >= variation)


def change_over_roads(interval: Interval, value: float, base: float, *, scale: float = 1.0) -> Change:
    """Return the change of a mean over several roads, whose interval is known already.

    Args:
        interval: Of the change [%], paired by road; NaN against a zero.
        value: The mean [SI unit].
        base: The mean that it is compared with.
        scale: From the SI unit to the unit in which both are shown.
    """
    change = _change(interval.value, value, base, scale, is_sure=interval.low > 0 or interval.high < 0)
    return change if change.change is None else replace(change, low=interval.low, high=interval.high)


def _change(change: float, value: float, base: float, scale: float, *, is_sure: bool) -> Change:
    """Return the change [%] of a value against a base; `is_sure` where it is larger than what is random."""
    if not isfinite(change) or abs(base * scale) < _LOOP_TOLERANCE:
        return Change(change=None, beyond_variation=abs(value * scale) >= _LOOP_TOLERANCE)
    beyond = is_sure and abs(change) >= LEAST_SHOWN_CHANGE and not shown_alike(value, base, scale)
    return Change(change=change, beyond_variation=beyond)


def shown_alike(value: float, base: float, scale: float = 1.0) -> bool:
    """Check whether two values show as the same digits in the unit that `scale` leads to."""
    shown, other = value * scale, base * scale
    larger = max(abs(shown), abs(other))
    if larger > ZERO_TOLERANCE and abs(shown - other) > 0.01 * larger:
        return False  # three digits tell them apart: no need to write them
    return significant(shown) == significant(other)
