"""How finely a drive is sampled, and that no peak between two samples is missed where the road has a kink."""

import numpy as np
import pytest

from sim_core.loop.excitation import Excitation, TimeGrid
from sim_core.metrics.tyre_peaks import peaks_with_kinks
from sim_core.metrics.windows import Windows
from sim_core.road.profile import GRID, grid_positions, kinks, rough_profile
from sim_core.scenario import Bump, Road, Scenario, Speed, Vehicle
from sim_core.scenario.road import BumpShape
from sim_core.simulate import simulate


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
    loads = np.array([[[peak, low]] * 3, [[0.0, 0.0]] * 3])
    drive = TimeGrid(
        time=0.002 * np.arange(3.0),
        fine=2,
        before=0,
        axles=np.stack([position, position - 2.9]),
        position=position[:-1:2],
        speed=np.full(2, 10.0),
        on_record=slice(0, 5),
        series={},
    )
    height = surface.height(drive.axles)
    excitation = Excitation(
        grid=drive,
        disturbance=np.zeros((2, 6)),
        surface=surface,
        height=height,
        series={},
    )
    ends = np.array([[0.0, 4.0], [4.0, 4.0], [4.0, 4.0]])
    windows = Windows(ends=ends, fine_step=0.001, step_distance=np.full(3, step), arrival_speed=10.0)
    highest = np.abs(loads).max(axis=1)
    peaks = np.repeat(highest.max(axis=1)[:, None], 3, axis=1)
    raised = peaks_with_kinks(loads, highest, peaks, Vehicle(), windows, excitation)
    assert raised[0, 0] == pytest.approx(peak + max(spare, 0) * added, rel=1e-9)
