"""The same scenario over several roads: mean of every metric and the paired change against a baseline.

One road's peaks are partly luck: which part of the roughness meets the bump, and where the control grid lies. Roads
differ in their seed alone, and every strategy drives the same ones, so that a change is of pairs. What one road alone
cannot tell from luck is smaller than `one_road_resolution`.
"""

from collections.abc import Iterable, Mapping, Sequence
from dataclasses import dataclass
from typing import Any

from backend.intervals import Interval, changes_with_intervals, means_with_intervals
from sim_core import PredictiveController, Scenario
from sim_core.catalogue import PEAK, RMS
from sim_core.strategies import strategies

MAX_ROADS = 50

# Smaller changes [%] on one road may be luck (docs/explanation/luck.md).
_RESOLUTION = 7.0
_RESOLUTION_OF_PREDICTIVE_PEAKS = 15.0

# Numbers by name, in mappings of any depth: {"bump": {"body_acceleration": {"rms": 1.2, "peak": 3.4}}}
Numbers = Mapping[str, Any]
# strategy -> the same with an `Interval` for each number [%]
Changes = Mapping[str, Numbers]


@dataclass(frozen=True, slots=True, kw_only=True)
class Comparison:
    """Strategies over the same roads.

    Attributes:
        means: strategy -> the numbers of one road, each replaced by the mean over the roads with its 95 % interval.
        changes: strategy -> the same, as the paired change of the mean against the baseline [%]; NaN where the
            baseline's mean is zero. Without the baseline itself.
    """

    means: Mapping[str, Numbers]
    changes: Changes


def seeded(scenario: Scenario, roads: int) -> list[Scenario]:
    """The scenario on so many roads: seeds `road.seed`, `road.seed` + 1, ..."""
    first = scenario.road.seed
    return [
        scenario.model_copy(update={"road": scenario.road.model_copy(update={"seed": seed})})
        for seed in range(first, first + roads)
    ]


def default_baseline(strategies: Sequence[str]) -> str:
    """The default baseline of changes: passive, or the first strategy where passive is not run."""
    return "passive" if "passive" in strategies else strategies[0]


def one_road_resolution(strategy: str) -> dict[str, float]:
    """By statistic the smallest change [%] that one road tells from luck; an RMS's is also that of comfort figures.

    Of two strategies the larger one counts; one that is there no more counts as predictive.
    """
    predictive = issubclass(strategies().get(strategy, PredictiveController), PredictiveController)
    return {RMS: _RESOLUTION, PEAK: _RESOLUTION_OF_PREDICTIVE_PEAKS if predictive else _RESOLUTION}


def numbers(metrics: Numbers, comfort: Numbers) -> Numbers:
    """What of one strategy's result on one road has a mean: its metrics by window, and `comfort` beside them."""
    return {**metrics, "comfort": comfort}


def compare(driven: Mapping[str, Sequence[Numbers]], baseline: str) -> Comparison:
    """Mean and paired change of every number.

    Args:
        driven: strategy -> its numbers on each road, the same roads in the same order for all.
        baseline: What the changes refer to; where it was not driven there are no changes.

    Raises:
        ValueError: Not every strategy has as many roads as the baseline.
    """
    samples = {name: _sample(roads) for name, roads in driven.items()}
    others = [name for name in driven if baseline in driven and name != baseline]
    return Comparison(
        means={name: _like(driven[name][0], means_with_intervals(sample)) for name, sample in samples.items()},
        changes={
            name: _like(driven[name][0], changes_with_intervals(samples[name], samples[baseline])) for name in others
        },
    )


def paired_changes(driven: Mapping[str, Sequence[Numbers]], against: Mapping[str, Sequence[Numbers]]) -> Changes:
    """Change of the mean of every number against that of the same name in `against` [%], paired road by road.

    Args:
        driven: name -> its numbers on each road, as `numbers` gives them.
        against: The same of what changes refer to, over the same roads in the same order; names that only one has
            are left out.

    Raises:
        ValueError: One of them has not as many roads as the other.
    """
    return {
        name: _like(roads[0], changes_with_intervals(_sample(roads), _sample(against[name])))
        for name, roads in driven.items()
        if name in against
    }


def _sample(roads: Sequence[Numbers]) -> list[list[float]]:
    """All numbers of each road, in one order."""
    return [_leaves(road) for road in roads]


def _leaves(part: Numbers) -> list[float]:
    flat: list[float] = []
    for value in part.values():
        if isinstance(value, float | int):  # quicker to tell than a mapping: of 50 roads there are 100,000 numbers
            flat.append(value)
        else:
            flat += _leaves(value)
    return flat


def _like(part: Numbers, values: Iterable[Interval]) -> dict[str, Any]:
    """Mappings like these, with the values in the place of their numbers."""
    rest = iter(values)

    def filled(each: Numbers) -> dict[str, Any]:
        return {key: filled(value) if isinstance(value, Mapping) else next(rest) for key, value in each.items()}

    return filled(part)
