"""The road as preview sensors give it, and what a controller that knows their errors makes of it.

In space, once for the whole drive: a place has one height for both axles and in every control step.
"""

from dataclasses import dataclass
from math import ceil, floor, pi

import numpy as np

from sim_core.arrays import FloatArray
from sim_core.caching import cached
from sim_core.road.profile import (
    GRID,
    RoadProfile,
    bump_height,
    grid_positions,
    height_density,
    rough_profile,
)
from sim_core.scenario import Mismatch, Mpc, Road

_NOISE_STREAM = 2  # a generator of its own beside the road's


@dataclass(frozen=True, slots=True, kw_only=True)
class ExpectedErrors:
    """Errors of the sensors, as a controller expects them: standard deviations of offset and noise [m]."""

    offset: float = 0.0
    noise: float = 0.0


def expected_errors(mpc: Mpc) -> ExpectedErrors:
    """Return what a scenario's controllers expect."""
    return ExpectedErrors(offset=mpc.expected_offset, noise=mpc.expected_noise)


@cached
def sensed_road(
    surface: RoadProfile, road: Road, mismatch: Mismatch, expected: ExpectedErrors, *, obstacle_alone: bool
) -> RoadProfile:
    """Return the road that a controller plans with, before the sensors' offset, gain and delay are applied.

    Args:
        surface: The true road.
        road: Its class and seed.
        mismatch: The sensors' noise and resolution.
        expected: What the controller expects of their errors.
        obstacle_alone: Whether they report the bump and none of the roughness.
    """
    roughness, bump = surface.roughness, surface.bump
    if obstacle_alone:
        roughness = np.zeros_like(roughness)
    else:
        roughness = roughness + _noise(len(roughness), road.seed, mismatch)
        roughness = trusted(roughness, road.roughness, expected)
    if mismatch.preview_resolution:
        heights = roughness + bump_height(bump, grid_positions(len(roughness)))
        roughness, bump = _averaged(heights, mismatch.preview_resolution), bump.model_copy(update={"height": 0.0})
    return rough_profile(roughness, bump)


def trusted(seen: FloatArray, roughness: float, expected: ExpectedErrors) -> FloatArray:
    """Return the Wiener estimate of the roughness from what the sensors give (n,) [m].

    Args:
        seen: Heights on the road's grid.
        roughness: Gd(n0) [m³], the road's class.
        expected: Errors; none trusts all.
    """
    if expected == ExpectedErrors():
        return seen
    n = np.asarray(np.fft.rfftfreq(2 * len(seen), GRID), dtype=np.float64)
    weight = wiener_filter(n, roughness, expected)
    mirrored = np.concatenate([seen, seen[::-1]])  # so that no end jumps to the other
    return np.asarray(np.fft.irfft(np.fft.rfft(mirrored) * weight)[: len(seen)])


def wiener_filter(n: FloatArray, roughness: float, expected: ExpectedErrors) -> FloatArray:
    """Return by how much the best linear estimate weighs what the sensors see at each spatial frequency n [1/m].

    Where they err by an offset of standard deviation s and by white noise it is exp(-(2π n s)²/2) S(n) / (S(n) + N),
    S being the road's density and N = 2 σ² Δx the noise's (Wiener 1949; the first factor is the mean of
    exp(j 2π n offset) over a normal offset).
    """
    weight = np.exp(-((2 * pi * n * expected.offset) ** 2) / 2)
    if expected.noise:
        density = height_density(roughness, n)
        total = density + 2 * expected.noise**2 * GRID
        weight *= np.divide(density, total, out=np.ones_like(n), where=total > 0)
    return np.asarray(weight)


def _noise(samples: int, seed: int, mismatch: Mismatch) -> FloatArray | float:
    if not mismatch.preview_noise:
        return 0.0
    white = np.random.default_rng((seed, _NOISE_STREAM)).standard_normal(samples)
    return mismatch.preview_noise * white


def _averaged(heights: FloatArray, length: float) -> FloatArray:
    """Return means over that length of road [m] about each sample, the road being straight between samples.

    The mean of a straight piece is its height in the middle, which both samples beside it share.
    """
    half = length / GRID / 2
    ends = np.array([-half, *range(-floor(half), floor(half) + 1), half])
    share, middle = np.diff(ends) / (2 * half), (ends[1:] + ends[:-1]) / 2
    beside = ceil(half)
    weights = share @ np.maximum(0, 1 - np.abs(middle[:, None] - np.arange(-beside, beside + 1)))
    return np.convolve(np.pad(heights, beside, mode="edge"), weights, mode="valid")
