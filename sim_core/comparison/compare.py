"""Comparison of several strategies' results."""

from collections import Counter
from collections.abc import Iterable, Iterator, Mapping, Sequence
from dataclasses import dataclass, field, replace
from typing import Any

from sim_core.comparison.caution import Caution
from sim_core.comparison.change import Change
from sim_core.comparison.html import comparison_html
from sim_core.comparison.requirements import Requirement, RequirementResult, baseline_of, judge
from sim_core.comparison.rows import LOWER_IS_BETTER, Row, changes_between, changes_by_key, labels_of, row_of
from sim_core.comparison.vehicle_cautions import scenario_cautions
from sim_core.comparison.verdict import Verdict, begin_sentence, verdict_on
from sim_core.errors import RidelabError
from sim_core.result import StrategyResult
from sim_core.scenario import Scenario
from sim_core.strategies import label_of

MOST_FIELDS = 3  # that one sentence names
_TUNED = "fuzzy", "mpc", "lqr", "hook", "own"  # what belongs to a strategy: to compare two of them is no fault


@dataclass(frozen=True, slots=True, kw_only=True)
class Comparison:
    """Comparison of several strategies' results.

    Attributes:
        baseline: The strategy that changes refer to, by its key in the results.
        changes: Strategy -> metric, by its flat name -> its change against the baseline. Without the baseline itself,
            and without metrics that either of both does not have.
        verdict: Which strategy is best, in words and metric by metric.
        cautions: Warnings about values outside a car's usual range, and about results of different roads or scenarios.
        changes_against: Strategy -> metric -> its change against the same strategy's in another run, such as the state
            before an edit; of strategies and metrics that both runs have. Empty where there is no other run.
        requirements: The result of each strategy under each requirement.

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
    changes_against: Mapping[str, Mapping[str, Change]] = field(default_factory=dict)
    requirements: tuple[RequirementResult, ...] = ()

    def _repr_html_(self) -> str:
        """Return the comparison as a notebook shows it: the verdict, changes of the paper's metrics, and cautions."""
        tables = {f"Change against {label_of(self.baseline)}": self.changes}
        tables["Change against the other run"] = self.changes_against
        return comparison_html(self.verdict.text, tables, self.requirements, [each.text for each in self.cautions])


Results = Mapping[str, StrategyResult | Sequence[StrategyResult]]


def compare(
    results: Results,
    baseline: str | None = None,
    requirements: Sequence[Requirement] = (),
    against: Results | None = None,
) -> Comparison:
    """Return the change of every metric against a baseline, whether it is more than random variation, and who is best.

    A change on one road is beyond random variation where it is at least as large as what one road resolves: 15 % for a
    peak where predictive control is one of both, else 7 % (docs/explanation/luck.md), and any change where nothing is
    random. Over several roads it is beyond where its 95 % interval, paired by road, does not contain zero.

    What is said of one strategy depends on it and the baseline alone, so that another strategy, or another order of
    them, changes no number.

    Args:
        results: Strategy -> its result, or one for each road: the same roads, in the same order, for every strategy.
            Several results of one strategy have keys of your choice, such as `soft` and `hard`; a recorded drive and
            what one road resolves go by the strategy of the result, whatever its key. Other roads than the baseline's
            are cautioned (`other_road`), other vehicles, speeds or sensors too (`other_scenario`).
        baseline: The strategy that changes refer to; None is passive, or the first one where passive is not there.
        requirements: Limits that the strategies have to satisfy.
        against: The same of another run. Where both are of one road, it may be another one; over several roads, seeds
            have to be the same, and changes are paired by road.

    Raises:
        RidelabError: There are no results, the baseline is not one of them, they are not of as many roads, or those
            of `against` are not of the same ones.

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
    by_road = _by_road(results)
    rows = _rows_of(by_road)
    cautions = [
        caution for each in by_road.values() for result in each for caution in scenario_cautions(result.scenario)
    ]
    reference = baseline_of(list(results), baseline)
    comparison = _compare(rows, reference, [*cautions, *_differences(rows, by_road, reference)])
    summaries = {name: [result.summary() for result in each] for name, each in by_road.items()}
    return replace(
        comparison,
        requirements=judge(requirements, summaries, baseline),
        changes_against=_changes_against(by_road, rows, _by_road(against)) if against else {},
    )


def _by_road(results: Results) -> Mapping[str, Sequence[StrategyResult]]:
    """Return each strategy's results on every road.

    Raises:
        RidelabError: They are not of as many roads.
    """
    by_road = {name: [each] if isinstance(each, StrategyResult) else list(each) for name, each in results.items()}
    counts = {len(each) for each in by_road.values()}
    if len(counts) != 1 or 0 in counts:
        listed = ", ".join(f"{len(each)} of {name}" for name, each in by_road.items())
        raise RidelabError(f"Every strategy needs a result on each of the same roads; there are {listed}")
    return by_road


def _changes_against(
    by_road: Mapping[str, Sequence[StrategyResult]],
    rows: Sequence[Row],
    others: Mapping[str, Sequence[StrategyResult]],
) -> dict[str, dict[str, Change]]:
    """Return the changes against the same strategies of another run.

    Raises:
        RidelabError: Not both are of one road, and they are not of the same roads.
    """
    for name in by_road.keys() & others.keys():
        seeds, wanted = ([result.scenario.road.seed for result in each[name]] for each in (others, by_road))
        if seeds != wanted and not len(seeds) == len(wanted) == 1:
            raise RidelabError(
                f"Changes are of the same roads: those of {name} have the seeds {wanted}, against {seeds}"
            )
    return changes_by_key(rows, _rows_of(others))


def _rows_of(by_road: Mapping[str, Sequence[StrategyResult]]) -> list[Row]:
    """Return the rows of results; where several are of one strategy, each is called by its key."""
    times = Counter(each[0].strategy for each in by_road.values())
    labels = labels_of(times)
    return [
        row_of(
            each[0].strategy,
            [result.summary() for result in each],
            is_random=any(result.scenario.is_random for result in each),
            key=key,
            label=key if times[each[0].strategy] > 1 else each[0].label or labels[each[0].strategy],
        )
        for key, each in by_road.items()
    ]


def _differences(
    rows: Sequence[Row], by_road: Mapping[str, Sequence[StrategyResult]], baseline: str
) -> Iterator[Caution]:
    """Return the warnings of results of another road or scenario than the baseline's."""
    reference = next(row.label for row in rows if row.key == baseline)
    for row in rows:
        pairs = zip(by_road[row.key], by_road[baseline], strict=True)
        cautions = (_differences_of(one.scenario, other.scenario, row, reference) for one, other in pairs)
        yield from next((each for each in cautions if each), ())


def _differences_of(scenario: Scenario, reference: Scenario, row: Row, baseline: str) -> list[Caution]:
    """Return the warnings of a result whose scenario is not that of the baseline's result, which has that label.

    A controller's own parameters may differ.
    """
    fields = list(_different(scenario.model_dump(), reference.model_dump()))
    roads = [field for field in fields if field.startswith("road.")]
    others = [field for field in fields if field.partition(".")[0] not in ("road", *_TUNED)]
    cautions = []
    for kind, where, differing, hint in (
        ("other_road", "on another road", roads, "comes from the road"),
        ("other_scenario", "in another scenario", others, "may come from that"),
    ):
        if differing:
            more = len(differing) - MOST_FIELDS
            named = ", ".join(differing[:MOST_FIELDS]) + (f" and {more} more" if more > 0 else "")
            driven = f"{begin_sentence(row.label)} was driven {where} than {baseline} ({named})"
            text = f"{driven}: part of a difference {hint}."
            cautions.append(Caution(kind=kind, text=text, field=differing[0], strategy=row.key))
    return cautions


def _different(one: Mapping[str, Any], other: Mapping[str, Any], part: str = "") -> Iterator[str]:
    """Return the dotted names of the fields in which two scenarios differ."""
    for name in dict.fromkeys([*one, *other]):
        value, reference = one.get(name), other.get(name)
        if isinstance(value, Mapping) and isinstance(reference, Mapping):
            yield from _different(value, reference, f"{part}{name}.")
        elif value != reference:
            yield f"{part}{name}"


Summaries = Mapping[str, Sequence[Mapping[str, Any]]]


def compare_summaries(
    summaries: Summaries,
    baseline: str,
    scenario: Scenario,
    metrics: Iterable[str] = LOWER_IS_BETTER,
    against: tuple[Summaries, Scenario] | None = None,
) -> Comparison:
    """Return the comparison of results of one scenario of which only the summaries are there.

    Args:
        summaries: Strategy -> `StrategyResult.summary()` on each road, of as many roads each; there may be none.
        baseline: The strategy that changes refer to; one that failed has no summaries, and then there are no changes.
        scenario: What was driven, on the first road.
        metrics: Flat names of those that are compared.
        against: The summaries of another run, over the same roads where there are several, and its scenario.
    """
    keys = tuple(metrics)
    rows = _rows_of_summaries(summaries, scenario, keys)
    comparison = _compare(rows, baseline, scenario_cautions(scenario))
    changes = {} if against is None else changes_by_key(rows, _rows_of_summaries(*against, keys))
    return replace(comparison, changes_against=changes)


def _rows_of_summaries(summaries: Summaries, scenario: Scenario, metrics: Sequence[str]) -> list[Row]:
    labels = labels_of(summaries)
    return [
        row_of(name, each, is_random=scenario.is_random, metrics=metrics, label=labels[name])
        for name, each in summaries.items()
    ]


def _compare(rows: Sequence[Row], baseline: str, cautions: Iterable[Caution]) -> Comparison:
    base = next((row for row in rows if row.key == baseline), None)
    changes = {} if base is None else {row.key: changes_between(row, base) for row in rows if row is not base}
    unique = tuple(dict.fromkeys(cautions))
    return Comparison(baseline=baseline, changes=changes, verdict=verdict_on(rows, base), cautions=unique)
