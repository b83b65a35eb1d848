"""Estimates of a run's cost against what runs cost, over random scenarios within the sliders.

tests/drill/test_cost.py prints the quantiles of real cost over estimate and holds them.
"""

import multiprocessing
import resource
from collections.abc import Callable, Iterable, Sequence
from dataclasses import dataclass
from typing import Any, cast, get_args

import numpy as np
from pydantic import BaseModel, ValidationError
from pydantic.fields import FieldInfo

from backend.compute.memory import keep_freed_memory
from backend.cost.affordable import simulate
from backend.cost.estimate import estimate
from benchmarks.timing import table
from sim_core.errors import TooExpensiveError
from sim_core.scenario import Scenario
from sim_core.strategies import STRATEGIES

JUDGED = 101  # seed of the draws
Draw = Callable[[FieldInfo, np.random.Generator], Any]  # a value of a field
QUANTILES = (0.0, 0.025, 0.25, 0.5, 0.75, 0.975, 1.0)
FACTOR = 3.0


@dataclass(frozen=True, slots=True, kw_only=True)
class Measured:
    """A run of a strategy: its cost, and what was estimated [s of one core]."""

    scenario: Scenario
    strategy: str
    cost: float
    estimated: float
    too_expensive: bool = False

    @property
    def kind(self) -> str:
        """Strategy, and its solver where it has one."""
        return f"{self.strategy}, {self.scenario.mpc.solver}" if self.strategy in _SOLVING else self.strategy


_SOLVING = ("lv", "suspension_only")


def drawn(
    seed: int, number: int, strategies: Sequence[str] = tuple(STRATEGIES), draw: Draw | None = None
) -> tuple[Scenario, str]:
    """A scenario and a strategy, the same for the same numbers.

    Each part is the paper's, or has every field anywhere on its slider, or what else `draw` gives of a field.
    """
    rng = np.random.default_rng((seed, number))
    draw = draw or on_slider
    while True:
        parts = {key: _value(info, rng, draw) for key, info in Scenario.model_fields.items() if rng.random() < 0.5}
        try:
            return Scenario.model_validate(parts), str(rng.choice(strategies))
        except ValidationError:  # fields that contradict each other
            continue


def _part(model: type[BaseModel], rng: np.random.Generator, draw: Draw) -> dict[str, Any]:
    return {key: _value(info, rng, draw) for key, info in model.model_fields.items()}


def _value(info: FieldInfo, rng: np.random.Generator, draw: Draw) -> Any:
    if isinstance(info.annotation, type) and issubclass(info.annotation, BaseModel):
        return _part(info.annotation, rng, draw)
    return draw(info, rng)


def on_slider(info: FieldInfo, rng: np.random.Generator) -> Any:
    """A choice, or a number within the slider's range; the default of a field that has neither."""
    choices = get_args(info.annotation)
    if choices and all(isinstance(choice, str) for choice in choices):
        return str(rng.choice(choices))
    if not isinstance(info.json_schema_extra, dict) or "soft_range" not in info.json_schema_extra:
        return info.default  # no slider: a measured road, a damper's curve
    low, high = cast(list[float], info.json_schema_extra["soft_range"])
    if "item_titles" in info.json_schema_extra:
        return tuple(rng.uniform(low, high, 3).tolist())
    if type(None) in choices and rng.random() < 0.5:
        return None
    return int(rng.integers(int(low), int(high) + 1)) if info.annotation is int else float(rng.uniform(low, high))


def measured(case: tuple[Scenario, str]) -> Measured:
    """Drive it; processor time of this process and of the ECU's program."""
    scenario, strategy = case
    estimated = estimate(scenario, strategy)
    before, too_expensive = _processor_time(), False
    try:
        simulate(scenario, strategy)
    except TooExpensiveError:
        too_expensive = True
    cost = _processor_time() - before
    return Measured(scenario=scenario, strategy=strategy, cost=cost, estimated=estimated, too_expensive=too_expensive)


def _processor_time() -> float:
    usages = [resource.getrusage(who) for who in (resource.RUSAGE_SELF, resource.RUSAGE_CHILDREN)]
    return sum(usage.ru_utime + usage.ru_stime for usage in usages)


def measure(cases: Iterable[tuple[Scenario, str]], processes: int = 2) -> list[Measured]:
    """Measure all cases, in new processes that have built the ECU's program and imported every module."""
    with multiprocessing.get_context("spawn").Pool(processes, initializer=warm_up) as pool:
        return list(pool.imap_unordered(measured, cases, chunksize=4))


def warm_up() -> None:
    """Build and import what the first run of each kind otherwise would."""
    keep_freed_memory()  # as a worker does
    for name in STRATEGIES:
        simulate(Scenario(), name)
    osqp = Scenario.model_validate({"mpc": {"solver": "osqp", "deflection_limit": 0.03}})
    simulate(osqp, "lv")


def within(runs: Sequence[Measured]) -> float:
    """Share of the runs whose cost is within the factor of its estimate."""
    return float(np.mean([1 / FACTOR <= run.cost / run.estimated <= FACTOR for run in runs]))


def report(runs: Sequence[Measured]) -> None:
    """Print the quantiles of real cost over estimate, by strategy and solver."""
    rows = []
    for kind in (*sorted({run.kind for run in runs}), "all"):
        selected = [run for run in runs if kind in (run.kind, "all")]
        ratios = np.quantile([run.cost / run.estimated for run in selected], QUANTILES)
        most = max(run.cost for run in selected)
        rows.append([kind, len(selected), f"{within(selected):.1%}", *map(float, ratios), most])
    head = ["", "runs", f"within {FACTOR:g}", *(f"{share:.1%}" for share in QUANTILES), "most, s"]
    table("Real cost over estimate: quantiles", head, rows)
    print(f"  too expensive: {sum(run.too_expensive for run in runs)} of {len(runs)}")
