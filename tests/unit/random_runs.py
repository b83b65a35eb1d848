"""Random runs over everything that may be typed, and what holds for any of them."""

import time
from collections import Counter
from dataclasses import dataclass, field
from typing import Any

import numpy as np
from annotated_types import Ge, Le
from pydantic.fields import FieldInfo

from backend.cost.affordable import simulate
from backend.cost.estimate import estimate
from benchmarks.cost import drawn, on_slider
from sim_core import RidelabError, StrategyResult
from sim_core.control.qp import MAX_EFFORT
from tests.results import metrics

CHEAP = 0.05  # estimated [s of one core]
# Processor time of one that was estimated to be cheap [s]; where a loop diverges OSQP takes all iterations of each QP.
CHEAP_BOUND = 20 * CHEAP
LONGEST = 90.0  # of any run that is not refused: a worker's task may take as long [s]


def to_its_limits(info: FieldInfo, rng: np.random.Generator) -> Any:
    """A value of a field: half the time on its slider, else between its hard limits or at one of them."""
    if info.annotation is bool:
        return bool(rng.random() < 0.5)
    least = [float(str(each.ge)) for each in info.metadata if isinstance(each, Ge)]
    most = [float(str(each.le)) for each in info.metadata if isinstance(each, Le)]
    if rng.random() < 0.5 or not least or not most:
        return on_slider(info, rng)
    low, high = least[0], most[0]
    if rng.random() < 0.1:
        end = low if rng.random() < 0.5 else high
        return int(end) if info.annotation is int else end
    if info.annotation is int:
        return int(rng.integers(int(low), int(high) + 1))
    # Limits lie decades apart: as many in each decade.
    return float(np.exp(rng.uniform(np.log(low), np.log(high)))) if low > 0 else float(rng.uniform(low, high))


def numbers(result: StrategyResult) -> dict[str, float]:
    """All that a result says in numbers; of each time history the sum of its sizes."""
    found = metrics(result) | {"travel_time": result.travel_time, "arrival_speed_kmh": result.arrival_speed_kmh}
    found |= {f"{key}.sum": float(np.abs(values).sum()) for key, values in result.series.items()}
    return found | {key: value for key, value in {**result.events, **result.reference}.items() if value is not None}


@dataclass
class Count:
    """What became of random runs.

    Attributes:
        ended: So many have a result.
        refused: So many do not, by reason.
        not_finite: Which have a number that is none.
        ratios: Cost over estimate of each that ended.
        over: Which cost more than their bound.
    """

    ended: int = 0
    refused: Counter[str] = field(default_factory=Counter)
    not_finite: list[str] = field(default_factory=list)
    ratios: list[float] = field(default_factory=list)
    over: list[str] = field(default_factory=list)


def attack(seed: int, count: int, *, dear: bool = False) -> Count:
    """Drive so many random scenarios whose estimate is below `CHEAP`, or not below; costs are this process's."""
    counted, number = Count(), -1
    while counted.ended + counted.refused.total() < count:
        number += 1
        scenario, strategy = drawn(seed, number, draw=to_its_limits)
        if ((expected := estimate(scenario, strategy)) >= CHEAP) != dear:
            continue
        before = time.process_time()
        try:
            result = simulate(scenario, strategy)
        except RidelabError as error:
            counted.refused[f"{type(error).__name__}: {error.message}"] += 1
            continue
        cost = time.process_time() - before
        counted.ended += 1
        counted.ratios.append(cost / expected)
        run = f"seed {seed}, number {number}, {strategy}, {scenario.mpc.solver}, {cost:.2f} s for {expected:.3f} s"
        if cost > (LONGEST if dear else MAX_EFFORT if scenario.mpc.solver == "osqp" else CHEAP_BOUND):
            counted.over.append(run)
        bad = [key for key, value in numbers(result).items() if not np.isfinite(value)]
        if bad:
            counted.not_finite.append(f"{run}: {', '.join(bad)}")
    return counted
