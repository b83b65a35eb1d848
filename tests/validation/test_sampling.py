"""How finely a drive is sampled, and that no peak between two samples is missed where the road has a kink."""

import numpy as np
import pytest

from sim_core import Bump, Road, Scenario, Speed, Vehicle, simulate
from sim_core.kernel.record import WEIGHTING, Recorder
from sim_core.road.profile import GRID, grid_positions, kinks, rough_profile
from sim_core.scenario.road import BumpShape

LOAD = 4  # place of the front tyre's in a sample


@pytest.mark.parametrize(("shape", "rising_and_falling"), [("cosine", 1.0), ("trapezoid", 0.5), ("flat_top", 0.5)])
@pytest.mark.parametrize("width", [0.3, 0.6])
def test_a_short_bump_rises_and_falls_in_60_fine_steps(
    shape: BumpShape, rising_and_falling: float, width: float
) -> None:
    """At the initial speed; control steps hold whole numbers of fine ones, which may shorten them by one in 28."""
    road = Road(roughness=0, length=60, bump=Bump(shape=shape, start=40, width=width, height=0.02))
    series = simulate(Scenario(road=road, speed=Speed(initial_speed_kmh=50)), "passive").series
    distance = (50 / 3.6) * series["time"][1]
    assert 60 <= rising_and_falling * width / distance < 60 * (1 + 1 / 10)


def test_kinks_are_where_the_slope_of_each_bump_jumps() -> None:
    """A trapezoid's at its feet and at the ends of its ramps, which are a quarter of its width."""
    row = Bump(shape="trapezoid", start=10, width=4, count=2, spacing=6)
    assert kinks(row) == (10, 11, 13, 14, 16, 17, 19, 20)
    assert kinks(row.model_copy(update={"shape": "circular"})) == (10, 14, 16, 20)
    assert kinks(row.model_copy(update={"shape": "cosine"})) == kinks(row.model_copy(update={"height": 0.0})) == ()


@pytest.mark.parametrize("spare", [0.02, -0.02])
def test_a_kink_between_two_samples_counts_where_it_may_raise_the_peak(spare: float) -> None:
    """A ridge of slopes ±s halfway between samples Δ apart is sΔ/2 above their chord: so much the tyre load is larger.

    Each command has two fine steps. Under the first one a sample gives the peak so far; under the second one samples
    stay below it by what the ridge adds, less or more by `spare` of that.
    """
    slope, step, stiffness = 0.1, GRID, Vehicle().front_tyre_stiffness
    roughness = np.zeros(6_000)
    ridge = 5_000
    roughness[ridge] = slope * GRID
    surface = rough_profile(roughness, Bump(height=0))
    position = grid_positions(len(roughness))[ridge] + step * (np.arange(5) - 2.5)
    added = stiffness * slope * step / 2
    peak = 5_000.0
    low = peak - (1 - spare) * added
    axles = np.stack([position, position - 2.9])
    recorder = Recorder(
        fine=2,
        first=0,
        ends=np.array([[0.0, 4.0]]),
        max_chord_deviation=np.array([2 * slope * step / 4]),
        weighted_samples=4,
        weighting=np.zeros(WEIGHTING),
        tyres=np.array([[stiffness, stiffness], [-np.inf, -np.inf], [-np.inf, -np.inf]]),
        clearance=np.full((2, 2), np.inf),
        road=(surface.roughness, surface.layout),
        position=axles,
        height=surface.height(axles),
        kinks=np.array([np.inf]),
    )
    for command, load in enumerate([peak, low]):
        recorder.samples[:] = 0.0
        recorder.samples[:, LOAD] = load
        recorder.record(command)
    assert recorder.peaks[0, LOAD - 2] == pytest.approx(peak + max(spare, 0) * added, rel=1e-9)
    assert recorder.peaks[0, LOAD - 1] == 0
