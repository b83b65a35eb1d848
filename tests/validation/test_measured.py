"""Measured roads against known properties: waves, lines, bumps, and the road that was measured."""

from collections.abc import Callable

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from sim_core import Bump, RidelabError, Road, Scenario, simulate
from sim_core.road.profile import road_profile
from sim_core.road.survey import bumps_in, surveyed
from sim_core.scenario.measured import SPACING, MeasuredRoad
from sim_core.strategies import STRATEGIES


def measured_on(road: Road, spacing: float = 0.05, length: float = 200) -> MeasuredRoad:
    """A generated road as a surveyor without errors measures it, on a slope of 1 %."""
    x = np.arange(0, length + spacing / 2, spacing)
    return MeasuredRoad.of(surveyed(x + 7, road_profile(road).height(x) + 0.3 + 0.01 * x).heights)


def test_a_line_is_taken_off_and_a_wave_keeps_its_share() -> None:
    """The mean of 11 heights scales a finely sampled wave by sin(11 πs/λ)/(11 sin(πs/λ)): 0.946 at 0.6 m."""
    x = np.arange(0, 60.001, 0.01)
    wave = surveyed(x, 5 - 0.02 * x + 0.03 * np.sin(2 * np.pi * x / 0.6))
    share = np.sin(11 * np.pi * 0.01 / 0.6) / (11 * np.sin(np.pi * 0.01 / 0.6))
    assert share == pytest.approx(0.946, abs=1e-3)
    assert (wave.offset, wave.slope) == pytest.approx((5, -0.02), abs=1e-3)
    inner = slice(100, -100)
    np.testing.assert_allclose(wave.heights[inner], 0.03 * share * np.sin(2 * np.pi * x / 0.6)[inner], atol=1e-3)


@settings(max_examples=30)
@given(st.lists(st.floats(-3, 3), min_size=1, max_size=100))
def test_heights_survive_packing_to_a_micrometre_and_equal_ones_have_one_id(values: list[float]) -> None:
    heights = np.array(values)
    road = MeasuredRoad.of(heights)
    np.testing.assert_allclose(road.heights(), heights, atol=0.5e-6 + 1e-12)
    again = MeasuredRoad.of(road.heights())
    assert (again.id, again.content, again) == (road.id, road.content, road)
    assert MeasuredRoad.of(heights + 1e-3).id != road.id
    assert len(road.id) == 22
    assert road.id[0].isalnum()


@pytest.mark.parametrize("strategy", ["lv", "lqr", "passive"])
def test_a_measured_road_drives_as_the_road_it_was_measured_on(strategy: str) -> None:
    """Every 5 cm, averaged over 10: travel, which waves of some decimetres do not move, within 2 %, ride within 8 %.

    Level before its first height, where the made road has its run-in: the windows are those of the bump.
    """
    original = Scenario(road=Road(roughness=16e-6, length=150))
    measured, flat = measured_on(original.road), Bump(height=0, start=100)
    on_it = Scenario(road=original.road.model_copy(update={"bump": flat, "profile": measured.id}), speed=original.speed)
    ours = simulate(on_it.on(measured), strategy).metrics["bump"]
    theirs = simulate(original, strategy).metrics["bump"]
    for signal, limit in (("front_deflection", 0.02), ("rear_deflection", 0.02), ("body_acceleration", 0.08)):
        assert ours[signal]["rms"] == pytest.approx(theirs[signal]["rms"], rel=limit), signal


def test_a_bump_is_added_to_a_measured_road() -> None:
    road = measured_on(Road(bump=Bump(height=0)))
    plain, bumpy = (
        road_profile(Scenario(road=Road(profile=road.id, bump=Bump(height=height))).on(road).road)
        for height in (0, 0.1)
    )
    x = np.linspace(0, 149, 5000)
    alone = road_profile(Road(roughness=0)).height(x)
    np.testing.assert_allclose(bumpy.height(x) - plain.height(x), alone, atol=1e-12)
    assert plain.height(np.array([-10.0]))[0] == pytest.approx(road.heights()[0])


@pytest.mark.parametrize(
    ("bump", "share"),
    [
        (Bump(), 0.12),
        (Bump(shape="circular", height=0.075, width=3.7, start=60), 0.15),
        (Bump(shape="trapezoid", height=-0.06, width=1, start=120), 0.15),
    ],
)
def test_a_bump_in_a_profile_is_detected(bump: Bump, share: float) -> None:
    """On a class B road, within half a metre and 15 % of its height, to 0.1 mm; on the road alone nothing is."""
    (found, *rest) = bumps_in(measured_on(Road(bump=bump)).heights())
    assert not rest
    assert found.start == pytest.approx(bump.start, abs=0.5)
    assert found.start + found.width == pytest.approx(bump.end, abs=0.5)
    assert found.height == pytest.approx(bump.height, rel=share)
    assert found.height == round(found.height, 4)
    assert not bumps_in(measured_on(Road(bump=Bump(height=0))).heights())


@pytest.mark.parametrize(("deviations", "found"), [(5.8, 0), (6.2, 1)])
def test_a_bump_stands_out_six_times_further_than_the_rest(deviations: float, found: int) -> None:
    """A sine of amplitude A has the median magnitude A/√2, times 1.4826 its deviation were it normal."""
    x = SPACING * np.arange(20_001)
    amplitude = 0.02  # six deviations of it are well above the least bump
    heights = amplitude * np.sin(2 * np.pi * x / 6.7)  # three waves in the running median, which is zero
    heights[9_985:10_015] = deviations * 1.4826 * amplitude / np.sqrt(2)
    assert len(bumps_in(heights)) == found


FIRST, SECOND = (measured_on(Road(bump=Bump(height=0), seed=seed), length=120) for seed in (1, 2))
ON_FIRST = Scenario(road=Road(profile=FIRST.id)).on(FIRST)
RENAMED = ON_FIRST.model_copy(update={"road": ON_FIRST.road.model_copy(update={"profile": SECOND.id})})


@pytest.mark.parametrize(
    ("drive", "field"),
    [
        (lambda: simulate(Scenario(road=Road(profile=FIRST.id)), "passive"), "road.profile"),  # without its heights
        (lambda: simulate(RENAMED, "passive"), "road.profile"),
        (lambda: Scenario(road=Road(profile=FIRST.id)).on(SECOND), "road.profile"),
        (lambda: Scenario().on(SECOND), "road.profile"),
        (lambda: simulate(Scenario(road=Road(profile=FIRST.id, length=130)).on(FIRST), "passive"), "road.length"),
        (lambda: Scenario(road=Road(profile=FIRST.id, bump=Bump(start=117))).on(FIRST), "road.bump.start"),
    ],
)
def test_a_scenario_and_its_road_have_to_fit(drive: Callable[[], object], field: str) -> None:
    with pytest.raises(RidelabError) as refused:
        drive()
    assert refused.value.field == field


@pytest.mark.parametrize("strategy", STRATEGIES)
@pytest.mark.parametrize("start", [58.0, 100.0])
def test_a_bump_of_height_0_has_no_place_beyond_the_roads_end(strategy: str, start: float) -> None:
    """On 60 m none brakes, the bump's metrics are missing, and the rough road is the whole one."""
    scenario = Scenario(road=Road(length=60, bump=Bump(height=0, start=start)))
    result = simulate(scenario, strategy)
    assert [span.stage for span in result.stages] == ["cruise"]
    assert result.travel_time == pytest.approx(60 / scenario.speed.initial)
    assert [result.events[name] for name in ("bump_complete", "target_reached")] == [None, None]
    values = [each for signal in result.metrics["bump"].values() for each in signal.values()]
    assert np.isnan([*values, result.arrival_speed_kmh]).all()
    assert result.metrics["rough_road"] == result.metrics["whole"]
