"""The same scenario over several roads: mean of every metric and the paired change against a baseline.

Roads differ in their seed alone, and every strategy drives the same ones, so that a change is of pairs. What the
numbers mean is `sim_core.comparison`'s: here they are only put into the shape of a result.
"""

from collections.abc import Iterable, Mapping, Sequence
from dataclasses import dataclass
from typing import Any

from sim_core import Scenario
from sim_core.comparison.intervals import Interval, changes_with_intervals, means_with_intervals

MAX_ROADS = 50

# Numbers by name, in mappings of any depth: {"bump": {"body_acceleration": {"rms": 1.2, "peak": 3.4}}}
Numbers = Mapping[str, Any]
# strategy -> the same with an `Interval` for each number [%]
Changes = Mapping[str, Numbers]


@dataclass(frozen=True, slots=True, kw_only=True)
class OverRoads:
    """Means and changes of strategies over the same roads.

    Attributes:
        means: strategy -> the numbers of one road, each replaced by the mean over the roads with its 95 % interval.
        changes: strategy -> the same, as the paired change of the mean against the baseline [%]; NaN where the
            baseline's mean is zero. Without the baseline itself.
    """

    means: Mapping[str, Numbers]
    changes: Changes


def with_seeds(scenario: Scenario, roads: int) -> list[Scenario]:
    """Return the scenario on so many roads: seeds `road.seed`, `road.seed` + 1, ..."""
    first = scenario.road.seed
    return [
        scenario.model_copy(update={"road": scenario.road.model_copy(update={"seed": seed})})
        for seed in range(first, first + roads)
    ]


def numbers(metrics: Numbers, comfort: Numbers) -> Numbers:
    """Return the metrics that can be averaged over roads: those by window, and `comfort` beside them."""
    return {**metrics, "comfort": comfort}


def means_and_changes(driven: Mapping[str, Sequence[Numbers]], baseline: str) -> OverRoads:
    """Return the mean of every number and its paired change against the baseline.

    Args:
        driven: strategy -> its numbers on each road, the same roads in the same order for all.
        baseline: What the changes refer to; where it was not driven there are no changes.

    Raises:
        ValueError: Not every strategy has as many roads as the baseline.
    """
    samples = {name: _sample(roads) for name, roads in driven.items()}
    others = [name for name in driven if baseline in driven and name != baseline]
    return OverRoads(
        means={name: _like(driven[name][0], means_with_intervals(sample)) for name, sample in samples.items()},
        changes={
            name: _like(driven[name][0], changes_with_intervals(samples[name], samples[baseline])) for name in others
        },
    )


def paired_changes(driven: Mapping[str, Sequence[Numbers]], against: Mapping[str, Sequence[Numbers]]) -> Changes:
    """Return the change of the mean of every number against that of the same name in `against` [%], road by road.

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
    """Return all numbers of each road, in one order."""
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
    """Return mappings like these, with the values in the place of their numbers."""
    rest = iter(values)

    def filled(each: Numbers) -> dict[str, Any]:
        return {key: filled(value) if isinstance(value, Mapping) else next(rest) for key, value in each.items()}

    return filled(part)
