"""Damper curves: what one may be, and what it comes to around rest."""

from typing import Any

import pytest

from sim_core.frequency.stability import least_damping
from sim_core.scenario import Scenario, characteristics
from sim_core.scenario.damper import hardest

CURVE = [[-1, -1500], [-0.1, -400], [0.1, 600], [1, 2500]]


def scenario(curve: Any, **vehicle: Any) -> Scenario:
    return Scenario.model_validate({"vehicle": {"front_damper_curve": curve, **vehicle}})


def test_the_data_sheet_goes_by_the_slopes_around_rest() -> None:
    """The mean of 4000 N s/m in compression and 6000 in rebound, whatever the coefficient that controllers know."""
    front = characteristics(scenario(CURVE, front_damping=1000).vehicle).damping_ratios
    linear = characteristics(Scenario.model_validate({"vehicle": {"front_damping": 5000}}).vehicle).damping_ratios
    assert (front.front_body, front.rear_wheel) == pytest.approx((linear.front_body, linear.rear_wheel))


def test_the_origin_may_be_one_of_the_points() -> None:
    with_it = scenario([*CURVE[:2], [0, 0], *CURVE[2:]])
    assert characteristics(with_it.vehicle) == characteristics(scenario(CURVE).vehicle)


def test_a_curve_may_be_hardest_far_from_rest() -> None:
    assert hardest(((-1.0, -1500.0), (1.0, 600.0), (1.1, 1600.0))) == pytest.approx(10_000)


def test_a_loop_is_judged_by_the_slopes_around_rest() -> None:
    """As that of a car with this ratio and mean there; beyond 0.1 m/s it is another damper."""
    ratio = Scenario.model_validate({"vehicle": {"front_damping": 5000, "rear_damping": 5000, "rebound_ratio": 1.5}})
    curve = scenario(CURVE, rear_damper_curve=CURVE, front_damping=5000, rear_damping=5000)
    assert least_damping(curve, "lqr") == pytest.approx(least_damping(ratio, "lqr"), rel=1e-6)
    assert least_damping(curve, "passive") == pytest.approx(least_damping(ratio, "passive"), rel=1e-9)


def test_without_a_curve_nothing_is_known_by_it() -> None:
    assert "front_damper_curve" not in Scenario().vehicle.identity()
    assert scenario(CURVE).vehicle.identity()["front_damper_curve"] == CURVE
