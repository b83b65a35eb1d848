"""Runs become trials: the figures of each run, then of a set of weights over its roads."""

from collections.abc import Mapping, Sequence
from dataclasses import dataclass, replace
from typing import Any

import orjson

from backend.analysis.objectives import (
    Summary,
    needs_passive,
    objective_label,
    objective_unit,
    objective_value,
)
from backend.jobs.tuning.space import Weights
from backend.store.job_runs import JobRow
from backend.store.trials import StoredTrial
from sim_core.catalogue import METRICS, PAPER_METRICS

Measured = Mapping[str, float]  # of one run: a value for each key of `Aims.figures`


@dataclass(frozen=True, slots=True, kw_only=True)
class Failure:
    """A run without figures, and why."""

    reason: str


Roads = dict[int, Measured | Failure]  # the runs of a set of weights by road seed


@dataclass(frozen=True, slots=True, kw_only=True)
class Aims:
    """What a tuning is after; objectives and limits as they are stored."""

    objectives: Sequence[Mapping[str, Any]]
    limits: Sequence[Mapping[str, Any]]

    @property
    def needs_passive(self) -> bool:
        """Whether the passive car has to be run too."""
        return needs_passive(self.objectives)

    @property
    def most(self) -> list[float]:
        """What each limited figure may be at most."""
        return [float(limit["at_most"]) for limit in self.limits]

    @property
    def figures(self) -> list[dict[str, str]]:
        """`ComparedFigure`s: the objectives, the limits, the paper's eight."""
        found = [
            {"key": f"objectives.{index}", "label": objective_label(each), "unit": objective_unit(each)}
            for index, each in enumerate(self.objectives)
        ]
        named = [(f"limits.{index}", limit["figure"]) for index, limit in enumerate(self.limits)]
        named += [(key, key) for key in PAPER_METRICS]
        return found + [{"key": key, "label": METRICS[name].label, "unit": METRICS[name].unit} for key, name in named]

    def measured(self, row: JobRow, passive: Summary) -> Measured | Failure:
        """One run's values.

        Args:
            row: The run.
            passive: The passive car's summary on that road; not read where `needs_passive` is false.

        Raises:
            UndefinedObjectiveError: An objective cannot be told on that road.
        """
        summary = orjson.loads(row.summary) if row.summary is not None else {}
        if row.status != "ok":
            return Failure(reason=str(row.reason or summary.get("reason") or row.status))
        found = {
            f"objectives.{index}": objective_value(objective, summary, passive)
            for index, objective in enumerate(self.objectives)
        }
        named = [(f"limits.{index}", limit["figure"]) for index, limit in enumerate(self.limits)]
        return found | {
            key: float(METRICS[name].of(summary)) for key, name in [*named, *((key, key) for key in PAPER_METRICS)]
        }

    def trial(self, number: int, generation: int, weights: Weights, roads: Roads) -> StoredTrial:
        """A set of weights by its runs: means of the objectives, the largest of each limited figure.

        Args:
            number: Of the trial.
            generation: It belongs to.
            weights: That were tried.
            roads: By road seed.
        """
        failed = [f"Road {seed}: {run.reason}" for seed, run in roads.items() if isinstance(run, Failure)]
        runs = [run for run in roads.values() if not isinstance(run, Failure)]
        trial = StoredTrial(
            number=number, generation=generation, weights=weights, status="failed", reason=next(iter(failed), None)
        )
        if failed:
            return trial
        limits = [max(run[f"limits.{index}"] for run in runs) for index in range(len(self.limits))]
        return replace(
            trial,
            status="ok",
            feasible=all(value <= most for value, most in zip(limits, self.most, strict=True)),
            values=[mean([run[f"objectives.{index}"] for run in runs]) for index in range(len(self.objectives))],
            limits=limits,
        )


def mean(values: Sequence[float]) -> float:
    """Their mean."""
    return sum(values) / len(values)
