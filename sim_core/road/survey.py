"""From a surveyed profile to a road that can be driven: resampled, freed of its slope, smoothed; and the bumps in it.

docs/explanation/road.md has the steps and their sources.
"""

from dataclasses import dataclass
from math import ceil

import numpy as np

from sim_core.arrays import FloatArray
from sim_core.scenario.measured import SPACING

CONTACT = 0.1  # heights are averaged over so much of the road, as a tyre's contact does [m]
LEVEL = 20.0  # a bump stands out from the median of so much of the road [m]
LEAST_BUMP = 0.025  # and by at least so much [m]
_COARSE = 0.1  # bumps are looked for at heights so far apart [m]
_MOST_BUMPS = 5


@dataclass(frozen=True, slots=True, kw_only=True)
class SurveyedRoad:
    """Heights SPACING apart from x = 0 on (samples,) [m], and the straight line that was taken from them.

    Attributes:
        heights: Without the line, smoothed.
        offset: Of the line at the profile's start [m].
        slope: Of the line [1].
    """

    heights: FloatArray
    offset: float
    slope: float


@dataclass(frozen=True, slots=True, kw_only=True)
class DetectedBump:
    """A bump in a profile: where it begins, how wide and how high it is [m]; a pothole's height is negative."""

    start: float
    width: float
    height: float


def surveyed(distance: FloatArray, height: FloatArray) -> SurveyedRoad:
    """Return the road of heights (n,) [m] at ascending distances (n,) [m], whose first one becomes x = 0.

    Between two heights it is straight; taken from it is the line that fits it best (least squares), and each height is
    the mean of the 11 within CONTACT around it, which leaves sin(11 πs/λ)/(11 sin(πs/λ)) of a wave of length λ.
    """
    position = distance - distance[0]
    x = np.arange(ceil(position[-1] / SPACING - 1e-6) + 1) * SPACING
    x = x[x <= position[-1] + 1e-6]
    heights = np.interp(x, position, height)
    centred = x - x.mean()
    slope = float(centred @ heights / (centred @ centred))
    offset = float(heights.mean() - slope * x.mean())
    window = round(CONTACT / SPACING) + 1
    from scipy.ndimage import uniform_filter1d  # takes a tenth of a second: most processes never survey a road

    inner = uniform_filter1d(heights - offset - slope * x, window, mode="nearest")
    return SurveyedRoad(heights=inner, offset=offset, slope=slope)


def bumps_in(heights: FloatArray) -> list[DetectedBump]:
    """Return the bumps and potholes in a profile (samples,) SPACING apart [m], the largest first.

    Each stands out from the running median over LEVEL by at least LEAST_BUMP and six times what the rest of the road
    does (by its median absolute deviation). It ends beyond a tenth of its height where it falls no more.
    """
    from scipy.ndimage import median_filter  # takes a tenth of a second: most processes never look for bumps

    step = round(_COARSE / SPACING)
    coarse = heights[::step]
    window = min(2 * round(LEVEL / _COARSE / 2) + 1, len(coarse))
    above = coarse - median_filter(coarse, window, mode="nearest")
    rest = 1.4826 * float(np.median(np.abs(above)))
    size = np.abs(above)
    bumps: list[DetectedBump] = []
    while len(bumps) < _MOST_BUMPS:
        crest = int(size.argmax())
        if size[crest] < max(LEAST_BUMP, 6 * rest):
            break
        foot = max(0.1 * size[crest], min(2 * rest, 0.5 * size[crest]))
        low = np.flatnonzero((size < foot) | (np.sign(above) != np.sign(above[crest])))
        first = int(low[low < crest].max(initial=0))
        last = int(low[low > crest].min(initial=len(coarse) - 1))
        while first > 0 and 0 < size[first - 1] < size[first]:
            first -= 1
        while last < len(coarse) - 1 and 0 < size[last + 1] < size[last]:
            last += 1
        bumps.append(
            DetectedBump(
                start=round(first * _COARSE, 2),
                width=round((last - first) * _COARSE, 2),
                height=round(float(above[crest]), 4),
            )
        )
        size[first : last + 1] = 0.0
    return bumps
