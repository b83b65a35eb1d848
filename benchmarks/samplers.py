"""Which of Optuna's samplers finds good weights with few trials: LV control, roads in memory, no service.

`python -m benchmarks.samplers` prints the table of docs/decisions/0009; it takes some minutes and is no part of `make
bench`. Each row is the mean of some searches: how much smaller than the paper's weights' the value got (one objective),
or the share of the box below the paper's that the front dominates (two), after half of the trials and after all; and
the time of one core that asking took, a generation.
"""

import os
import time
from collections.abc import Callable, Sequence
from concurrent.futures import Executor, ProcessPoolExecutor
from typing import Any

import optuna

from backend.jobs.tuning import front, space
from backend.jobs.tuning.objectives import StoredObjective
from backend.store.trials import StoredTrial
from sim_core.scenario import Scenario, dotted
from sim_core.simulate import simulate

STRATEGY = "lv"
TRIALS, GENERATION = 192, 16
SEARCHES = range(1, 5)
BASE = Scenario().model_dump(mode="json")
PAPER = StoredObjective(kind="paper", q=[1, 1, 1], window="whole", figure=None)
PEAKS = StoredObjective(kind="peaks", q=[1, 1, 1], window="bump", figure=None)
COMFORT = StoredObjective(kind="figure", q=[1, 1, 1], window=None, figure="whole.body_acceleration.rms")
AIMS: dict[str, list[StoredObjective]] = {"Eq. 16": [PAPER], "comfort and peaks": [COMFORT, PEAKS]}
SAMPLERS: dict[str, Callable[[int], optuna.samplers.BaseSampler]] = {
    "random": lambda seed: optuna.samplers.RandomSampler(seed=seed),
    "NSGA-II": lambda seed: optuna.samplers.NSGAIISampler(seed=seed, population_size=GENERATION),
    "TPE, weights apart": lambda seed: optuna.samplers.TPESampler(seed=seed, multivariate=False),
    "TPE, weights together": lambda seed: optuna.samplers.TPESampler(seed=seed, multivariate=True),
}


def run(weights: space.Weights, strategy: str) -> dict[str, Any]:
    """A run's summary."""
    return simulate(Scenario.model_validate(dotted.with_changes(BASE, weights)), strategy).summary()


def values(pool: Executor, sets: Sequence[space.Weights], aims: Sequence[StoredObjective]) -> list[list[float]]:
    """Each set of weights' objectives."""
    passive = run({}, "passive")
    runs = pool.map(run, sets, [STRATEGY] * len(sets), chunksize=4)
    return [[aim.value(each, passive) for aim in aims] for each in runs]


def search(pool: Executor, sampler: optuna.samplers.BaseSampler, aims: Sequence[StoredObjective]) -> list[float]:
    """Share after half of the trials and after all, and the time asking took a generation [s]."""
    ranges = space.default_search(STRATEGY)
    own = space.paper_weights(STRATEGY, ranges)
    distributions: dict[str, optuna.distributions.BaseDistribution] = {
        name: optuna.distributions.FloatDistribution(*ends, log=True) for name, ends in ranges.items()
    }
    study = optuna.create_study(directions=["minimize"] * len(aims), sampler=sampler)
    tried_values = values(pool, [own], aims)
    point = space.point_of(own, ranges, BASE)
    study.add_trial(optuna.trial.create_trial(values=tried_values[0], params=point, distributions=distributions))
    shares, asking = [], 0.0
    for _ in range(TRIALS // GENERATION):
        begin = time.thread_time()
        asked = [study.ask(distributions) for _ in range(GENERATION)]
        asking += time.thread_time() - begin
        sets = [space.weights_of(trial.params, ranges, own) for trial in asked]
        for trial, trial_values in zip(asked, values(pool, sets, aims), strict=True):
            study.tell(trial, trial_values)
            tried_values.append(trial_values)
        trials = [_trial(number, each) for number, each in enumerate(tried_values)]
        shares.append(front.dominated_share(front.front(trials), tried_values[0]))
    return [float(shares[len(shares) // 2 - 1] or 0), float(shares[-1] or 0), asking / len(shares)]


def _trial(number: int, objective_values: list[float]) -> StoredTrial:
    return StoredTrial(
        number=number,
        generation=0,
        weights={},
        status="ok",
        reason=None,
        feasible=True,
        values=objective_values,
        limits=[],
    )


def main() -> None:
    """Print the table."""
    optuna.logging.set_verbosity(optuna.logging.ERROR)
    print(f"{'':40}{'half':>8}{'all':>8}{'asking':>12}   each search, all")
    with ProcessPoolExecutor(os.cpu_count()) as pool:
        for aim, aims in AIMS.items():
            for name, make in SAMPLERS.items():
                results = [search(pool, make(seed), aims) for seed in SEARCHES]
                half, whole, asking = (sum(column) / len(results) for column in zip(*results, strict=True))
                each = " ".join(f"{100 * one[1]:.1f}" for one in results)
                print(
                    f"{f'{aim}, {name}':40}{100 * half:7.1f}%{100 * whole:7.1f}%{asking:10.3f} s   {each}", flush=True
                )


if __name__ == "__main__":
    main()
