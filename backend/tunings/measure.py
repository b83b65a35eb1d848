"""Runs become trials: the metrics of each run, then of a set of weights over its roads."""

from collections.abc import Mapping, Sequence
from dataclasses import dataclass, replace
from typing import Self

import numpy as np
import orjson

from backend.job_run import JobRow
from backend.json_types import JsonObject, Summary
from backend.store.trials import StoredTrial
from backend.tunings.objectives import Limit, Objective
from backend.tunings.space import Weights
from sim_core.catalogue import METRICS, PAPER_METRICS, Metric

Measured = Mapping[str, float]  # of one run: a value for each objective and each key of `Aims.metrics`


@dataclass(frozen=True, slots=True, kw_only=True)
class Failure:
    """A run without metrics, and why."""

    reason: str


RunsByRoad = dict[int, Measured | Failure]  # the runs of a set of weights by road seed


@dataclass(frozen=True, slots=True, kw_only=True)
class Aims:
    """What a tuning is after."""

    objectives: Sequence[Objective]
    limits: Sequence[Limit]
    quantile: float | None = None  # of an objective over the roads; None for its mean

    @classmethod
    def of(cls, request: JsonObject) -> Self:
        """Parse from a stored request."""
        return cls(
            objectives=[Objective.model_validate(each) for each in request["objectives"]],
            limits=[Limit.model_validate(each) for each in request["limits"]],
            quantile=request.get("quantile"),
        )

    @property
    def needs_passive(self) -> bool:
        """Check whether the passive car has to be run too."""
        return any(objective.normalised for objective in self.objectives)

    @property
    def most(self) -> list[float]:
        """Return what each limited metric may be at most."""
        return [limit.at_most for limit in self.limits]

    @property
    def metrics(self) -> dict[str, Metric]:
        """Return the limited metrics and the paper's eight, by the keys of a comparison."""
        limited = {f"limits.{index}": METRICS[limit.figure] for index, limit in enumerate(self.limits)}
        return limited | {key: METRICS[key] for key in PAPER_METRICS}

    def over(self, values: Sequence[float]) -> float:
        """Return the objective over the roads: the mean of its values or their quantile (numpy's "linear" method)."""
        return mean(values) if self.quantile is None else float(np.quantile(values, self.quantile))

    def measured(self, row: JobRow, passive: Summary) -> Measured | Failure:
        """Return one run's values.

        Args:
            row: The run.
            passive: The passive car's summary on that road; not read where `needs_passive` is false.

        Raises:
            UndefinedObjectiveError: An objective has no value on that road.
        """
        summary = orjson.loads(row.summary) if row.summary is not None else {}
        if row.status != "ok":
            return Failure(reason=str(row.reason or summary.get("reason") or row.status))
        objectives = {
            f"objectives.{index}": objective.value(summary, passive) for index, objective in enumerate(self.objectives)
        }
        return objectives | {key: float(metric.of(summary)) for key, metric in self.metrics.items()}

    def trial(self, number: int, generation: int, weights: Weights, roads: RunsByRoad) -> StoredTrial:
        """Make the trial of some weights from its runs: objectives over the roads, the largest of each limited metric.

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
            values=[self.over([run[f"objectives.{index}"] for run in runs]) for index in range(len(self.objectives))],
            limits=limits,
        )


def mean(values: Sequence[float]) -> float:
    """Return their mean."""
    return sum(values) / len(values)
