"""The same scenario over several roads: mean of every metric and the paired change against a baseline.

One road's peaks are partly luck: which part of the roughness meets the bump, and where the control grid lies. Roads
differ in their seed alone, and every strategy drives the same ones, so that a change is of pairs.
"""

from collections.abc import Iterable, Iterator, Mapping, Sequence
from dataclasses import dataclass
from typing import Any

from sim_core.scenario import Scenario
from sim_core.simulate import simulate
from sim_core.study.intervals import Interval, changes_with_intervals, means_with_intervals

MAX_ROADS = 50

# Numbers by name, in mappings of any depth: {"bump": {"body_acceleration": {"rms": 1.2, "peak": 3.4}}}
Numbers = Mapping[str, Any]


@dataclass(frozen=True, slots=True, kw_only=True)
class Comparison:
    """Strategies over the same roads.

    Attributes:
        means: strategy -> the numbers of one road, each replaced by the mean over the roads with its 95 % interval.
        changes: strategy -> the same, as the paired change of the mean against the baseline [%]; NaN where the
            baseline's mean is zero. Without the baseline itself.
    """

    means: Mapping[str, Numbers]
    changes: Mapping[str, Numbers]


def seeded(scenario: Scenario, roads: int) -> list[Scenario]:
    """The scenario on so many roads: seeds `road.seed`, `road.seed` + 1, ..."""
    first = scenario.road.seed
    return [
        scenario.model_copy(update={"road": scenario.road.model_copy(update={"seed": seed})})
        for seed in range(first, first + roads)
    ]


def numbers(metrics: Numbers, comfort: Numbers) -> Numbers:
    """What of one strategy's result on one road has a mean: its metrics by window, and `comfort` beside them."""
    return {**metrics, "comfort": comfort}


def drive(scenario: Scenario, strategies: Iterable[str], roads: int) -> dict[str, list[Numbers]]:
    """Drive every strategy over so many roads; by strategy its `numbers` on each, as `compare` takes them.

    Road by road: strategies share a road's heights, roads share speed plan, sampled drive and controllers. Time
    histories are let go of at once, so that the next road finds their memory.

    Raises:
        UnknownNameError: No such strategy.
        RidelabError: The vehicle and weights admit no stabilising controller.
    """
    driven: dict[str, list[Numbers]] = {name: [] for name in strategies}
    for road in seeded(scenario, roads):
        for name, of_strategy in driven.items():
            result = simulate(road, name)
            of_strategy.append(numbers(result.metrics, result.comfort))
    return driven


def compare(driven: Mapping[str, Sequence[Numbers]], baseline: str) -> Comparison:
    """Mean and paired change of every number.

    Args:
        driven: strategy -> its numbers on each road, the same roads in the same order for all.
        baseline: What the changes refer to; where it was not driven there are no changes.

    Raises:
        ValueError: Not every strategy has as many roads as the baseline.
    """
    samples = {name: [list(_leaves(each)) for each in roads] for name, roads in driven.items()}
    base = samples.get(baseline)
    return Comparison(
        means={name: _like(driven[name][0], means_with_intervals(sample)) for name, sample in samples.items()},
        changes={
            name: _like(driven[name][0], changes_with_intervals(sample, base))
            for name, sample in samples.items()
            if base is not None and name != baseline
        },
    )


def _leaves(part: Numbers) -> Iterator[float]:
    for value in part.values():
        if isinstance(value, Mapping):
            yield from _leaves(value)
        else:
            yield value


def _like(part: Numbers, values: Iterable[Interval]) -> dict[str, Any]:
    """Mappings like these, with the values in the place of their numbers."""
    rest = iter(values)

    def filled(each: Numbers) -> dict[str, Any]:
        return {key: filled(value) if isinstance(value, Mapping) else next(rest) for key, value in each.items()}

    return filled(part)
