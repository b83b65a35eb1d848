"""Random runs of a linear car that meets no limit, and the laws that their time histories then have to hold."""

from collections import Counter
from collections.abc import Iterator, Mapping
from dataclasses import dataclass, field
from itertools import islice
from math import ceil, floor
from typing import Any

import numpy as np

from backend.cost.estimate import estimate
from benchmarks.cost import drawn
from sim_core import FloatArray, RidelabError, Scenario, simulate
from sim_core.catalogue import METRIC_SIGNALS
from sim_core.frequency.stability import least_damping
from sim_core.road.profile import GRID
from sim_core.scenario.dotted import with_changes
from sim_core.scenario.parts import KMH
from sim_core.speed.profile import SPEED_CONTROL_PERIOD
from tests.unit.random_runs import CHEAP, to_its_limits

STRATEGIES = ("passive", "speed_only", "lqr", "lv", "suspension_only", "skyhook", "groundhook", "hybrid")
LAWS = {"mirror", "scaling", "superposition", "shift"}
TOLERANCE = 1e-8  # of a signal's peak: rounding, which a lightly damped loop makes grow; 1e-10 is seen
_LINEAR = {
    "vehicle.rebound_ratio": 1.0,
    "vehicle.bump_stop_clearance": None,
    "vehicle.tyre_lift_off": False,
    "mismatch.rebound_ratio": 1.0,
    "actuator.saturation": None,
    "actuator.rate_limit": None,
    "hook.semi_active": False,
    "mpc.force_limit": 1e6,
    "mpc.deflection_limit": 1.0,
}
# What depends on the road's roughness but not linearly on its heights.
_NO_STATISTICS = {"estimation.kind": "exact", "mpc.expected_offset": 0.0, "mpc.expected_noise": 0.0}
_NO_BUMP, _SMOOTH = 1e-12, 1e-30  # as good as none, but sampled as finely as with it


class LimitMetError(Exception):
    """A limit binds, so that the run is not linear."""


@dataclass
class Checked:
    """By law how many runs held it and the worst of them; those that did not; how many were not linear or refused."""

    held: Counter[str] = field(default_factory=Counter)
    worst: dict[str, tuple[float, str]] = field(default_factory=dict)
    broken: list[str] = field(default_factory=list)
    left_out: int = 0


def linear_runs(seed: int) -> Iterator[tuple[int, Scenario, str]]:
    """Number, scenario and strategy of cheap ones that come to rest: in others any rounding grows."""
    number = -1
    while True:
        number += 1
        scenario, strategy = drawn(seed, number, STRATEGIES, to_its_limits)
        scenario = changed(scenario, _LINEAR)
        try:
            damping = least_damping(scenario, strategy)
        except RidelabError:  # no controller, or no filter
            continue
        if damping and damping > 0 and estimate(scenario, strategy) < CHEAP:
            yield number, scenario, strategy


def changed(scenario: Scenario, changes: Mapping[str, Any]) -> Scenario:
    """The scenario with these fields."""
    return Scenario.model_validate(with_changes(scenario.model_dump(mode="json"), changes))


def check(seed: int, count: int) -> Checked:
    """Hold so many runs to every law."""
    checked = Checked()
    for number, scenario, strategy in islice(linear_runs(seed), count):
        try:
            found = differences(scenario, strategy)
        except (LimitMetError, RidelabError):
            checked.left_out += 1
            continue
        for law, size in found.items():
            checked.worst[law] = max(checked.worst.get(law, (0.0, "")), (size, f"number {number}, {strategy}"))
            checked.held[law] += size <= TOLERANCE
            checked.broken += [f"{law}, seed {seed}, number {number}, {strategy}: {size:g}"] * (size > TOLERANCE)
    return checked


def response(scenario: Scenario, strategy: str) -> FloatArray:
    """Every signal that a suspension changes (signals, samples)."""
    result = simulate(scenario, strategy)
    if result.events["limited_steps"]:
        raise LimitMetError
    return np.stack([result.series[signal] for signal in METRIC_SIGNALS])


def differences(scenario: Scenario, strategy: str) -> dict[str, float]:
    """By law, how far the histories are from holding it, relative to the signal's peak.

    Raises:
        LimitMetError: A limit binds in one of the runs.
    """
    height = scenario.road.bump.height

    def of(scenario: Scenario, part: float) -> FloatArray:
        return response(changed(scenario, {"road.bump.height": part * height}), strategy)

    none, whole = of(scenario, _NO_BUMP), of(scenario, 1)
    found = {"mirror": _apart(of(scenario, -1) - none, none - whole, whole)}
    if scenario.road.bump.shape != "circular":  # whose height decides its radius
        found["scaling"] = _apart(of(scenario, 0.5) - none, 0.5 * (whole - none), whole)
    rough = changed(scenario, _NO_STATISTICS)
    smooth = changed(rough, {"road.roughness": _SMOOTH})
    whole = of(rough, 1)
    bump = of(smooth, 1) - of(smooth, _NO_BUMP)
    found["superposition"] = _apart(whole - of(rough, _NO_BUMP), bump, whole)
    return found | {"shift": _shift(smooth, strategy)}


def _shift(scenario: Scenario, strategy: str) -> float:
    """The same, seen as far ahead, further along the road: by whole control steps and whole samples of the road."""
    step = SPEED_CONTROL_PERIOD
    slowest, fastest = (speed * KMH * step / GRID for speed in (5, 200))  # that the field takes
    speed = min(max(round(scenario.speed.initial * step / GRID), ceil(slowest)), floor(fastest)) * GRID / step
    road, detection = scenario.road, min(scenario.speed.detection_distance, scenario.road.bump.start)
    # The car starts before it sees the bump or its own braking: one that is under way has seen them already.
    unseen = max(scenario.mpc.prediction_horizon, scenario.lqr.preview_horizon) * step * speed
    here = {
        "road.bump.start": road.bump.start + unseen,
        "road.length": road.length + unseen,
        "road.roughness": 0.0,
        "mismatch.preview_noise": 0.0,
        "mpc.sample_time": step,
        "speed.initial_speed_kmh": speed / KMH,
        "speed.detection_distance": detection,
    }
    away = 100 * step * speed
    there = {"road.bump.start": road.bump.start + unseen + away, "road.length": road.length + unseen + away}
    one, other = response(changed(scenario, here), strategy), response(changed(scenario, here | there), strategy)
    later = other[:, other.shape[1] - one.shape[1] :]
    return _apart(later, one, one)


def _apart(one: FloatArray, other: FloatArray, whole: FloatArray) -> float:
    peaks = np.maximum(np.abs(whole).max(axis=1), 1e-12)
    return float((np.abs(one - other).max(axis=1) / peaks).max())
