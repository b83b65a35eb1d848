"""Requirements: limits that metrics have to keep, and how the strategies of a result keep them."""

from collections.abc import Iterable, Mapping, Sequence
from dataclasses import dataclass, field
from typing import Any, Literal, Self

Requirement = Mapping[str, Any]  # its JSON
FailingRun = Mapping[str, Any]  # of a batch: `run`, `value`, and the swept values `at`
PASS, FAIL, UNCERTAIN = "pass", "fail", "uncertain"


@dataclass(frozen=True, slots=True, kw_only=True)
class RequirementResult:
    """Result of one strategy under one requirement, whose limit is one of `max`, `min` and `max_change`.

    Attributes:
        metric: By its flat name.
        strategy: Its id.
        result: `uncertain` where the interval over roads holds the limit.
        max: At most so much, in the metric's unit.
        min: At least so much.
        max_change: At most this change against the baseline [%].
        baseline: What a change is against; None of others.
        value: What is held to the limit; over several roads the mean; None where there is none.
        low: Of its 95 % interval over roads; None on one road.
        high: Likewise.
        reason: Why there is no value, and so it fails; of a batch why its first run without a value has none.
        counts: Of a batch how many of its runs `pass`, `fail`, are `not_computed` and are `unfinished`; empty of a run.
        first_failure: Of a batch the first of its runs that fails: `run`, `value`, and the swept values `at`.
        worst_failure: Of a batch the one furthest beyond the limit, likewise.
    """

    metric: str
    strategy: str
    result: Literal["pass", "fail", "uncertain"]
    max: float | None = None
    min: float | None = None
    max_change: float | None = None
    baseline: str | None = None
    value: float | None = None
    low: float | None = None
    high: float | None = None
    reason: str | None = None
    counts: Mapping[str, int] = field(default_factory=dict)
    first_failure: FailingRun | None = None
    worst_failure: FailingRun | None = None

    @property
    def total(self) -> int:
        """The number of a batch's runs that are held to the limit; 0 of a run."""
        return sum(self.counts.values())

    @property
    def not_computed(self) -> int:
        """The number of these that have no value; older services count them among those that fail."""
        return self.counts.get("not_computed", 0)

    @classmethod
    def of(cls, answer: Mapping[str, Any]) -> Self:
        """The result in an answer; fields of a newer service are ignored."""
        return cls(**{key: value for key, value in answer.items() if key in cls.__dataclass_fields__})

    def limit(self, unit: str) -> str:
        """The limit in words, the metric's unit being `unit`."""
        if self.max_change is not None:
            return f"at most {self.max_change:+g} % against {self.baseline}"
        word, limit = ("at most", self.max) if self.max is not None else ("at least", self.min)
        return f"{word} {limit:g}{'' if unit == '1' else f' {unit}'}"


def required(requirements: Sequence[Requirement], baseline: str | None) -> dict[str, Any]:
    """Nothing where nothing is required: a service of an older version does not know the word."""
    return {"requirements": list(requirements), "baseline": baseline} if requirements else {}


def failing(results: Iterable[RequirementResult], *, strict: bool = False) -> bool:
    """Check whether one fails; with `strict`, whether one does not pass."""
    return any(each.result == FAIL or (strict and each.result != PASS) for each in results)
