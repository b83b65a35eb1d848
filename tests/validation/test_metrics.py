"""Every number a run reports, computed again by definition from samples 0.02 ms apart."""

import numpy as np
import pytest
from hypothesis import given, settings

from sim_core import STRATEGIES, Actuator, Bump, Mpc, Road, Scenario, Speed, Vehicle, simulate
from sim_core.catalogue import COMFORT, EVENTS, METRIC_SIGNALS, PAPER_SIGNALS, SIGNALS, WINDOWS
from sim_core.metrics.comfort import wk_gain
from sim_core.metrics.evaluate import rms_between, section_ends
from sim_core.scenario.presets import preset
from sim_core.speed.profile import make_speed_profile
from tests.validation.reference.held import errors
from tests.validation.reference.weighting import wk
from tests.validation.strategies import between, bumps, examples, rows_of_bumps, some, vehicles

CASES = {
    "paper": (Scenario(), ("lv",)),
    "class D, lagging actuators": (
        Scenario(road=Road(roughness=1024e-6, seed=3, length=120), actuator=Actuator(bandwidth=10)),
        ("lv", "suspension_only"),
    ),
    "pothole": (preset("pothole"), ("suspension_only", "passive")),
    "axles together": (Scenario(road=Road(length=80, bump=Bump(start=50), rear_axle="together")), ("lv",)),
    "hybrid": (Scenario(road=Road(length=80, bump=Bump(start=50))), ("hybrid",)),
    "slow sampling": (Scenario(road=Road(seed=5, length=115), mpc=Mpc(sample_time=0.02)), ("lqr",)),
    "hardware in the loop": (Scenario(), ("lv_hil",)),
}

# ISO 2631-1 table 3.
WK = {0.5: 0.418, 1: 0.482, 4: 0.967, 8: 1.036, 16: 0.769, 80: 0.132}


@pytest.mark.parametrize(("frequency", "gain"), WK.items())
def test_wk_has_the_standards_values(frequency: float, gain: float) -> None:
    assert float(wk_gain(np.array([frequency]))[0]) == pytest.approx(gain, abs=6e-4)
    assert abs(wk(np.array([frequency]))[0]) == pytest.approx(gain, abs=6e-4)


@pytest.mark.parametrize("name", some(3, list(CASES)))
def test_metrics_are_those_of_steps_of_a_fiftieth_of_a_millisecond(name: str) -> None:
    """RMS within 0.3 %, peaks within 1 %: what a road alone may be off by; tests/drill has the means over 20 roads."""
    scenario, strategies = CASES[name]
    for strategy in strategies:
        result = simulate(scenario, strategy)
        assert list(result.metrics) == list(WINDOWS)
        assert all(list(window) == list(METRIC_SIGNALS) for window in result.metrics.values())
        assert list(result.comfort) == list(COMFORT)
        for key, error in errors(scenario, strategy, result).items():
            assert abs(error) < (0.01 if key.endswith(("peak", "peak_power")) else 0.003), (strategy, key, error)


@pytest.mark.thorough
@settings(max_examples=examples(12))
@given(vehicles, bumps | rows_of_bumps, between(10, 100))
def test_a_passive_cars_metrics_over_any_bump_at_any_speed(car: Vehicle, bump: Bump, speed_kmh: float) -> None:
    """Within 0.3 %, kinked shapes included; before the bump a smooth road leaves nothing to be measured."""
    if abs(bump.height) > bump.width / 4:  # steeper than 45°: no car drives it
        bump = bump.model_copy(update={"height": bump.width / 4})
    road, speed = Road(roughness=0, length=125, bump=bump), Speed(initial_speed_kmh=speed_kmh)
    scenario = Scenario(vehicle=car, road=road, speed=speed)
    for key, error in errors(scenario, "passive", simulate(scenario, "passive")).items():
        assert abs(error) < 0.003 or key.startswith("rough_road"), key


def test_papers_peaks_over_the_bump_alone() -> None:
    """The figures docs/explanation/metrics.md prints, an adaptive solver's at 1e-10."""
    bump = simulate(preset("bump_only"), "passive").metrics["bump"]
    peaks = [bump[name]["peak"] for name in PAPER_SIGNALS]
    np.testing.assert_allclose(peaks, [6.247, 9.973, 8582.5, 8897.7], rtol=2e-4)


@pytest.mark.parametrize(("speed_kmh", "peak"), [(50, 12.34), (25, 5.53)])
def test_the_papers_peak_where_both_axles_meet_the_bump_together(speed_kmh: float, peak: float) -> None:
    """Of Table 2's car untouched, by the independent car in steps of a fiftieth of a millisecond too; 12.6 is printed.

    Both axles leave the bump where it ends.
    """
    road, speed = Road(roughness=0, rear_axle="together"), Speed(initial_speed_kmh=speed_kmh)
    scenario = Scenario(road=road, speed=speed)
    result = simulate(scenario, "passive")
    assert result.metrics["bump"]["body_acceleration"]["peak"] == pytest.approx(peak, abs=0.005)
    assert [span.end_position for span in result.stages] == [100.0, 104.0, 150.0]
    for key, error in errors(scenario, "passive", result).items():
        assert abs(error) < 0.003 or key.startswith("rough_road"), key


def test_a_section_ends_at_a_sample_that_is_as_near_as_rounding() -> None:
    assert section_ends([(719.9999999, 720.5)]).tolist() == [[720, 720.5]]


def test_a_window_ends_where_the_drive_does_not_where_a_sample_is() -> None:
    """A tenth of a sample more of the bump's window changes its RMS by a tenth of what a sample would."""

    def rms(width: float) -> float:
        road = Road(roughness=0, bump=Bump(height=0.001, width=width, shape="trapezoid"))
        return simulate(Scenario(road=road), "passive").metrics["bump"]["body_acceleration"]["rms"]

    widths = 4 + np.arange(20) * 0.001
    changes = np.diff([rms(float(width)) for width in widths])
    assert np.abs(changes - changes.mean()).max() < 0.2 * np.abs(changes).mean()


INTERVALS = [[(0, 100)], [(0, 100), (104, 110)], [(0, 110)], [(63.2, 63.3), (20, 50), (149, 150)]]


@pytest.mark.parametrize("intervals", INTERVALS, ids=str)
@pytest.mark.parametrize("strategy", ["passive", "lv"])
def test_rms_over_intervals_of_the_road_is_by_definition(strategy: str, intervals: list[tuple[float, float]]) -> None:
    """The RMS by a million instants, with the jump where a held command changes.

    Between samples accelerations are straight lines, of all else the squares are; a million
    instants place an interval's ends within 20 µs, which is a ten-thousandth of the shortest interval's RMS.
    """
    scenario = Scenario()
    result, speed_profile = simulate(scenario, strategy), make_speed_profile(scenario, STRATEGIES[strategy].speed_plan)
    rms = rms_between(result.series, speed_profile, intervals)
    assert list(rms) == list(METRIC_SIGNALS)
    time = (np.arange(1_000_000) + 0.5) * result.travel_time / 1_000_000
    position = speed_profile.at(time)[0]
    time = time[np.any([(first <= position) & (position <= last) for first, last in intervals], axis=0)]
    fine = result.series.columns("front_force").shape[1] - 1
    step = time / result.series["time"][1]
    sample = step.astype(int)
    command, row = np.divmod(sample, fine)
    for signal, value in rms.items():
        power = 1 if signal.endswith("acceleration") else 2
        values = result.series.columns(signal) ** power
        history = values[command, row] + (step - sample) * (values[command, row + 1] - values[command, row])
        assert value == pytest.approx(np.sqrt(np.mean(history ** (2 / power))), rel=1e-4), signal


@pytest.mark.parametrize("strategy", STRATEGIES)
def test_events_are_what_the_series_show(strategy: str) -> None:
    """A sharp bump at speed: wheels lift, travel and force limits are met."""
    scenario = Scenario(road=Road(bump=Bump(height=0.12, width=2.5)), mpc=Mpc(deflection_limit=0.06, force_limit=2000))
    result = simulate(scenario, strategy)
    series, events = result.series, result.events
    assert list(events) == list(EVENTS)
    step = series["time"][1]
    front, rear = (
        series[f"{axle}_tyre_load"] < -load
        for axle, load in zip(("front", "rear"), scenario.vehicle.static_loads, strict=True)
    )
    for name, mask in (("airborne_ms", front | rear), ("front_airborne_ms", front), ("rear_airborne_ms", rear)):
        assert events[name] == pytest.approx(mask.sum() * step * 1000, abs=2 * step * 1000), name
    largest = max(np.abs(series[f"{axle}_deflection"]).max() for axle in ("front", "rear"))
    assert events["travel_exceeded_mm"] == pytest.approx(max(0, largest - 0.06) * 1000, abs=1e-6)
    assert events["qp_failures"] == 0 or strategy == "lv_hil"  # whose iterations are bounded
    assert all((value is None) == (strategy != "lv_hil") for name, value in events.items() if name.startswith("ecu_"))
    if strategy in ("passive", "speed_only"):
        assert events["limited_steps"] == events["qp_solves"] == 0
        assert np.abs(series["front_force"]).max() == 0
    else:
        assert max(np.abs(series[f"{axle}_force"]).max() for axle in ("front", "rear")) <= 2000


@pytest.mark.parametrize("length", [112.34, 250.0])
@pytest.mark.parametrize("strategy", ["passive", "lv"])
def test_series_are_complete(strategy: str, length: float) -> None:
    """All signals, one length, finite, time ascending evenly from 0, the front axle from 0 to the road's end."""
    result = simulate(Scenario(road=Road(length=length)), strategy)
    assert list(result.series) == list(SIGNALS)
    sizes = {len(values) for values in result.series.values()}
    assert len(sizes) == 1
    time, position = result.series["time"], result.series["position"]
    steps = np.diff(time)
    np.testing.assert_allclose(steps, steps[0], rtol=1e-6)
    assert steps[0] <= 0.001 + 1e-12
    assert time[0] == 0
    assert abs(position[0]) < 1e-9
    assert length - 2 * result.series["speed"][-1] * steps[0] < position[-1] <= length + 1e-9
    for name, values in result.series.items():
        assert values.dtype == np.float64, name
        assert np.isfinite(values).all(), name


@pytest.mark.parametrize("strategy", STRATEGIES)
def test_stages_follow_the_geometry_without_gaps(strategy: str) -> None:
    for height in (0.1, 0.0):
        result = simulate(Scenario(road=Road(bump=Bump(height=height))), strategy)
        braked = strategy not in ("suspension_only", "passive")
        assert [span.stage for span in result.stages] == ["cruise", *(["brake"] if braked else []), "bump", "cruise"]
        edges = [0.0, *([20.0] if braked else []), 100.0, 104 + Vehicle().wheelbase, 150.0]
        np.testing.assert_allclose([span.start_position for span in result.stages], edges[:-1])
        np.testing.assert_allclose([span.end_position for span in result.stages], edges[1:])
        for one, following in zip(result.stages, result.stages[1:], strict=False):
            assert one.end_time == following.start_time
        for span in result.stages:
            at = np.interp(span.start_position, result.series["position"], result.series["time"])
            assert span.start_time == pytest.approx(at, abs=1e-5)


def test_a_road_that_ends_on_the_bump_is_reported() -> None:
    on_it = Scenario(road=Road(length=105))
    assert simulate(on_it, "passive").events["bump_complete"] is False
    assert simulate(Scenario(), "passive").events["bump_complete"] is True
