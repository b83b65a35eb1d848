"""For any scenario: finite numbers, limits met or reported, and no silent solver failure."""

import numpy as np
from hypothesis import given, settings
from hypothesis import strategies as st

from sim_core.scenario import Bump, Mpc, Road, Scenario, Vehicle
from sim_core.simulate import simulate
from sim_core.strategies import STRATEGIES
from tests.results import event
from tests.validation.strategies import bumps, examples, scenarios, vehicles


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
