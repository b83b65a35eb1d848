"""The road against ISO 8608, against its own definition, and against itself."""

from typing import get_args

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st
from scipy.signal import welch

from sim_core.road.profile import road_profile, steepest
from sim_core.road.sensed import ExpectedErrors, sensed_road
from sim_core.scenario import Bump, Mismatch, Road
from sim_core.scenario.road import BumpShape
from tests.validation.reference.bump import bump_height
from tests.validation.strategies import between, bumps, rows_of_bumps

FLAT = Bump(height=0, start=10)
SEEDS = range(20)


def spectrum(roughness: float) -> tuple[np.ndarray, np.ndarray]:
    """Welch's mean over seeds of a 2.9 km road sampled each 2 cm; segments of 164 m, 50 % overlap."""
    spacing, x = 0.02, np.arange(0, 2900, 0.02)
    total = np.zeros(4097)
    for seed in SEEDS:
        height = road_profile(Road(roughness=roughness, seed=seed, length=3000, bump=FLAT)).height(x)
        n, density = welch(height, fs=1 / spacing, nperseg=8192, detrend="constant", window="hann")
        total = total + density / len(SEEDS)
    return n, total


@pytest.mark.parametrize("roughness", [16e-6, 64e-6, 1024e-6])
def test_density_is_iso_8608_with_the_cut_off(roughness: float) -> None:
    """Third-octave means over 20 seeds x about 34 overlapping segments.

    One bin's relative deviation is about 1/sqrt(20 x 17.7 x 2 x 0.53) ≈ 5 %; a band of two bins or more, 3.7 % or
    less; 4 deviations of the widest are 15 %. A factor 2 (one- or two-sided) or 2π (per radian) would stand out.
    """
    n, density = spectrum(roughness)
    for low in 0.02 * 2 ** (np.arange(20) / 3):
        band = (n >= low) & (n < low * 2 ** (1 / 3))
        if band.sum() < 2:
            continue
        expected = np.mean(roughness * 0.1**2 / (n[band] ** 2 + 0.011**2))
        assert np.mean(density[band]) == pytest.approx(expected, rel=0.15 if band.sum() < 6 else 0.08), low


def test_deviation_over_many_roads_is_the_integral_of_the_density() -> None:
    """Var z = Gd n0² π / (2 n00); 400 independent starts give 3.5 % on the deviation, 3 of those allowed."""
    heights = [
        road_profile(Road(seed=seed, length=20, bump=FLAT.model_copy(update={"width": 1.0}))).height(np.zeros(1))[0]
        for seed in range(400)
    ]
    expected = np.sqrt(64e-6 * 0.01 * np.pi / (2 * 0.011))
    assert np.std(heights) == pytest.approx(expected, rel=0.11)
    assert abs(np.mean(heights)) < 4 * expected / np.sqrt(400)


def test_seeds_are_different_roads_and_the_same_seed_the_same() -> None:
    x = np.linspace(-20, 100, 5000)
    first, again, other = (road_profile(Road(seed=seed, bump=FLAT)).height(x) for seed in (1, 1, 2))
    assert np.array_equal(first, again)
    assert abs(np.corrcoef(first, other)[0, 1]) < 0.9
    assert np.abs(first - other).max() > 0.01


def test_a_longer_road_only_goes_on() -> None:
    x = np.linspace(-20, 100, 5000)
    short, long = (road_profile(Road(length=length, bump=FLAT)).height(x) for length in (110.0, 500.0))
    assert np.array_equal(short, long)


@settings(max_examples=60)
@given(bumps | rows_of_bumps, st.sampled_from([0.0, 64e-6]))
def test_the_bump_is_added_to_the_roughness(bump: Bump, roughness: float) -> None:
    x = np.linspace(20, 120, 3001)
    whole = road_profile(Road(roughness=roughness, bump=bump)).height(x)
    rough = road_profile(Road(roughness=roughness, bump=bump.model_copy(update={"height": 0.0}))).height(x)
    np.testing.assert_allclose(whole - rough, bump_height(bump, x), atol=1e-12)


def test_the_papers_bump() -> None:
    """Eq. 2: 0 at 100 and 104 m, 0.1 m at 102 m, half of that at 101 and 103 m."""
    height = road_profile(Road(roughness=0)).height(np.array([99.0, 100, 101, 102, 103, 104, 105]))
    np.testing.assert_allclose(height, [0, 0, 0.05, 0.1, 0.05, 0, 0], atol=1e-15)


@st.composite
def any_bumps(draw: st.DrawFn) -> Bump:
    """All that a scenario accepts, at and near what its limits forbid."""
    shape, height, count = draw(st.sampled_from(get_args(BumpShape))), draw(between(-1, 1)), draw(st.integers(1, 9))
    narrowest = max(0.05, 2 * abs(height) if shape == "circular" else 0)
    width = draw(st.just(narrowest) | st.just(float(np.nextafter(narrowest, 9))) | between(narrowest, 9))
    spacing = draw(st.just(width) | between(width, 20))
    return Bump(shape=shape, height=height, width=width, start=30, count=count, spacing=spacing)


@settings(max_examples=200)
@given(any_bumps(), st.sampled_from([0.0, 0.005, 0.01, 0.03, 2.0]) | between(0, 2), st.booleans())
def test_any_bump_has_a_height_and_a_slope_everywhere(bump: Bump, resolution: float, alone: bool) -> None:
    """On the road, and as sensors of any resolution give it; only half a circle is infinitely steep, at its feet."""
    road = Road(length=300, bump=bump)
    edges = [bump.start + number * bump.spacing + end for number in range(bump.count) for end in (0, bump.width)]
    x = np.sort([*np.linspace(29, 300, 4000), *edges, *np.nextafter(edges, -np.inf), *np.nextafter(edges, np.inf)])
    true = road_profile(road)
    sensed = sensed_road(true, road, Mismatch(preview_resolution=resolution), ExpectedErrors(), obstacle_alone=alone)
    for surface in (true, sensed):
        assert np.isfinite(surface.height(x)).all()
        steepest = surface.slope_range()[1]
        assert np.isfinite(steepest) or (surface.bump.shape == "circular" and bump.width == 2 * abs(bump.height))


@pytest.mark.parametrize("shape", get_args(BumpShape))
def test_a_bumps_steepest_slope_is_that_of_its_heights(shape: BumpShape) -> None:
    bump, x = Bump(shape=shape, height=0.1, width=2, start=50), np.linspace(49, 53, 400_001)
    slopes = np.diff(bump_height(bump, x)) / np.diff(x)
    assert steepest(bump) == pytest.approx(np.abs(slopes).max(), rel=1e-3)


def test_a_class_is_its_mean_roughness() -> None:
    """ISO 8608, table C.1: class means of Gd(n0) in 1e-6 m³."""
    means = {"A": 16, "B": 64, "C": 256, "D": 1024, "E": 4096, "F": 16384, "G": 65536, "H": 262144}
    assert {name: Road.model_validate({"roughness": name}).roughness * 1e6 for name in means} == pytest.approx(means)
    assert Road.model_validate({"roughness": "B"}) == Road()
