"""The same scenario over several roads: mean of every metric and the paired change against a baseline.

One road's peaks are partly luck: which part of the roughness meets the bump, and where the control grid lies. Roads
differ in their seed alone, and every strategy drives the same ones, so that a change is of pairs.
"""

from collections.abc import Iterable, Iterator, Mapping, Sequence
from dataclasses import dataclass
from typing import Any

from sim_core.result import StrategyResult
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


def drive(scenario: Scenario, strategies: Iterable[str], roads: int) -> dict[str, list[StrategyResult]]:
    """Drive every strategy over so many roads.

    Road by road: strategies share a road's heights, roads share speed plan, sampled drive and controllers.

    Raises:
        UnknownNameError: No such strategy.
        RidelabError: The vehicle and weights admit no stabilising controller.
    """
    results: dict[str, list[StrategyResult]] = {name: [] for name in strategies}
    for each in seeded(scenario, roads):
        for name, found in results.items():
            found.append(simulate(each, name))
    return results


def compare(results: Mapping[str, Sequence[Numbers]], baseline: str) -> Comparison:
    """Mean and paired change of every number.

    Args:
        results: strategy -> its numbers on each road, the same roads in the same order for all.
        baseline: What the changes refer to; without results of it there are no changes.

    Raises:
        ValueError: Not every strategy has as many roads as the baseline.
    """
    samples = {name: [list(_leaves(numbers)) for numbers in roads] for name, roads in results.items()}
    base = samples.get(baseline)
    return Comparison(
        means={name: _like(results[name][0], means_with_intervals(sample)) for name, sample in samples.items()},
        changes={
            name: _like(results[name][0], changes_with_intervals(sample, base))
            for name, sample in samples.items()
            if base is not None and name != baseline
        },
    )


def _leaves(numbers: Numbers) -> Iterator[float]:
    for value in numbers.values():
        if isinstance(value, Mapping):
            yield from _leaves(value)
        else:
            yield value


def _like(numbers: Numbers, values: Iterable[Interval]) -> dict[str, Any]:
    """Mappings like those of `numbers`, with these values in the place of its numbers."""
    rest = iter(values)

    def filled(part: Numbers) -> dict[str, Any]:
        return {key: filled(value) if isinstance(value, Mapping) else next(rest) for key, value in part.items()}

    return filled(numbers)
