"""For any scenario: finite numbers, limits met or reported, and no silent solver failure."""

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from sim_core.scenario import Actuator, Bump, Lqr, Mpc, Road, Scenario, Speed, Vehicle
from sim_core.scenario.parts import RoadWeights, StageWeights
from sim_core.simulate import simulate
from sim_core.strategies import STRATEGIES
from tests.results import event
from tests.validation.strategies import between, bumps, examples, scenarios, some, vehicles

ACTIVE = ["lv", "suspension_only", "lqr"]


@settings(max_examples=examples(60))
@given(scenarios, st.sampled_from(list(STRATEGIES)))
def test_any_run_is_finite_and_keeps_or_reports_its_limits(scenario: Scenario, strategy: str) -> None:
    result = simulate(scenario, strategy)
    series, mpc = result.series, scenario.mpc
    for name, values in series.items():
        assert np.isfinite(values).all(), name
    forces = max(np.abs(series["front_force"]).max(), np.abs(series["rear_force"]).max())
    assert forces <= mpc.force_limit
    assert event(result, "qp_failures") == 0 or strategy == "lv_hil"  # whose iterations are bounded
    assert event(result, "qp_fallbacks") <= event(result, "qp_solves") <= event(result, "limited_steps")
    largest = max(np.abs(series["front_deflection"]).max(), np.abs(series["rear_deflection"]).max())
    # Metrics may find a little more than the histories have: their windows end between samples.
    exceeded, beyond = event(result, "travel_exceeded_mm") / 1000, max(0.0, largest - mpc.deflection_limit)
    assert beyond <= exceeded + 1e-12 <= beyond + 0.01 * largest
    for window in result.metrics.values():
        for statistics in window.values():
            # To rounding: a force that stays at its limit has an RMS as large as its peak.
            assert 0 <= statistics["rms"] <= statistics["peak"] * (1 + 1e-12)


@settings(max_examples=examples(20))
@given(vehicles, bumps)
def test_known_road_and_enough_force_hold_the_travel_or_say_so(car: Vehicle, bump: Bump) -> None:
    """At the control instants the MPC with lookahead keeps 80 mm wherever the force allows; else it reports slack."""
    road = Road(length=115, roughness=16e-6, bump=bump)
    result = simulate(Scenario(vehicle=car, road=road, mpc=Mpc(force_limit=30_000)), "lv")
    stride = round(0.01 / result.series["time"][1])
    # Within a hundredth: the prediction takes the road as linear over 10 ms, and a trapezoid's kinks lie within.
    for axle in ("front", "rear"):
        at_instants = np.abs(result.series[f"{axle}_deflection"][::stride]).max()
        assert at_instants <= 0.08 * 1.01 or event(result, "max_slack_mm") > 0.05


@settings(max_examples=examples(9))
@given(scenarios)
def test_height_zero_is_no_bump_at_all(scenario: Scenario) -> None:
    """The numbers do not depend on the bump's shape or width."""

    def without(**bump: object) -> Scenario:
        flat = scenario.road.bump.model_copy(update={"height": 0.0, **bump})
        return scenario.model_copy(update={"road": scenario.road.model_copy(update={"bump": flat})})

    for strategy in ("passive", "lv"):
        one, two = simulate(without(shape="cosine"), strategy), simulate(without(shape="trapezoid"), strategy)
        assert all(np.array_equal(one.series[name], two.series[name]) for name in one.series)
    narrow, wide = (simulate(without(width=width), "passive").series for width in (1.0, 9.0))
    for name, values in narrow.items():  # rounding: the stages end elsewhere, so other blocks are summed
        np.testing.assert_allclose(wide[name], values, atol=1e-10 * np.abs(values).max(), err_msg=name)


@settings(max_examples=examples(25))
@given(scenarios)
def test_every_strategy_drives_the_same_road_and_the_rear_follows_the_front(scenario: Scenario) -> None:
    """Heights over position agree to what lies between two samples; a rear axle's are the front's, L later or at once.

    Two drives sample the road at different places, so heights are compared where the road is smooth: the bump alone.
    """
    smooth = scenario.model_copy(update={"road": scenario.road.model_copy(update={"roughness": 0.0})})
    runs = {name: simulate(smooth, name).series for name in ("passive", "speed_only", "lqr")}
    x = np.linspace(0, 114, 2000)
    passive = np.interp(x, runs["passive"]["position"], runs["passive"]["front_road"])
    bump = scenario.road.bump
    slope = 4 * np.pi * abs(bump.height) / bump.width
    spacing = max(np.diff(series["position"]).max() for series in runs.values())
    for series in runs.values():
        assert np.abs(np.interp(x, series["position"], series["front_road"]) - passive).max() <= slope * spacing + 1e-12
        behind = series["position"] - smooth.rear_axle_offset
        on = behind >= 0
        front = np.interp(behind[on], series["position"], series["front_road"])
        assert np.abs(series["rear_road"][on] - front).max() <= slope * spacing + 1e-12


SHORT = Road(length=70, bump=Bump(start=50))
EXTREME = {
    "slow": Scenario(
        road=Road(length=6, bump=Bump(start=2, width=1)), speed=Speed(initial_speed_kmh=5, target_speed_kmh=5)
    ),
    "fast": Scenario(speed=Speed(initial_speed_kmh=200, target_speed_kmh=100)),
    "stiff": Scenario(road=SHORT, vehicle=Vehicle(front_tyre_stiffness=2e7, front_wheel_mass=5, front_damping=5e5)),
    "soft": Scenario(
        road=SHORT,
        vehicle=Vehicle(body_mass=50_000, front_spring=1000, rear_spring=1000, front_damping=10, rear_damping=10),
    ),
    "wall": Scenario(road=Road(bump=Bump(height=1, width=0.05, shape="trapezoid"))),
    "half pipe": Scenario(road=Road(bump=Bump(height=0.5, width=1, shape="circular"))),
    "hair": Scenario(road=Road(bump=Bump(height=1e-160, shape="circular"))),
    "hair cosine": Scenario(road=Road(bump=Bump(height=1e-160))),
    "stairs": Scenario(road=Road(bump=Bump(height=0.3, width=0.05, shape="kerb", start=60, count=20, spacing=0.3))),
    "hole": Scenario(road=Road(bump=Bump(height=-1, width=0.05, shape="half_sine"))),
    "class H": Scenario(road=Road(roughness=0.262144)),
    "at once": Scenario(road=Road(length=5, bump=Bump(start=1, width=4))),
    "bump at the end": Scenario(road=Road(length=104)),
    "horizon 1": Scenario(road=SHORT, mpc=Mpc(prediction_horizon=1, control_horizon=1)),
    "one move": Scenario(road=SHORT, mpc=Mpc(prediction_horizon=60, control_horizon=1)),
    "long control": Scenario(road=SHORT, mpc=Mpc(prediction_horizon=100, control_horizon=100)),
    "no force": Scenario(road=SHORT, mpc=Mpc(force_limit=1)),
    "no travel": Scenario(road=SHORT, mpc=Mpc(deflection_limit=0.005)),
    "one weight": Scenario(
        road=SHORT,
        mpc=Mpc(
            deflection_weight=0,
            stage_weights=StageWeights(cruise=(0, 0, 1), brake=(0, 1, 0), bump=(1, 0, 0)),
            road_weights=RoadWeights(rough=(0, 1, 0), bump=(0, 0, 1)),
        ),
        lqr=Lqr(weights=(1, 0, 0), deflection_weight=0),
    ),
    "huge weight": Scenario(road=SHORT, mpc=Mpc(deflection_weight=1000, force_weight=1e-3, force_change_weight=1e-3)),
    "tiny force weight": Scenario(road=SHORT, mpc=Mpc(force_weight=1e-12, force_change_weight=0)),
    "coarse": Scenario(road=SHORT, mpc=Mpc(sample_time=0.05)),
    "fine": Scenario(road=SHORT, mpc=Mpc(sample_time=0.002)),
    "sluggish": Scenario(road=SHORT, actuator=Actuator(bandwidth=0.5, rate_limit=1000)),
    "quick": Scenario(road=SHORT, actuator=Actuator(bandwidth=1000, rate_limit=1e8)),
    "long wheelbase": Scenario(road=SHORT, vehicle=Vehicle(cg_to_front=10, cg_to_rear=10)),
}


@pytest.mark.parametrize("name", EXTREME)
def test_the_edges_of_what_may_be_typed(name: str) -> None:
    """Finite numbers, limits met, every QP solved."""
    scenario = EXTREME[name]
    # The others are these with less.
    for strategy in some(2, ("lv", "lqr", "lv_hil", "suspension_only", "hybrid")):
        result = simulate(scenario, strategy)
        for signal, values in result.series.items():
            assert np.isfinite(values).all(), (strategy, signal)
        assert result.events["qp_failures"] == 0 or strategy == "lv_hil", strategy  # its iterations are bounded
        forces = max(np.abs(result.series["front_force"]).max(), np.abs(result.series["rear_force"]).max())
        lag = 1e-12 if scenario.actuator.bandwidth else 0.0  # a lagging force is integrated, and rounded
        assert forces <= scenario.mpc.force_limit * (1 + lag), strategy
        # Windows are never empty: the bump is always on the road, and before it there is at least a metre.
        assert all(
            np.isfinite(value) for window in result.metrics.values() for s in window.values() for value in s.values()
        )


@settings(max_examples=examples(15))
@given(vehicles, st.tuples(between(0, 10), between(0, 10), between(0.1, 10)), between(0, 10), st.sampled_from(ACTIVE))
def test_any_weights_make_a_loop_that_settles(
    car: Vehicle, weights: tuple[float, float, float], travel: float, strategy: str
) -> None:
    """On a smooth road the tyre loads after the bump are no larger than while crossing it: nothing rings up."""
    stages = StageWeights(cruise=weights, brake=weights, bump=weights)
    roads = RoadWeights(rough=weights, bump=weights)
    scenario = Scenario(
        vehicle=car,
        road=Road(roughness=0, length=130, bump=Bump(start=50)),
        mpc=Mpc(deflection_weight=travel, stage_weights=stages, road_weights=roads),
        lqr=Lqr(weights=weights, deflection_weight=travel),
    )
    series = simulate(scenario, strategy).series
    crossing = (series["position"] >= 50) & (series["position"] < 54 + car.wheelbase)
    later = series["position"] > 105
    for name in ("front_tyre_load", "rear_tyre_load"):
        assert np.abs(series[name][later]).max() < np.abs(series[name][crossing]).max(), name
