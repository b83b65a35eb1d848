"""compare(results, baseline): what the results of several strategies mean beside each other."""

from collections.abc import Iterable, Mapping, Sequence
from dataclasses import dataclass
from typing import Any

from sim_core.comparison.caution import Caution
from sim_core.comparison.change import Change
from sim_core.comparison.rows import COMPARED, Row, changes_between, row_of
from sim_core.comparison.vehicle_cautions import scenario_cautions
from sim_core.comparison.verdict import Verdict, verdict_on
from sim_core.errors import RidelabError
from sim_core.result import StrategyResult
from sim_core.scenario import Scenario


@dataclass(frozen=True, slots=True, kw_only=True)
class Comparison:
    """What the results of several strategies mean beside each other.

    Attributes:
        baseline: The strategy that changes refer to.
        changes: Strategy -> metric, by its flat name -> its change against the baseline. Without the baseline itself,
            and without metrics that either of both does not have.
        verdict: Which strategy is best, in words and metric by metric.
        cautions: Warnings about values outside a car's usual range.

    Example:
        >>> from sim_core import Scenario, compare, simulate
        >>> comparison = compare({name: simulate(Scenario(), name) for name in ("lqr", "passive")})
        >>> comparison.baseline, list(comparison.changes), comparison.verdict.mixed
        ('passive', ['lqr'], False)
    """

    baseline: str
    changes: Mapping[str, Mapping[str, Change]]
    verdict: Verdict
    cautions: tuple[Caution, ...]


def compare(
    results: Mapping[str, StrategyResult | Sequence[StrategyResult]], baseline: str | None = None
) -> Comparison:
    """Return the change of every metric against a baseline, whether it is more than random variation, and who is best.

    A change on one road is beyond random variation where it is at least as large as what one road resolves: 15 % for a
    peak where predictive control is one of both, else 7 % (docs/explanation/luck.md), and any change where nothing is
    random. Over several roads it is beyond where its 95 % interval, paired by road, does not contain zero.

    What is said of one strategy depends on it and the baseline alone, so that another strategy, or another order of
    them, changes no number.

    Args:
        results: Strategy -> its result, or one for each road: the same roads, in the same order, for every strategy.
        baseline: The strategy that changes refer to; None is passive, or the first one where passive is not there.

    Raises:
        RidelabError: There are no results, the baseline is not one of them, or they are not of as many roads.

    Example:
        >>> from sim_core import Scenario, compare, simulate
        >>> scenario = Scenario()
        >>> comparison = compare({name: simulate(scenario, name) for name in ("lv", "passive")})
        >>> change = comparison.changes["lv"]["bump.body_acceleration.peak"]
        >>> round(change.change), change.beyond_variation
        (-85, True)
        >>> print(comparison.verdict.text.partition(". ")[0])
        LV control is best in all 8 metrics
    """
    if not results:
        raise RidelabError("There is nothing to compare: give at least one result")
    if baseline is not None and baseline not in results:
        raise RidelabError(f"The baseline is one of the results, {', '.join(results)}: {baseline} is none of them")
    by_road = {name: [each] if isinstance(each, StrategyResult) else list(each) for name, each in results.items()}
    if len({len(each) for each in by_road.values()} | {0}) != 2:
        counts = ", ".join(f"{len(each)} of {name}" for name, each in by_road.items())
        raise RidelabError(f"Every strategy needs a result on each of the same roads; there are {counts}")
    rows, scenarios = [], []
    for name, each in by_road.items():
        is_random = any(result.scenario.is_random for result in each)
        rows.append(row_of(name, [result.summary() for result in each], is_random=is_random))
        scenarios += [result.scenario for result in each]
    return _compare(rows, baseline or default_baseline(list(results)), scenarios)


def compare_summaries(
    summaries: Mapping[str, Sequence[Mapping[str, Any]]],
    baseline: str,
    scenario: Scenario,
    metrics: Iterable[str] = COMPARED,
) -> Comparison:
    """Return the comparison of results of one scenario of which only the summaries are there.

    Args:
        summaries: Strategy -> `StrategyResult.summary()` on each road, of as many roads each; there may be none.
        baseline: The strategy that changes refer to; one that failed has no summaries, and then there are no changes.
        scenario: What was driven, on the first road.
        metrics: Flat names of those that are compared.
    """
    keys = tuple(metrics)
    rows = [row_of(name, each, is_random=scenario.is_random, metrics=keys) for name, each in summaries.items()]
    return _compare(rows, baseline, [scenario])


def _compare(rows: Sequence[Row], baseline: str, scenarios: Iterable[Scenario]) -> Comparison:
    base = next((row for row in rows if row.strategy == baseline), None)
    changes = {} if base is None else {row.strategy: changes_between(row, base) for row in rows if row is not base}
    cautions = dict.fromkeys(caution for scenario in scenarios for caution in scenario_cautions(scenario))
    return Comparison(baseline=baseline, changes=changes, verdict=verdict_on(rows, base), cautions=tuple(cautions))


def default_baseline(strategies: Sequence[str]) -> str:
    """Return the baseline where none is named: passive, or the first strategy where passive is not there.

    Raises:
        RidelabError: There are none.
    """
    if not strategies:
        raise RidelabError("There is no strategy to compare with")
    return "passive" if "passive" in strategies else strategies[0]
