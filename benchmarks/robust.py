"""Drives the preset `robust` at points that its search never saw: the tables of docs/explanation/robustness.md.

A point is one of the default robustness study's: a car, sensors, actuators and a road, none of which the controllers
know. The search was done once, at commit 899e0802 (`git show 899e0802:benchmarks/robust.py`).
"""

import argparse
import os
from collections.abc import Sequence
from concurrent.futures import Executor, ProcessPoolExecutor
from functools import partial
from typing import Any

import numpy as np
from scipy.stats import qmc

from backend.batches.robustness import UNCERTAINTIES
from backend.compute.memory import keep_freed_memory
from sim_core import FloatArray, simulate
from sim_core.catalogue import METRICS, PAPER_METRICS
from sim_core.scenario import Scenario, dotted
from sim_core.scenario.presets import preset

SHARE = 0.9  # of the points that a lead is printed for
FRESH_SEED = 2  # of the points
TRAVEL = "events.travel_exceeded_mm"
FIELDS = ("preview", "expected_offset", "expected_noise", "sample_time", "prediction_horizon", "deflection_weight")
CONTROLLER = (*(f"mpc.{name}" for name in FIELDS), "mpc.stage_weights")
PAPER = Scenario().model_dump(mode="json")

Changes = dict[str, Any]  # dotted name -> value


def opponents(controller: Changes) -> dict[str, Changes]:
    """The LQRs to be compared with, as changes of the paper's: as it is, with this preview, told of the obstacle."""
    same = {f"mpc.{name}": controller[f"mpc.{name}"] for name in ("expected_offset", "expected_noise", "sample_time")}
    same |= {"lqr.preview": controller["mpc.preview"], "lqr.preview_horizon": controller["mpc.prediction_horizon"]}
    return {"the paper's LQR": {}, "LQR with this preview": same, "LQR with obstacle": {"lqr.preview": "obstacle"}}


def points(count: int, seed: int) -> list[Changes]:
    """Points of the default robustness study, a Latin hypercube over its ranges."""
    rows = qmc.LatinHypercube(d=len(UNCERTAINTIES), rng=np.random.default_rng(seed)).random(count)
    low, high = (np.array([getattr(each, end) for each in UNCERTAINTIES]) for end in ("low", "high"))
    names = [each.field for each in UNCERTAINTIES]
    values = [dict(zip(names, map(float, low + row * (high - low)), strict=True)) for row in rows]
    return [each | {"road.seed": int(each["road.seed"])} for each in values]


def metrics(point: Changes, strategy: str, changes: Changes) -> list[float]:
    """The paper's eight metrics of one run, and its travel beyond the limit."""
    summary = simulate(Scenario.model_validate(dotted.with_changes(PAPER, point | changes)), strategy).summary()
    return [float(METRICS[key].of(summary)) for key in (*PAPER_METRICS, TRAVEL)]


def driven(pool: Executor, where: Sequence[Changes], strategy: str, changes: Changes) -> FloatArray:
    """Metrics at every point (points, 9)."""
    run = partial(metrics, strategy=strategy, changes=changes)
    return np.array(list(pool.map(run, where, chunksize=-(-len(where) // 8))))


def show(pool: Executor, controller: Changes, where: Sequence[Changes]) -> None:
    """Print how the controller stands against each opponent, at the first point, the nominal one, and at the others."""
    ours = driven(pool, where, "lv", controller)
    print(
        f"LV holds its travel at {np.mean(ours[1:, 8] <= 0):.0%} of the points, at most {ours[1:, 8].max():.0f} mm over"
    )
    for name, changes in opponents(controller).items():
        theirs = driven(pool, where, "lqr", changes)
        change = 100 * (ours[:, :8] / theirs[:, :8] - 1)
        print(f"\n{f'LV against {name}, {len(where) - 1} points':52} nominal   better   median     90 %")
        for key, column in zip(PAPER_METRICS, change.T, strict=True):
            at_points = (np.median(column[1:]), np.quantile(column[1:], SHARE))
            shown = "".join(f"{each:+7.1f} %" for each in at_points)
            print(f"{METRICS[key].label:51}{column[0]:+7.1f} %{np.mean(column[1:] < 0):9.1%}{shown}")
        print(
            f"{name} holds its travel at {np.mean(theirs[1:, 8] <= 0):.0%}, at most {theirs[1:, 8].max():.0f} mm over"
        )


def main() -> None:
    """Print the tables."""
    parser = argparse.ArgumentParser(description=(__doc__ or "").partition("\n")[0])
    parser.add_argument("--fresh", type=int, default=400, help="points of the tables")
    parser.add_argument(
        "--state", choices=["exact", "kalman"], default="exact", help="what the tables' controllers know"
    )
    options = parser.parse_args()
    with ProcessPoolExecutor(os.cpu_count(), initializer=keep_freed_memory) as pool:
        plain = preset("robust").model_dump(mode="json")
        controller = {name: dotted.value(plain, name) for name in CONTROLLER}
        state = {"estimation.kind": options.state}
        show(pool, controller, [state, *(each | state for each in points(options.fresh, FRESH_SEED))])


if __name__ == "__main__":
    main()
