"""The road, made once in space: ISO 8608 roughness plus bumps (paper section 2.1, errata in docs/reference/errata.md).

Every strategy drives the same road whatever its speed, and the rear axle the front's road: a wheelbase later, or at
the same instant (`road.rear_axle`).
"""

from dataclasses import dataclass, field
from math import exp, inf, pi, sqrt

import numpy as np

from sim_core.arrays import FloatArray
from sim_core.caching import cached
from sim_core.errors import MissingRoadError, RefusedError
from sim_core.kernel import binding
from sim_core.scenario import Bump, Road
from sim_core.scenario.measured import SPACING, MeasuredRoad
from sim_core.scenario.road import SHAPES

REFERENCE_FREQUENCY = 0.1  # n0 [1/m], ISO 8608
CUTOFF_FREQUENCY = 0.011  # n00 [1/m]: below it the PSD is flat, so the road stays bounded
GRID = SPACING  # distance between roughness samples [m]
RUN_IN = 20.0  # driven before x = 0, so that the car has met the road when the record starts [m]
_BEFORE = 45.0  # road made before x = 0 [m]: run-in, longest wheelbase, one control step
_AFTER = 1.0  # road made beyond its end [m]; further on it stays level


def grid_samples(length: float) -> int:
    """Samples of a road's roughness, from `_BEFORE` to `_AFTER` its end [m]."""
    return int((length + _BEFORE + _AFTER) / GRID) + 2


def grid_positions(samples: int) -> FloatArray:
    """Positions [m] of a road's first so many roughness samples."""
    return GRID * np.arange(samples, dtype=np.float64) - _BEFORE


@dataclass(frozen=True, slots=True, eq=False)
class RoadProfile:
    """Height of the road over distance: roughness samples, linear in between, and the bump's formula.

    Attributes:
        roughness: Heights of the samples (n,) [m].
        slopes: Between the roughness' steepest slopes up and down [1].
        bump: The bumps.
        layout: Samples and bumps as numbers (9,), for C.
    """

    roughness: FloatArray
    slopes: float
    bump: Bump
    layout: FloatArray = field(init=False, repr=False)

    def __post_init__(self) -> None:
        """Prepare what C reads."""
        bump = self.bump
        until = inf if SHAPES[bump.shape].stays_up else bump.end
        numbers = bump.count, bump.start, bump.height, bump.width, bump.spacing, until
        layout = binding.road_layout(-_BEFORE, GRID, bump.shape, numbers)
        object.__setattr__(self, "layout", layout)

    def height(self, position: FloatArray) -> FloatArray:
        """Road height [m] at positions [m] of any shape; level beyond the road made."""
        position = np.ascontiguousarray(position, dtype=np.float64)
        height = np.empty_like(position)
        binding.road_heights(self.roughness, self.layout, position, height)
        return height

    def slope_range(self) -> tuple[float, float]:
        """Between its steepest slopes up and down [1], beside the bump and on it.

        A chord deviates from the road by at most a quarter of that times its length.
        """
        return self.slopes, self.slopes + 2 * steepest(self.bump)


def rough_profile(roughness: FloatArray, bump: Bump) -> RoadProfile:
    """Return a road of those samples (n,) [m]."""
    return RoadProfile(roughness, _slopes(roughness), bump)


def _slopes(roughness: FloatArray) -> float:
    rise = roughness[1:] - roughness[:-1]
    return float(max(rise.max(), 0.0) - min(rise.min(), 0.0)) / GRID


def bump_height(bump: Bump, position: FloatArray) -> FloatArray:
    """Height of the bumps alone [m] at positions [m]; behind a kerb its whole height."""
    return RoadProfile(np.zeros(2), 0.0, bump).height(position)


def kinks(bump: Bump) -> tuple[float, ...]:
    """Return where the bumps' slope jumps [m]; a tyre load may peak just there."""
    starts = [bump.start + number * bump.spacing for number in range(bump.count)] if bump.height else []
    return tuple(start + share * bump.width for start in starts for share in SHAPES[bump.shape].kinks)


def steepest(bump: Bump) -> float:
    """Return the bump's steepest slope, up or down [1]; infinite for half a circle."""
    height, half, factor = abs(bump.height), bump.width / 2, SHAPES[bump.shape].steepest
    if factor is not None:
        return factor * height / bump.width
    return height / half * 2 / (1 - (height / half) ** 2) if height < half else inf  # circular


def detail(bump: Bump) -> float:
    """Return the length over which the bump rises and falls once [m]."""
    return SHAPES[bump.shape].ascent * bump.width


def height_density(roughness: float, frequency: FloatArray) -> FloatArray:
    """Return the one-sided PSD of the road's height [m^3] at spatial frequencies [1/m]: Gd(n0) n0² / (n² + n00²)."""
    return np.asarray(roughness * REFERENCE_FREQUENCY**2 / (frequency**2 + CUTOFF_FREQUENCY**2))


def stationary_deviation(roughness: float) -> float:
    """Return the standard deviation of the endless road [m]: root of the PSD's integral, Gd n0² π / (2 n00)."""
    return sqrt(roughness * REFERENCE_FREQUENCY**2 * pi / (2 * CUTOFF_FREQUENCY))


@cached
def _roughness(roughness: float, seed: int, length: float) -> tuple[FloatArray, float]:
    """Samples of dz/dx = -2π n00 z + 2π n0 √Gd w from `_BEFORE` on, exact at the grid points, and their `slopes`.

    Var(w) = 1/(2Δx) makes the one-sided PSD that of `height_density` (ISO 8608 with a cut-off). The same seed gives the
    same road for every length: a longer one only goes on.
    """
    keep = exp(-2 * pi * CUTOFF_FREQUENCY * GRID)
    samples = np.random.default_rng(seed).standard_normal(grid_samples(length))
    slopes = binding.roughness(samples, stationary_deviation(roughness), keep, GRID)
    samples.flags.writeable = False
    return samples, slopes


@cached
def _measured(measured: MeasuredRoad, length: float) -> tuple[FloatArray, float]:
    """Return the same of a measured road: level before its first height."""
    heights, before = measured.heights(), round(_BEFORE / GRID)
    samples = np.full(grid_samples(length), heights[-1])
    samples[:before] = heights[0]
    count = min(len(heights), len(samples) - before)
    samples[before : before + count] = heights[:count]
    samples.flags.writeable = False
    return samples, _slopes(samples)


def road_profile(road: Road) -> RoadProfile:
    """Return the road of a scenario.

    Raises:
        MissingRoadError: It names a measured road whose heights nobody handed over.
        RidelabError: The measured road is shorter.
    """
    if road.profile is None:
        return RoadProfile(*_roughness(road.roughness, road.seed, road.length), road.bump)
    if road.measured is None:
        raise MissingRoadError("The measured road of this id is not here", field="road.profile")
    if road.length > road.measured.length:
        message = f"The measured road is {road.measured.length:g} m long: the road's length can be at most that"
        raise RefusedError(message, field="road.length")
    return RoadProfile(*_measured(road.measured, road.length), road.bump)
