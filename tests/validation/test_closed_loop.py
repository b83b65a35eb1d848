"""Whole runs against the same loop written a second time: absolute coordinates, step by step, a QP in each."""

from collections.abc import Callable
from typing import Any

import numpy as np
import pytest

from sim_core import Actuator, Bump, Lqr, Mpc, Preview, Road, Scenario, Speed, simulate
from sim_core.scenario.presets import preset
from sim_core.simulate import prepare
from tests.results import event
from tests.validation.reference.loop import drive
from tests.validation.reference.vehicle import OUTPUTS, behind
from tests.validation.strategies import some

Weighting = Callable[[float], tuple[float, float, float]]


def by_stage(scenario: Scenario) -> Weighting:
    """Table 6 over the front axle's position."""
    bump, table = scenario.road.bump, scenario.mpc.stage_weights
    detection = bump.start - scenario.speed.detection_distance
    end = bump.start + bump.width + behind(scenario)
    return lambda x: (
        table.bump if bump.start <= x < end else table.brake if detection <= x < bump.start else table.cruise
    )


def by_road(scenario: Scenario) -> Weighting:
    """Table 3 over the front axle's position."""
    bump, table = scenario.road.bump, scenario.mpc.road_weights
    end = bump.start + bump.width + behind(scenario)
    return lambda x: table.bump if bump.start <= x < end else table.rough


LAWS: dict[str, tuple[str, Callable[[Scenario], Weighting]]] = {
    "lv": ("mpc", by_stage),
    "suspension_only": ("mpc", by_road),
    "lqr": ("lqr", by_stage),
}
ROAD = Road(length=60, seed=7, bump=Bump(start=40))
TOGETHER = ROAD.model_copy(update={"rear_axle": "together"})
FREE = Mpc(force_limit=1e6, deflection_limit=1.0)  # no limit binds
TIGHT = Mpc(force_limit=1200, deflection_limit=0.05)
EARLY = Road(length=120, bump=Bump(start=60, width=2, shape="flat_top"))


def on_road(**parts: Any) -> Scenario:
    return Scenario(**({"road": ROAD} | parts))


def free(preview: Preview) -> Scenario:
    return on_road(mpc=FREE.model_copy(update={"preview": preview}))


# Those that say most come first.
CASES: dict[str, tuple[Scenario, str]] = {
    "free": (free("lookahead"), "lv"),
    "free, wheelbase": (free("wheelbase"), "suspension_only"),
    "regulator": (on_road(lqr=Lqr(weights=(1, 2, 3))), "lqr"),
    "regulator, axles together": (on_road(road=TOGETHER, lqr=Lqr(weights=(1, 2, 3))), "lqr"),
    "the paper's": (Scenario(mpc=Mpc(preview="lookahead")), "lv"),
    "axles together": (on_road(road=TOGETHER), "lv"),
    "tight limits": (on_road(mpc=TIGHT), "suspension_only"),
    "tight limits, LV": (on_road(mpc=TIGHT), "lv"),
    "tight limits, osqp": (on_road(mpc=TIGHT.model_copy(update={"solver": "osqp"})), "suspension_only"),
    "travel out of reach": (on_road(mpc=Mpc(force_limit=300, deflection_limit=0.03)), "suspension_only"),
    "clipped regulator": (on_road(mpc=Mpc(force_limit=800)), "lqr"),
    "short control horizon": (on_road(mpc=Mpc(control_horizon=3, prediction_horizon=25)), "lv"),
    "slow sampling": (on_road(mpc=Mpc(sample_time=0.02, prediction_horizon=15, control_horizon=10)), "lv"),
    "rate limit": (on_road(actuator=Actuator(rate_limit=40_000)), "suspension_only"),
    "lagging actuator": (on_road(actuator=Actuator(bandwidth=10)), "suspension_only"),
    "no travel weight": (on_road(mpc=Mpc(deflection_weight=0)), "lv"),
    "half-car masses": (preset("half_car_consistent"), "lv"),
    "pothole": (preset("pothole"), "suspension_only"),
    "early detection": (on_road(road=EARLY, speed=Speed(initial_speed_kmh=40)), "lv"),
    "free, no preview": (free("none"), "lv"),
    "free, lookahead by the road": (free("lookahead"), "suspension_only"),
    "the paper's, wheelbase": (Scenario(mpc=Mpc(preview="wheelbase")), "suspension_only"),
    "the paper's, no preview": (Scenario(mpc=Mpc(preview="none")), "lv"),
}


def difference(scenario: Scenario, strategy: str) -> tuple[float, int]:
    """Largest difference of any output or force, each relative to its own peak; and the steps at a limit."""
    law, weighting = LAWS[strategy]
    result = simulate(scenario, strategy)
    plan = prepare(scenario, strategy).speed_profile
    trace = drive(scenario, result, plan, weighting(scenario), law=law)
    recorded = trace.fine_time > -1e-9
    count = min(recorded.sum(), len(result.series["time"]))
    theirs = np.array([result.series[name] for name in (*OUTPUTS, "front_force", "rear_force")])[:, :count]
    fine = len(trace.fine_time) // len(trace.time)
    mine = np.vstack([trace.output.T, np.repeat(trace.command, fine, axis=0).T])[:, recorded][:, :count]
    rows = slice(None) if scenario.actuator.bandwidth is None else slice(len(OUTPUTS))  # commands are not on record
    gap = np.abs(mine - theirs).max(axis=1) / np.abs(theirs).max(axis=1)
    assert count > 0.95 * len(result.series["time"])
    return float(gap[rows].max()), int(event(result, "limited_steps"))


@pytest.mark.parametrize("name", some(10, list(CASES)))
def test_a_run_is_the_loop_written_a_second_time(name: str) -> None:
    """Both active sets are exact: 1e-6 of the peak is left, as without limits."""
    scenario, strategy = CASES[name]
    gap, limited = difference(scenario, strategy)
    assert gap < (1e-4 if scenario.mpc.solver == "osqp" else 1e-6)
    if any(word in name for word in ("limit", "reach", "clipped")):
        assert limited > 10
    assert limited == 0 or "free" not in name
