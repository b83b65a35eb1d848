"""Every number a run reports, computed again from its series by definition."""

import numpy as np
import pytest

from sim_core.comfort import wk_gain
from sim_core.scenario import Bump, Mpc, Road, Scenario, Vehicle
from sim_core.signals import COMFORT, EVENTS, METRIC_SIGNALS, REFERENCES, SIGNALS, WINDOWS
from sim_core.simulation import simulate
from sim_core.strategies import STRATEGIES
from tests.validation.reference.figures import rms, weighted, windows, wk

# ISO 2631-1 table 3, as docs/physics.md quotes it.
WK = {0.5: 0.418, 1: 0.482, 4: 0.967, 8: 1.036, 16: 0.769, 80: 0.132}


@pytest.mark.parametrize(("frequency", "gain"), WK.items())
def test_wk_has_the_standards_values(frequency: float, gain: float) -> None:
    assert float(wk_gain(np.array([frequency]))[0]) == pytest.approx(gain, abs=6e-4)
    assert abs(wk(np.array([frequency]))[0]) == pytest.approx(gain, abs=6e-4)


def test_wk_is_the_reference_at_every_frequency() -> None:
    frequency = np.geomspace(0.05, 400, 300)
    np.testing.assert_allclose(wk_gain(frequency), np.abs(wk(frequency)), rtol=1e-9)


@pytest.mark.parametrize("strategy", STRATEGIES)
def test_metrics_are_their_definitions(strategy: str) -> None:
    """Within 0.3 %: trapezoids here and a sum there, and one sample of about 500 more or less at a window's edges."""
    scenario = Scenario()
    result = simulate(scenario, strategy)
    assert list(result.metrics) == list(WINDOWS)
    for name, mask in windows(scenario, result).items():
        assert list(result.metrics[name]) == list(METRIC_SIGNALS)
        for signal in METRIC_SIGNALS:
            values = result.series[signal][mask]
            found = result.metrics[name][signal]
            peak = np.abs(values).max()
            assert found["peak"] == pytest.approx(peak, rel=3e-3), (name, signal)
            assert found["rms"] == pytest.approx(rms(result.series["time"][mask], values), rel=3e-3), (name, signal)


@pytest.mark.parametrize("strategy", ["passive", "lv"])
def test_comfort_is_its_definition(strategy: str) -> None:
    """Wk in the frequency domain against the core's filter: 0.5 %, the bilinear warp near 100 Hz."""
    scenario = Scenario()
    result = simulate(scenario, strategy)
    assert list(result.comfort) == list(COMFORT)
    series = result.series
    step = series["time"][1]
    filtered = weighted(series["body_acceleration"], step)
    assert result.comfort["weighted_rms"] == pytest.approx(np.sqrt(np.mean(filtered**2)), rel=5e-3)
    assert result.comfort["vibration_dose"] == pytest.approx((np.sum(filtered**4) * step) ** 0.25, rel=5e-3)
    power = 0.0
    for axle in ("front", "rear"):
        # A jump of the force has no derivative, but the deflection is smooth.
        power = power + np.abs(series[f"{axle}_force"] * np.gradient(series[f"{axle}_deflection"], step))
        static = scenario.vehicle.static_loads[axle == "rear"]
        rough = result.metrics["rough_road"][f"{axle}_tyre_load"]["rms"]
        assert result.comfort[f"{axle}_dynamic_load_coefficient"] == pytest.approx(rough / static)
    assert result.comfort["actuator_mean_power"] == pytest.approx(np.mean(power), rel=0.01, abs=1e-9)
    assert result.comfort["actuator_peak_power"] == pytest.approx(np.max(power), rel=0.03, abs=1e-9)


def test_papers_static_loads() -> None:
    """m_b g b/L + m_w g and m_b g a/L + m_w g with g = 9.80665."""
    reference = simulate(Scenario(), "lv").reference
    assert list(reference) == list(REFERENCES)
    assert reference["front_static_load"] == pytest.approx(1270 * 9.80665 * 1.895 / 2.91 + 66.3 * 9.80665)
    assert reference["rear_static_load"] == pytest.approx(1270 * 9.80665 * 1.015 / 2.91 + 66.3 * 9.80665)
    assert reference["target_speed"] == pytest.approx(22.5 / 3.6)


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


def test_passive_car_lifts_its_rear_wheel_over_the_papers_bump() -> None:
    events = simulate(Scenario(road=Road(roughness=0)), "passive").events
    assert events["rear_airborne_ms"] > 10
    assert events["front_airborne_ms"] == 0


@pytest.mark.parametrize("length", [110.0, 125.0, 150.0, 250.0, 112.34])
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
        braked = strategy in ("lv", "lv_hil", "lqr", "speed_only")
        assert [span.stage for span in result.stages] == ["cruise", *(["brake"] if braked else []), "bump", "cruise"]
        edges = [0.0, *([20.0] if braked else []), 100.0, 104 + Vehicle().wheelbase, 150.0]
        np.testing.assert_allclose([span.start_position for span in result.stages], edges[:-1])
        np.testing.assert_allclose([span.end_position for span in result.stages], edges[1:])
        for one, following in zip(result.stages, result.stages[1:], strict=False):
            assert one.end_time == following.start_time
        for span in result.stages:
            at = np.interp(span.start_position, result.series["position"], result.series["time"])
            assert span.start_time == pytest.approx(at, abs=1e-5)
