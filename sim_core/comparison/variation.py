"""Thresholds below which a change on one random road may be random variation.

A road's roughness is random. Of two roads of the same class, one meets the bump with a peak where the other has a
valley, so the same car on the other road has other peaks. A strategy that follows a control grid varies once more with
where its held force changes. docs/explanation/luck.md has the measurement (twenty roads, the bump moved by 0 to 6 cm)
and the program that repeats it: of two runs of LV control that differ in nothing else, one pair in twenty has peaks
that lie 15 % apart; of all others, and of every RMS, 7 %.
"""

from collections.abc import Iterable, Mapping

from sim_core.catalogue import METRICS, PEAK, RMS
from sim_core.control.mpc import PredictiveController
from sim_core.strategies import find_strategy

_RESOLUTION = 7.0  # [%]
_RESOLUTION_OF_PREDICTIVE_PEAKS = 15.0  # [%]


def one_road_resolution(strategy: str) -> dict[str, float]:
    """Return by statistic the smallest change [%] that one random road tells from random variation.

    The one of an RMS is also that of the comfort metrics. A strategy that is not known, such as that of a recorded
    drive, counts as predictive.

    Example:
        >>> one_road_resolution("lv")
        {'rms': 7.0, 'peak': 15.0}
    """
    predictive = issubclass(find_strategy(strategy) or PredictiveController, PredictiveController)
    return {RMS: _RESOLUTION, PEAK: _RESOLUTION_OF_PREDICTIVE_PEAKS if predictive else _RESOLUTION}


def variation_of_one_road(metric: str, resolutions: Iterable[Mapping[str, float]]) -> float:
    """Return the change [%] up to which a metric of several strategies may differ on one random road by chance.

    Args:
        metric: Flat name, such as `bump.body_acceleration.peak`.
        resolutions: `one_road_resolution` of each strategy; the largest counts.

    Returns:
        0 for times, speeds and events, which do not depend on the roughness.
    """
    path = METRICS[metric].path
    if path[0] not in ("metrics", "comfort"):
        return 0.0
    return max(resolution.get(path[-1], resolution[RMS]) for resolution in resolutions)
