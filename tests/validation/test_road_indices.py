"""IRI against the golden car's analytic gain and published coefficients; ISO 8608 fits of roads whose PSD is known."""

from itertools import product

import numpy as np
import pytest

from sim_core.arrays import FloatArray
from sim_core.road.iri import BASE, SPEED, exact_step, golden_car, iri
from sim_core.road.iso8608 import classified, road_class, smoothed_psd

# S and p for heights 250 and 100 mm apart, as computed in single precision: Sayers, Gillespie and Paterson
# (1986), Guidelines for Conducting and Calibrating Road Roughness Measurements, World Bank Technical Paper 46, table 5.
PUBLISHED = {
    0.25: (
        [
            [0.9966071, 0.01091514, -0.002083274, 0.0003190145],
            [-0.5563044, 0.9438768, -0.8324718, 0.05064701],
            [0.02153176, 0.002126763, 0.7508714, 0.008221888],
            [3.335013, 0.3376467, -39.12762, 0.4347564],
        ],
        [0.005476107, 1.388776, 0.2275968, 35.79262],
    ),
    0.1: (
        [
            [0.9994014, 0.004442351, 0.0002188854, 5.72179e-05],
            [-0.2570548, 0.975036, 0.007966216, 0.02458427],
            [0.003960378, 0.0003814527, 0.9548048, 0.004055587],
            [1.687312, 0.1638951, -19.34264, 0.7948701],
        ],
        [0.0003793992, 0.2490886, 0.04123478, 17.65532],
    ),
}


@pytest.mark.parametrize("spacing", PUBLISHED)
def test_the_golden_cars_steps_are_the_published_ones(spacing: float) -> None:
    (step, entry), (published_step, published_entry) = exact_step(spacing), PUBLISHED[spacing]
    np.testing.assert_allclose(step, np.array(published_step), rtol=3e-6, atol=3e-7)
    np.testing.assert_allclose(entry, np.array(published_entry), rtol=3e-6, atol=3e-7)


@pytest.mark.parametrize("wavelength", [60.0, 15.0, 8.0, 2.4, 1.0, 0.6])
def test_a_sine_has_the_analytic_index(wavelength: float) -> None:
    """Within 0.1 %: 2/π times slope, moving mean and gain. What the start adds is the same after 2 km as after 4.

    Heights 5 mm apart are constant slopes of a wave 0.6 m long to (π·5/600)²/6, 0.01 %.
    """
    number, spacing = 1 / wavelength, 0.005
    system, entry = golden_car()
    state = np.linalg.solve(2j * np.pi * number * SPEED * np.eye(4) - system, entry)
    slope = 2 * np.pi * number * np.sinc(BASE * number)  # of a wave 1 mm high, in mm/m
    expected = 2 / np.pi * slope * abs(state[0] - state[2])
    periods = round(2000 * number)
    heights = [0.001 * np.sin(2 * np.pi * number * np.arange(0, count * periods / number, spacing)) for count in (1, 2)]
    short, long = (iri(height, spacing) * (len(height) - 50) for height in heights)
    assert (long - short) / (len(heights[1]) - len(heights[0])) == pytest.approx(expected, rel=1e-3)


def test_a_sloping_straight_line_is_smooth_and_a_track_may_be_too_short() -> None:
    assert iri(0.05 * np.arange(0, 100, 0.05), 0.05) == pytest.approx(0, abs=1e-9)
    with pytest.raises(ValueError, match="shorter"):
        iri(np.zeros(5), 0.05)


def test_the_car_starts_with_the_mean_slope_of_eleven_metres() -> None:
    """Level road of that length in front of a track that begins level adds no motion, only distance."""
    track = 0.01 * np.maximum(np.arange(0, 60, 0.25) - 11, 0)
    longer = np.concatenate([np.zeros(44), track])
    alone, behind = (iri(height, 0.25) * (len(height) - 1) for height in (track, longer))
    assert alone == pytest.approx(behind, rel=1e-9)
    assert alone > 1


def road(waviness: float, roughness: float, length: float, spacing: float, seed: int) -> FloatArray:
    """Gaussian heights whose PSD is the power law from 1/1000 1/m on; a piece of a road eight times as long."""
    rng, samples = np.random.default_rng(seed), round(length / spacing)
    frequency = np.fft.rfftfreq(8 * samples, spacing)
    density = np.where(frequency < 1e-3, 0, roughness * (np.maximum(frequency, 1e-3) / 0.1) ** -waviness)
    ordinates = rng.standard_normal(len(frequency)) + 1j * rng.standard_normal(len(frequency))
    height = np.fft.irfft(np.sqrt(density * 8 * samples / (4 * spacing)) * ordinates, 8 * samples)
    return np.asarray(height[samples : 2 * samples + 1])


@pytest.mark.parametrize(("waviness", "length"), [(1.6, 50), (2.0, 200), (2.5, 1000)])
def test_intervals_hold_what_the_road_was_made_from(waviness: float, length: float) -> None:
    """95 % intervals of 100 roads: with fewer than 88 hits one would be wrong in 998 cases of 1,000."""
    fits = [classified([road(waviness, 64e-6, length, 0.05, seed)], 0.05) for seed in range(100)]
    found = [fit for fit in fits if fit]
    assert len(found) == len(fits)
    assert sum(fit.roughness.low < 64e-6 < fit.roughness.high for fit in found) >= 88
    assert sum(fit.waviness.low < waviness < fit.waviness.high for fit in found) >= 88
    errors = np.log([fit.roughness.value / 64e-6 for fit in found])
    assert abs(errors.mean()) < 4 * errors.std() / np.sqrt(len(fits)) + 0.01, "no bias"


def test_bands_are_two_octaves_then_thirds() -> None:
    """Around 1/64, 1/32 and, from 0.0496 on, a third further each up to 1/4; the standard rounds 1/32 to 0.0312."""
    centres = smoothed_psd([np.random.default_rng(1).normal(size=40_000)], 0.05)[0]
    np.testing.assert_allclose(centres[:10], [1 / 64, 1 / 32, *2 ** (np.arange(-13, -5) / 3)], rtol=0.003)


def test_a_bands_mean_scatters_as_its_independent_ordinates() -> None:
    """By the variance of 1,000 white tracks: the mean over all bands to three of its own standard deviations of 1 %."""
    tracks = np.random.default_rng(1).standard_normal((1000, 2000))
    spectra = [smoothed_psd([track], 0.05) for track in tracks]
    density, independent = np.array([each for _, each, _ in spectra]), spectra[0][2]
    scatter = density.var(axis=0) / density.mean(axis=0) ** 2
    assert (scatter * independent).mean() == pytest.approx(1, abs=0.03)


def test_a_road_without_enough_waves_has_no_class() -> None:
    assert classified([road(2.0, 64e-6, 19, 0.05, 1)], 0.05) is None
    assert classified([np.zeros(1000)], 0.05) is None
    assert classified([road(2.0, 64e-6, 30, 5.0, 1)], 5.0) is None


@pytest.mark.parametrize("spacing", [0.05, 0.25])
@pytest.mark.parametrize(
    ("added", "length"),
    [("nothing", 50), *product(["nothing", "bump", "slabs", "washboard"], [100, 200, 500])],
)
def test_rough_roads_also_with_a_bump_or_a_wave_have_a_class(added: str, length: int, spacing: float) -> None:
    x = np.arange(round(length / spacing) + 1) * spacing
    features = {
        "nothing": 0 * x,
        "bump": 0.05 * (1 - np.cos(np.pi * np.clip(x - length / 2, 0, 4) / 2)),
        "slabs": 0.006 * (x / 5 % 1),
        "washboard": 0.005 * np.sin(2 * np.pi * x / 0.8),
    }
    for seed in range(20):
        for waviness in (1.6, 2.0, 2.5):
            fit = classified([road(waviness, 64e-6, length, spacing, seed) + features[added]], spacing)
            assert fit
            assert fit.iso_class, f"seed {seed}, waviness {waviness}: {fit.roughness}"


@pytest.mark.parametrize("length", [100, 160, 400])
def test_a_road_of_two_sine_waves_has_no_class(length: int) -> None:
    """Its roughness would be that of a new motorway, its International Roughness Index that of a damaged road."""
    x = np.arange(0, length + 0.1, 0.25)
    fit = classified([0.01 * np.sin(2 * np.pi * x / 5) + 0.004 * np.sin(2 * np.pi * x / 2)], 0.25)
    assert fit
    assert fit.iso_class is None
    assert fit.roughness.span > 16


def test_classes_end_at_twice_their_mean() -> None:
    """ISO 8608:2016, table C.1: A below 32, B to 128, C to 512, ... 10^-6 m³, H has no upper end."""
    limits = 1e-6 * np.array([1, 31, 33, 127, 129, 511, 513, 2047, 2049, 8191, 8193, 524287, 1e7])
    assert "".join(map(road_class, limits)) == "AABBCCDDEEFHH"
