"""The passive car's runs against an adaptive solver and against its frequency response."""

import numpy as np
import pytest
from hypothesis import given, settings

from sim_core.catalogue import PAPER_SIGNALS
from sim_core.scenario import Bump, Road, Scenario, Speed, Vehicle
from sim_core.scenario.presets import preset
from sim_core.scenario.road import BumpShape
from sim_core.simulate import simulate
from tests.validation.reference.bump import crossing, peaks
from tests.validation.reference.vehicle import OUTPUTS, road_response, state_space
from tests.validation.strategies import between, bumps, examples, rows_of_bumps, vehicles


def test_papers_peaks_over_the_bump_alone() -> None:
    """The figures docs/physics.md prints: an adaptive solver's at 1e-10, here within 0.02 %."""
    result = simulate(preset("bump_only"), "passive")
    ours = [result.metrics["bump"][name]["peak"] for name in PAPER_SIGNALS]
    np.testing.assert_allclose(ours, [6.247, 9.973, 8582.5, 8897.7], rtol=2e-4)
    np.testing.assert_allclose(peaks(Vehicle(), Bump(), 50 / 3.6)[:4], [6.247, 9.973, 8582.5, 8897.7], rtol=1e-4)


def smooth_scenario(car: Vehicle, bump: Bump, speed_kmh: float) -> Scenario:
    return Scenario(
        vehicle=car, road=Road(roughness=0, length=125, bump=bump), speed=Speed(initial_speed_kmh=speed_kmh)
    )


@settings(max_examples=examples(30))
@given(vehicles, bumps | rows_of_bumps, between(10, 100))
def test_peaks_of_any_car_bump_and_speed(car: Vehicle, bump: Bump, speed_kmh: float) -> None:
    """Within 0.3 % of an adaptive solver, for every shape, kinked ones included.

    A peak of a signal that hardly moves is judged against 1e-9 of its unit.
    """
    if abs(bump.height) > bump.width / 4:  # steeper than 45°: no car drives it
        bump = bump.model_copy(update={"height": bump.width / 4})
    result = simulate(smooth_scenario(car, bump, speed_kmh), "passive")
    ours = [result.metrics["bump"][name]["peak"] for name in OUTPUTS]
    np.testing.assert_allclose(ours, peaks(car, bump, speed_kmh / 3.6), rtol=3e-3, atol=1e-9)


@pytest.mark.parametrize("shape", ["cosine", "circular", "flat_top"])
def test_whole_time_history_over_the_bump(shape: BumpShape) -> None:
    """Every sample, not peaks alone; 0.5 % of the peak, for the reference is read at the neighbouring instant."""
    bump = Bump(shape=shape)
    result = simulate(smooth_scenario(Vehicle(), bump, 50), "passive")
    time, output = crossing(Vehicle(), bump, 50 / 3.6, settle=1.0)
    since = result.series["time"] - bump.start / (50 / 3.6)
    seen = (since > 0) & (since < time[-1])
    for i, name in enumerate(OUTPUTS):
        expected = np.interp(since[seen], time, output[:, i])
        assert np.abs(result.series[name][seen] - expected).max() < 0.005 * np.abs(expected).max(), name


def test_nothing_moves_on_a_smooth_road_without_a_bump() -> None:
    scenario = Scenario(road=Road(roughness=0, bump=Bump(height=0)))
    for strategy in ("passive", "suspension_only"):
        result = simulate(scenario, strategy)
        for name in (*OUTPUTS, "front_force", "rear_force"):
            assert np.abs(result.series[name]).max() < 1e-12, name


@pytest.mark.parametrize("speed_kmh", [30.0, 50.0, 90.0])
def test_frequency_response_of_a_long_run(speed_kmh: float) -> None:
    """Cross spectrum of road and output over a 2.5 km run is the transfer function, rear delay and phase included.

    No noise, so the estimate is limited by leakage alone: 5 % of the largest gain in the band 0.5 to 30 Hz.
    """
    car, speed = Vehicle(), speed_kmh / 3.6
    road = Road(length=2500, roughness=64e-6, bump=Bump(height=0, start=1, width=1))
    series = simulate(Scenario(road=road, speed=Speed(initial_speed_kmh=speed_kmh)), "passive").series
    dt = series["time"][1]
    length = 2 ** int(np.log2(16 / dt))
    window = np.hanning(length)
    starts = range(0, len(series["time"]) - length, length // 4)
    # The slope is whiter than the height, so less of its power leaks; H_height = H_slope · iω.
    slope = np.gradient(series["front_road"], dt)
    frequency = np.fft.rfftfreq(length, dt)
    band = (frequency > 0.5) & (frequency < 30)

    def spectra(signal: np.ndarray) -> np.ndarray:
        return np.array([np.fft.rfft(window * signal[s : s + length])[band] for s in starts])

    driven = spectra(slope)
    expected = road_response(state_space(car), frequency[band], car.wheelbase / speed)
    for i, name in enumerate(OUTPUTS):
        response = spectra(series[name])
        measured = (response * driven.conj()).sum(axis=0) / (np.abs(driven) ** 2).sum(axis=0)
        truth = expected[:, i] / (2j * np.pi * frequency[band])
        assert np.abs(measured - truth).max() < 0.05 * np.abs(truth).max(), name
