"""The speed plan: brake chain, arrival, target, coasting, and the same plan written a second time."""

from typing import Any

import numpy as np
import pytest
from hypothesis import assume, given, settings

from sim_core import Brake, Bump, Road, Scenario, Speed, Vehicle, simulate
from sim_core.loop.excitation import excite
from sim_core.speed.profile import make_speed_profile
from sim_core.speed.stages import segments, spans
from tests.validation.reference.driving import brake_to_bump
from tests.validation.strategies import between, vehicles

SMOOTH = Road(roughness=0, length=130)


def plan(**speed: Any) -> Scenario:
    return Scenario(road=SMOOTH, speed=Speed(**speed))


def test_chain_gives_back_the_torque_asked_for() -> None:
    """Eq. 6 turned round by Eq. 4-5: pressure → pad force → friction → deceleration; full torque is the greatest.

    Of pads whose friction depends on the speed: with the threshold of 0.1 m/s the tanh is 1 wherever the car brakes.
    """
    slipping = Scenario(road=SMOOTH, brake=Brake(threshold_speed=5.0))
    drive = make_speed_profile(slipping, "planned")
    pad = drive.pressure * 0.0025
    friction = 0.38 * pad * np.tanh(2 * (drive.speed * 0.13 / 0.3) / 5)
    mass = 1270 + 2 * 66.3
    np.testing.assert_allclose(drive.braking, 2 * (2 * friction * 0.13) / (0.3 * mass), rtol=1e-12)
    late = make_speed_profile(plan(controller="guarded", detection_distance=20.0), "planned")  # brakes as it can
    assert late.pressure.max() == pytest.approx(4 * 0.3 * mass / 2 / (2 * 0.38 * 0.13 * 0.0025), rel=1e-3)


@pytest.mark.parametrize(
    "speed",
    [
        {},
        {"initial_speed_kmh": 40.0, "target_speed_kmh": 15.0},
        {"initial_speed_kmh": 65.0, "target_speed_kmh": 30.0, "detection_distance": 70.0},
        {"initial_speed_kmh": 30.0, "detection_distance": 40.0},
    ],
)
def test_fuzzy_plan_is_the_one_written_a_second_time(speed: dict[str, float]) -> None:
    """Over position, 0.1 km/h: period starts differ by a step at the band's edge, surface grid 0.3 % of the torque."""
    scenario = plan(controller="fuzzy", **speed)
    mine, series = brake_to_bump(scenario), simulate(scenario, "speed_only").series
    window = (series["position"] >= mine.position[0]) & (series["position"] <= mine.position[-1])
    expected = np.interp(series["position"][window], mine.position, mine.speed)
    assert np.abs(series["speed"][window] - expected).max() * 3.6 < 0.1
    pressure = np.interp(series["position"][window], mine.position, mine.pressure)
    assert np.abs(series["brake_pressure"][window] - pressure).max() < 0.01 * mine.pressure.max()


def test_a_stage_begins_with_the_same_step_on_either_side_of_rounding() -> None:
    """At 50 km/h step 720 meets 100 m, also with an ulp or a thousand of them more; with a micrometre more 721 does."""

    def bump_begins(start: float) -> int:
        scenario = Scenario(road=Road(bump=Bump(start=start)))
        speed_profile = make_speed_profile(scenario, "constant")
        excitation = excite(scenario.road, scenario.rear_axle_offset, speed_profile, 0.01, 10)
        stages = segments(spans(scenario, "constant", speed_profile), excitation.grid.position)
        return {stage: first for stage, first, _ in reversed(stages)}["bump"] - excitation.grid.run_in_steps

    ulp = np.spacing(100.0)
    starts = [100.0, *(100 + distance * ulp for distance in (-1000, -1, 1, 1000)), 100 - 1e-6]
    assert {bump_begins(start) for start in starts} == {720}
    assert bump_begins(100 + 1e-6) == 721


def test_a_car_that_does_not_brake_coasts_from_the_sample_that_meets_the_bump() -> None:
    """576 steps of 1/7.2 m from the detection, each rounded, end 1.5e-12 m before the 80 m."""
    planned = make_speed_profile(plan(target_speed_kmh=50.0), "planned")
    assert planned.position[576] == pytest.approx(100, abs=1e-11)
    np.testing.assert_allclose(planned.speed[:577], 50 / 3.6, rtol=1e-12)
    assert planned.speed[577] < 50 / 3.6 - 1e-3


def test_paper_arrives_coasts_and_holds() -> None:
    """Figure 8: 20 to 25 km/h at 100 m, no braking on the bump, then constant."""
    result = simulate(Scenario(), "lv")
    series = result.series
    assert 20 <= result.arrival_speed_kmh <= 25
    assert result.events["target_reached"] is True
    before, bump, after = (
        series["position"] < 20,
        (series["position"] > 100.5) & (series["position"] < 104 + 2.91),
        series["position"] > 104 + 2.92,
    )
    np.testing.assert_allclose(series["speed"][before], 50 / 3.6, rtol=1e-12)
    assert series["brake_deceleration"][bump].max() < 0.01
    assert np.all(np.diff(series["speed"][bump]) <= 1e-12)
    assert np.ptp(series["speed"][after]) < 1e-9
    assert series["brake_deceleration"][after].max() < 1e-12


@pytest.mark.parametrize("initial", range(30, 81, 5))
@pytest.mark.parametrize("detection", [20.0, 35.0, 50.0, 80.0])
@pytest.mark.parametrize("target", [15.0, 22.5])
def test_target_is_reached_wherever_the_brakes_allow_it(initial: int, detection: float, target: float) -> None:
    """To the band's top within the distance left after the pressure has built up, at no more than 4 m/s²."""
    v, top, lag = initial / 3.6, (target + 2.5) / 3.6, Brake().pressure_lag
    needed = (v**2 - top**2) / (2 * (detection - v * lag))
    result = simulate(
        plan(initial_speed_kmh=float(initial), detection_distance=detection, target_speed_kmh=target), "speed_only"
    )
    if needed <= 3.9:
        assert result.events["target_reached"] is True, (needed, result.arrival_speed_kmh)
    elif needed > 4.5:
        assert result.events["target_reached"] is False
        assert result.arrival_speed_kmh > target + 2.5


def test_target_reached_is_arrival_within_the_papers_band() -> None:
    """20 to 25 km/h about 22.5, for arrivals a little faster as well as for those in the band."""
    arrivals = []
    for distance in np.arange(17, 22, 0.25):
        result = simulate(plan(detection_distance=float(distance)), "speed_only")
        assert result.events["target_reached"] is (20 <= result.arrival_speed_kmh <= 25), result.arrival_speed_kmh
        arrivals.append(result.arrival_speed_kmh)
    assert any(25.2 < arrival < 27 for arrival in arrivals)
    assert min(arrivals) < 25


@pytest.mark.parametrize("target", [50.0, 60.0])
def test_target_at_or_above_the_initial_speed_brakes_nothing(target: float) -> None:
    result = simulate(plan(target_speed_kmh=target), "lv")
    assert result.series["brake_deceleration"].max() == 0
    assert result.arrival_speed_kmh == pytest.approx(50, abs=1e-9)
    assert result.events["target_reached"] is True


@pytest.mark.parametrize(
    ("strategy", "policy"), [("passive", "by_strategy"), ("suspension_only", "by_strategy"), ("lv", "constant")]
)
def test_without_speed_control_the_speed_is_held(strategy: str, policy: Any) -> None:
    """There is no target then, so none to miss; at constant speed LV is its suspension alone."""
    result = simulate(Scenario(speed=Speed(policy=policy)), strategy)
    assert np.ptp(result.series["speed"]) == 0
    assert result.travel_time == pytest.approx(150 / (50 / 3.6))
    assert result.arrival_speed_kmh == pytest.approx(50)
    assert result.events["target_reached"] is None
    assert [span.stage for span in result.stages] == ["cruise", "bump", "cruise"]


def test_detection_before_the_start_brakes_from_the_start() -> None:
    near = Scenario(road=Road(length=80, bump=Bump(start=50)))
    result = simulate(near, "lv")
    assert result.series["brake_deceleration"][200] > 0
    assert [span.stage for span in result.stages] == ["brake", "bump", "cruise"]


@settings(max_examples=40)
@given(
    vehicles,
    between(6, 150),
    between(5, 60),
    between(1, 120),
    between(0, 2),
    between(0.2, 10),
)
def test_the_car_always_drives_on(
    car: Vehicle, initial: float, target: float, detection: float, lag: float, deceleration: float
) -> None:
    """However the brakes are set, it never stops or rolls back, and position is the integral of speed."""
    assume(lag < 1.5 or target > 10)
    scenario = Scenario(
        vehicle=car,
        road=SMOOTH,
        speed=Speed(initial_speed_kmh=initial, target_speed_kmh=target, detection_distance=detection),
        brake=Brake(pressure_lag=lag, maximum_deceleration=deceleration),
    )
    result = simulate(scenario, "speed_only")
    time, position, speed = (result.series[key] for key in ("time", "position", "speed"))
    assert speed.min() > 0
    assert np.all(np.diff(position) > 0)
    assert time[0] == 0
    assert position[0] == pytest.approx(0, abs=1e-9)
    travelled = np.concatenate([[0], np.cumsum(np.diff(time) * (speed[1:] + speed[:-1]) / 2)])
    np.testing.assert_allclose(position, travelled, atol=0.01)
    assert position[-1] <= 130 + 1e-6
    assert result.travel_time == pytest.approx(time[-1] + (130 - position[-1]) / speed[-1], abs=1e-6)
