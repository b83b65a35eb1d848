"""Requirements: limits that metrics have to satisfy, and whether strategies do."""

from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from math import inf
from typing import Any, Literal

from sim_core.catalogue import METRICS
from sim_core.comparison.intervals import Interval, change_with_interval, mean_with_interval
from sim_core.comparison.numbers import NO_VALUE, exact, significant, with_unit
from sim_core.errors import RidelabError
from sim_core.strategies import label_of

LIMITS = ("max", "min", "max_change")
_NOT_RUN = "It did not run"

Result = Literal["pass", "fail", "uncertain"]
# A strategy's summaries on each road, or why it has none.
Driven = Sequence[Mapping[str, Any]] | str


@dataclass(frozen=True, slots=True, kw_only=True)
class Requirement:
    """A limit that one metric has to satisfy: exactly one of `max`, `min` and `max_change`; the limit itself does.

    Attributes:
        metric: By its flat name, such as `bump.body_acceleration.peak`.
        max: At most this, in the metric's SI unit.
        min: At least this, in the metric's SI unit.
        max_change: At most this change against the baseline [%]; -20 is at least a fifth less.
        strategies: Which have to satisfy it, by their keys in the results; None is all but the baseline.

    Raises:
        RidelabError: There is no such metric, or not exactly one limit.

    Example:
        >>> from sim_core import Requirement, Scenario, compare, simulate
        >>> results = {name: simulate(Scenario(), name) for name in ("lv", "passive")}
        >>> limit = Requirement(metric="bump.body_acceleration.peak", max_change=-50)
        >>> [(each.strategy, each.result) for each in compare(results, requirements=[limit]).requirements]
        [('lv', 'pass')]
    """

    metric: str
    max: float | None = None
    min: float | None = None
    max_change: float | None = None
    strategies: Sequence[str] | None = None

    def __post_init__(self) -> None:
        if self.metric not in METRICS:
            raise RidelabError(f"There is no metric {self.metric}")
        if sum(getattr(self, name) is not None for name in LIMITS) != 1:
            raise RidelabError(f"The requirement of {self.metric} needs exactly one of {', '.join(LIMITS)}")

    @property
    def limit(self) -> float:
        """Return its one limit."""
        limits: list[float] = [value for name in LIMITS if (value := getattr(self, name)) is not None]
        return limits[0]

    def strategies_judged(self, names: Sequence[str], baseline: str | None) -> Sequence[str]:
        """Return which of the strategies have to satisfy it; where only the baseline runs, it is held to max and min.

        Args:
            names: All strategies that run.
            baseline: The one that was asked for; None is passive, or for changes the first where passive is not there.
        """
        if self.strategies is not None:
            return self.strategies
        against = baseline_of(names, baseline) if self.max_change is not None else baseline or "passive"
        others = [name for name in names if name != against]
        return others or (list(names) if self.max_change is None else [])

    def excess(self, value: float) -> float:
        """Return by how much a value is beyond the limit, in the limit's unit; at most 0 where it satisfies it."""
        return self.limit - value if self.min is not None else value - self.limit


@dataclass(frozen=True, slots=True, kw_only=True)
class RequirementResult:
    """The result of one strategy under one requirement.

    Attributes:
        metric: By its flat name.
        strategy: The strategy, by its key in the results.
        baseline: What a change is against; None of other limits.
        max: The requirement's limit, one of these three [SI unit].
        min: Likewise.
        max_change: Likewise [%].
        result: `uncertain` where the 95 % interval over several roads contains the limit.
        value: What is compared with the limit: the metric [SI unit], over several roads its mean, or its change [%];
            None where there is none.
        low: Lower end of its interval over several roads; None on one road.
        high: Upper end, likewise.
        reason: Why there is no value, and so it fails; None where there is one.

    Example:
        >>> from sim_core import Requirement, Scenario, compare, simulate
        >>> limit = Requirement(metric="travel_time", max=1)
        >>> (result,) = compare({"lqr": simulate(Scenario(), "lqr")}, requirements=[limit]).requirements
        >>> result.result, round(result.value)
        ('fail', 20)
    """

    metric: str
    strategy: str
    baseline: str | None
    max: float | None
    min: float | None
    max_change: float | None
    result: Result
    value: float | None = None
    low: float | None = None
    high: float | None = None
    reason: str | None = None

    @property
    def limit_text(self) -> str:
        """Return the limit in words: `at most 3 m/s²`, `changes by at most −20 % against Passive`."""
        words = {"at most": self.max, "at least": self.min, "changes by at most": self.max_change}
        word, limit = next((word, value) for word, value in words.items() if value is not None)
        against = "" if self.baseline is None else f" against {label_of(self.baseline)}"
        return f"{word} {with_unit(exact(limit), self._unit)}{against}"

    @property
    def value_text(self) -> str:
        """Return the value with its unit, and over several roads its interval: `2.50 m/s² (2.31 to 2.69)`."""
        text = NO_VALUE if self.value is None else with_unit(significant(self.value), self._unit)
        if self.low is None or self.high is None:
            return text
        return f"{text} ({significant(self.low)} to {significant(self.high)})"

    @property
    def _unit(self) -> str:
        return METRICS[self.metric].unit if self.max_change is None else "%"


def judge(
    requirements: Sequence[Requirement], driven: Mapping[str, Driven], baseline: str | None
) -> tuple[RequirementResult, ...]:
    """Return the result of each strategy under each requirement.

    Args:
        requirements: The limits.
        driven: By strategy its summaries on each road, the same roads for all, or why it has none.
        baseline: As it was asked for; None is passive, or the first strategy where passive is not there.
    """
    names = list(driven)
    return tuple(
        judge_strategy(requirement, name, driven, baseline_of(names, baseline))
        for requirement in requirements
        for name in requirement.strategies_judged(names, baseline)
    )


def judge_strategy(
    requirement: Requirement, strategy: str, driven: Mapping[str, Driven], baseline: str
) -> RequirementResult:
    """Return the result of one strategy under a requirement, whose changes are against the strategy `baseline`."""
    own = driven.get(strategy, _NOT_RUN)
    estimate = _estimate(requirement, own, driven.get(baseline, _NOT_RUN))
    head: dict[str, Any] = {"metric": requirement.metric, "strategy": strategy}
    head |= {name: getattr(requirement, name) for name in LIMITS}
    head["baseline"] = None if requirement.max_change is None else baseline
    if isinstance(estimate, str):
        return RequirementResult(**head, result="fail", reason=estimate)
    low, high = _ends(estimate)
    worst, best = (low, high) if requirement.min is not None else (high, low)
    result: Result = "pass" if requirement.excess(worst) <= 0 else "uncertain"
    if requirement.excess(best) > 0:
        result = "fail"
    if len(own) > 1:
        head |= {"low": low, "high": high}
    return RequirementResult(**head, result=result, value=estimate.value)


def share_used(requirement: Requirement, own: Driven, base: Driven) -> float:
    """Return how much of a limit is used: 1 where the worse end of the interval meets it; infinite without a value.

    Of a positive `max` it is the metric over its limit, of a positive `min` the limit over the metric, and so on
    where both are negative; beyond a limit 1 and the excess, over the limit's magnitude or 1.
    """
    estimate = _estimate(requirement, own, base)
    if isinstance(estimate, str):
        return inf
    low, high = _ends(estimate)
    limit, value = requirement.limit, low if requirement.min is not None else high
    beyond = requirement.excess(value) / (abs(limit) or 1)
    # A metric may be above a positive least value by any amount, and below a negative greatest one.
    is_passed = beyond < 0 and (limit > 0 if requirement.min is not None else limit < 0)
    return limit / value if is_passed else max(0.0, 1 + beyond)


def baseline_of(names: Sequence[str], baseline: str | None = None) -> str:
    """Return what changes refer to: the strategy asked for, else passive, or the first where passive is not there.

    Raises:
        RidelabError: There are no strategies.
    """
    if baseline is None and not names:
        raise RidelabError("There is no strategy to compare with")
    return baseline or ("passive" if "passive" in names else names[0])


def _ends(estimate: Interval) -> tuple[float, float]:
    """Return the interval; of one road the value itself."""
    low, high = estimate.low, estimate.high
    return (low, high) if low <= high else (estimate.value, estimate.value)


def _estimate(requirement: Requirement, own: Driven, base: Driven) -> Interval | str:
    """Return what is compared with the limit, or why there is nothing."""
    values = _values(requirement.metric, own)
    if isinstance(values, str) or requirement.max_change is None:
        return values if isinstance(values, str) else mean_with_interval(values)
    against = _values(requirement.metric, base)
    if isinstance(against, str):
        return f"The baseline: {against}"
    if sum(against) == 0:
        none = Interval(value=0, low=0, high=0)
        return none if not any(values) else "The baseline's is 0, so there is no change in %"
    return change_with_interval(values, against)


def _values(metric: str, driven: Driven) -> list[float] | str:
    """Return a metric on each road, or why there is none."""
    if isinstance(driven, str):
        return driven
    values = [METRICS[metric].of(summary) for summary in driven]
    return "It has no such metric" if None in values else [float(value) for value in values]
