"""Whole runs against the same loop written a second time: absolute coordinates, step by step, a QP in each."""

from collections.abc import Callable

import numpy as np
import pytest

from sim_core import Actuator, Bump, Lqr, Mpc, Preview, Road, Scenario, Speed, simulate
from sim_core.scenario.presets import preset
from sim_core.scenario.road import RearAxle
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
PREVIEWS: tuple[tuple[str, Preview], ...] = (
    ("lv", "lookahead"),
    ("suspension_only", "wheelbase"),
    ("lv", "none"),
    ("lv", "wheelbase"),
    ("suspension_only", "lookahead"),
    ("suspension_only", "none"),
)
FREE = Mpc(force_limit=1e6, deflection_limit=1.0)  # no limit binds


def difference(scenario: Scenario, strategy: str) -> tuple[float, int]:
    """Largest difference of any output or force, each relative to its own peak; and the steps at a limit."""
    law, weighting = LAWS[strategy]
    result = simulate(scenario, strategy)
    trace = drive(scenario, result, weighting(scenario), law=law)
    recorded = trace.fine_time > -1e-9
    count = min(recorded.sum(), len(result.series["time"]))
    theirs = np.array([result.series[name] for name in (*OUTPUTS, "front_force", "rear_force")])[:, :count]
    fine = len(trace.fine_time) // len(trace.time)
    mine = np.vstack([trace.output.T, np.repeat(trace.command, fine, axis=0).T])[:, recorded][:, :count]
    rows = slice(None) if scenario.actuator.bandwidth is None else slice(len(OUTPUTS))  # commands are not on record
    gap = np.abs(mine - theirs).max(axis=1) / np.abs(theirs).max(axis=1)
    assert count > 0.95 * len(result.series["time"])
    return float(gap[rows].max()), int(event(result, "limited_steps"))


@pytest.mark.parametrize(("strategy", "preview"), some(2, PREVIEWS))
def test_without_a_limit_the_runs_are_the_same(strategy: str, preview: Preview) -> None:
    """Linear all through: what is left is rounding, and the road plan's samples (1e-6)."""
    scenario = Scenario(road=ROAD, mpc=FREE.model_copy(update={"preview": preview}))
    gap, limited = difference(scenario, strategy)
    assert limited == 0
    assert gap < 1e-6


@pytest.mark.parametrize("rear_axle", ["in_turn", "together"])
def test_lqr_is_the_same(rear_axle: RearAxle) -> None:
    road = ROAD.model_copy(update={"rear_axle": rear_axle})
    assert difference(Scenario(road=road, lqr=Lqr(weights=(1, 2, 3))), "lqr")[0] < 1e-6


@pytest.mark.parametrize(("strategy", "preview"), some(1, PREVIEWS))
def test_the_papers_scenario_with_its_limits(strategy: str, preview: Preview) -> None:
    """DAQP's active set is exact and the interior-point reference polishes to 1e-10: 1e-6 of the peak is left."""
    scenario = Scenario(mpc=Mpc(preview=preview))
    gap, _ = difference(scenario, strategy)
    assert gap < 1e-6


TIGHT = Mpc(force_limit=1200, deflection_limit=0.05)
TOGETHER = ROAD.model_copy(update={"rear_axle": "together"})
CASES = {
    "axles together": (Scenario(road=TOGETHER), "lv"),
    "tight limits": (Scenario(road=ROAD, mpc=TIGHT), "suspension_only"),
    "tight limits, LV": (Scenario(road=ROAD, mpc=TIGHT), "lv"),
    "tight limits, osqp": (Scenario(road=ROAD, mpc=TIGHT.model_copy(update={"solver": "osqp"})), "suspension_only"),
    "travel out of reach": (Scenario(road=ROAD, mpc=Mpc(force_limit=300, deflection_limit=0.03)), "suspension_only"),
    "clipped regulator": (Scenario(road=ROAD, mpc=Mpc(force_limit=800)), "lqr"),
    "short control horizon": (Scenario(road=ROAD, mpc=Mpc(control_horizon=3, prediction_horizon=25)), "lv"),
    "slow sampling": (Scenario(road=ROAD, mpc=Mpc(sample_time=0.02, prediction_horizon=15, control_horizon=10)), "lv"),
    "rate limit": (Scenario(road=ROAD, actuator=Actuator(rate_limit=40_000)), "suspension_only"),
    "lagging actuator": (Scenario(road=ROAD, actuator=Actuator(bandwidth=10)), "suspension_only"),
    "no travel weight": (Scenario(road=ROAD, mpc=Mpc(deflection_weight=0)), "lv"),
    "half-car masses": (preset("half_car_consistent"), "lv"),
    "pothole": (preset("pothole"), "suspension_only"),
    "early detection": (
        Scenario(
            road=Road(length=120, bump=Bump(start=60, width=2, shape="flat_top")), speed=Speed(initial_speed_kmh=40)
        ),
        "lv",
    ),
}


@pytest.mark.parametrize("name", some(5, list(CASES)))
def test_limits_horizons_and_actuators(name: str) -> None:
    scenario, strategy = CASES[name]
    gap, limited = difference(scenario, strategy)
    assert gap < (1e-4 if scenario.mpc.solver == "osqp" else 1e-6)
    if "limits" in name or "reach" in name or "rate" in name or "clipped" in name:
        assert limited > 10


@pytest.mark.parametrize(
    ("horizon", "travel", "preview"), [(1, 3.0, "none"), (30, 0.5, "none"), (25, 3.0, "lookahead")]
)
def test_mpc_without_extras_is_lqr_at_any_horizon(horizon: int, travel: float, preview: Preview) -> None:
    """Nc = Np, no move weight, no limit, the same preview and weights: the terminal cost makes it LQR, to rounding."""
    q = (2.0, 1.0, 3.0)
    mpc = FREE.model_copy(
        update={
            "prediction_horizon": horizon,
            "control_horizon": horizon,
            "preview": preview,
            "force_change_weight": 0.0,
            "deflection_weight": travel,
            "road_weights": Mpc().road_weights.model_copy(update={"rough": q, "bump": q}),
            "stage_weights": Mpc().stage_weights.model_copy(update={"cruise": q, "brake": q, "bump": q}),
        }
    )
    # A target above the initial speed: without preview no braking to foresee.
    speed = Speed(target_speed_kmh=60) if preview == "none" else Speed()
    lqr = Lqr(weights=q, deflection_weight=travel, preview=preview, preview_horizon=horizon)
    scenario = Scenario(road=ROAD, speed=speed, mpc=mpc, lqr=lqr)
    mpc_run, lqr_run = (simulate(scenario, name).series for name in ("lv", "lqr"))
    for name in (*OUTPUTS, "front_force", "rear_force"):
        assert np.abs(mpc_run[name] - lqr_run[name]).max() <= 1e-7 * np.abs(lqr_run[name]).max(), name
