"""Proposes the next values, with Optuna. Slow to import: only where a tuning is driven, and in a thread.

A study is made anew from the stored trials for each generation, its sampler seeded by the tuning's seed and the
generation's number: the same trials lead to the same next ones, whoever asks and however often.
"""

import logging
from collections.abc import Mapping, Sequence
from functools import cache
from importlib import import_module
from types import ModuleType
from typing import Any

import numpy as np

from backend.json_types import JsonObject
from backend.store.trials import StoredTrial
from backend.tunings.space import Point, point_of, ranges_of
from sim_core.scenario import dotted


def ask(request: JsonObject, trials: Sequence[StoredTrial], *, generation: int, count: int) -> list[Point]:
    """Return so many points of a tuning's generation, by its stored request and the trials of earlier generations."""
    optuna, ranges = _optuna(), ranges_of(request)
    space = {name: _distribution(optuna.distributions, name, ends) for name, ends in ranges.items()}
    state = np.random.SeedSequence([request["seed"], generation]).generate_state(1)
    sampler = optuna.samplers.TPESampler(seed=int(state[0]))  # docs/decisions/0009-tuning-by-generations.md
    study = optuna.create_study(directions=["minimize"] * len(request["objectives"]), sampler=sampler)
    limits = [limit["at_most"] for limit in request["limits"]]
    for trial in trials:
        point = point_of(trial.weights, ranges, request["scenario"])
        if point is not None:
            study.add_trial(_frozen_trial(optuna, trial, point, space, limits))
    return [dict(study.ask(space).params) for _ in range(count)]


def _distribution(distributions: Any, name: str, ends: Sequence[Any]) -> object:
    """The range of a searched value: logarithmic where it can be, in whole numbers, or choices without an order."""
    if isinstance(ends[0], str):
        return distributions.CategoricalDistribution(ends)
    if dotted.field(name).kind == "integer":
        return distributions.IntDistribution(int(ends[0]), int(ends[1]))
    return distributions.FloatDistribution(*ends, log=ends[0] > 0)


def _frozen_trial(
    optuna: Any, trial: StoredTrial, point: Point, space: Mapping[str, object], limits: Sequence[float]
) -> Any:
    """A trial in Optuna's form; it is feasible where its constraints' values are at most 0."""
    placed = {"params": point, "distributions": space}
    if trial.values is None or trial.limits is None:
        return optuna.trial.create_trial(state=optuna.trial.TrialState.FAIL, **placed)
    over = {str(index): value - most for index, (value, most) in enumerate(zip(trial.limits, limits, strict=True))}
    return optuna.trial.create_trial(values=trial.values, constraints=over, **placed)


@cache
def _optuna() -> ModuleType:
    optuna = import_module("optuna")
    optuna.logging.disable_default_handler()
    optuna.logging.set_verbosity(logging.ERROR)
    return optuna
