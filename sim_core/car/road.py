"""The road, made once in space: ISO 8608 roughness plus bumps (paper section 2.1, errata in docs/errata.md).

Every strategy drives the same road whatever its speed, and the rear axle the front's road a wheelbase later.
"""

from dataclasses import dataclass
from math import ceil, exp, floor, inf, pi, sqrt

import numpy as np
from numpy.typing import NDArray

from sim_core.arrays import FloatArray
from sim_core.caching import cached
from sim_core.errors import MissingRoadError, RidelabError
from sim_core.scenario import Bump, Road
from sim_core.scenario.measured import SPACING, MeasuredRoad

REFERENCE_FREQUENCY = 0.1  # n0 [1/m], ISO 8608
CUTOFF_FREQUENCY = 0.011  # n00 [1/m]: below it the PSD is flat, so the road stays bounded
GRID = SPACING  # distance between roughness samples [m]
RUN_IN = 20.0  # driven before x = 0, so that the car has met the road when the record starts [m]
_BEFORE = 45.0  # road made before x = 0 [m]: run-in, longest wheelbase, one control step
_AFTER = 1.0  # road made beyond its end [m]; further on it stays level


@dataclass(frozen=True, slots=True, eq=False)
class GridPlace:
    """Positions as roughness samples: the one before, and the share of the way to the next."""

    cell: NDArray[np.intp]
    share: FloatArray


def grid_place(position: FloatArray, samples: int) -> GridPlace:
    """Where positions [m] are on a grid of so many samples; its ends for those beyond."""
    place = np.clip((position + _BEFORE) / GRID, 0.0, samples - 1.000001)
    cell = place.astype(np.intp)
    return GridPlace(cell, place - cell)


def grid_samples(length: float) -> int:
    """Samples of a road's roughness, from `_BEFORE` to `_AFTER` its end [m]."""
    return int((length + _BEFORE + _AFTER) / GRID) + 2


def grid_positions(samples: int) -> FloatArray:
    """Positions [m] of a road's first so many roughness samples."""
    return GRID * np.arange(samples, dtype=np.float64) - _BEFORE


def grid_between(first: float, last: float) -> FloatArray:
    """Positions [m] of the roughness samples strictly between two positions, where the road's slope changes."""
    numbers = np.arange(floor((first + _BEFORE) / GRID) + 1, ceil((last + _BEFORE) / GRID), dtype=np.float64)
    return numbers * GRID - _BEFORE


@dataclass(frozen=True, slots=True, eq=False)
class RoadProfile:
    """Height of the road over distance: roughness samples, linear in between, and the bump's formula.

    `rise` is from each sample to the next [m].
    """

    roughness: FloatArray
    rise: FloatArray
    bump: Bump

    def height(self, position: FloatArray) -> FloatArray:
        """Road height [m] at positions [m] of any shape; level beyond the road made."""
        height = self._roughness_at(grid_place(position, len(self.roughness)))
        on_bump = (position > self.bump.start) & (position < changed_until(self.bump))
        height[on_bump] += bump_height(self.bump, position[on_bump])
        return height

    def height_along(self, axles: FloatArray, place: GridPlace) -> FloatArray:
        """The same under axles that drive along the road (axles, n), where their places on the grid are known."""
        height = self._roughness_at(place)
        for heights, driven in zip(height, axles, strict=True):
            first = driven.searchsorted(self.bump.start, side="right")
            last = driven.searchsorted(changed_until(self.bump))
            heights[first:last] += bump_height(self.bump, driven[first:last])
        return height

    def _roughness_at(self, place: GridPlace) -> FloatArray:
        height = self.rise.take(place.cell)
        height *= place.share
        height += self.roughness.take(place.cell)
        return height

    def slope_range(self) -> tuple[float, float]:
        """Between its steepest slopes up and down [1], beside the bump and on it.

        A chord deviates from the road by at most a quarter of that times its length.
        """
        roughness = float(max(self.rise.max(), 0.0) - min(self.rise.min(), 0.0)) / GRID
        return roughness, roughness + 2 * steepest(self.bump)


def changed_until(bump: Bump) -> float:
    """Where the road is again as it would be without the bump [m]; never behind a kerb."""
    return inf if bump.shape == "kerb" else bump.end


def bump_height(bump: Bump, position: FloatArray) -> FloatArray:
    """Height of the bumps alone [m] at positions [m]; behind a kerb its whole height."""
    along = position - bump.start
    if bump.count == 1:
        return _one_bump(bump, along)
    met = np.clip(np.floor(along / bump.spacing), 0, bump.count - 1)
    height = _one_bump(bump, along - met * bump.spacing)
    return height + met * bump.height if bump.shape == "kerb" else height


def _one_bump(bump: Bump, along: FloatArray) -> FloatArray:
    """Height of one bump [m] at positions from its start [m].

    cosine is Eq. 2 of the paper; circular the arc of a Watts hump through both feet and the crest.
    """
    s = np.clip(along / bump.width, 0.0, 1.0)
    h, w = bump.height, bump.width
    if h == 0:
        return np.zeros_like(s)
    if bump.shape == "cosine":
        return np.asarray(h / 2 * (1 - np.cos(2 * pi * s)))
    if bump.shape == "half_sine":
        return np.asarray(h * np.sin(pi * s))
    if bump.shape == "kerb":
        return np.asarray(h / 2 * (1 - np.cos(pi * s)))
    if bump.shape == "circular":
        radius, from_crest = w * (w / abs(h)) / 8 + abs(h) / 2, w * (s - 0.5)
        depth = radius * np.sqrt(np.maximum(1 - (from_crest / radius) ** 2, 0.0)) + radius - abs(h)
        return np.asarray(np.copysign((w**2 / 4 - from_crest**2) / depth, h))
    ramp = np.clip(4 * np.minimum(s, 1 - s), 0.0, 1.0)  # 0 to 1 within a quarter of the width at either end
    if bump.shape == "trapezoid":
        return np.asarray(h * ramp)
    return np.asarray(h / 2 * (1 - np.cos(pi * ramp)))  # flat_top


def kinks(bump: Bump) -> tuple[float, ...]:
    """Where the bumps' slope jumps [m]; a tyre load may peak just there."""
    shares: tuple[float, ...] = ()
    if bump.shape in ("half_sine", "circular"):
        shares = (0.0, 1.0)
    elif bump.shape == "trapezoid":
        shares = (0.0, 0.25, 0.75, 1.0)
    starts = [bump.start + number * bump.spacing for number in range(bump.count)] if bump.height else []
    return tuple(start + share * bump.width for start in starts for share in shares)


def steepest(bump: Bump) -> float:
    """The bump's steepest slope, up or down [1]; infinite for half a circle."""
    height, half = abs(bump.height), bump.width / 2
    if bump.shape == "circular":
        return height / half * 2 / (1 - (height / half) ** 2) if height < half else inf
    factors = {"cosine": pi, "half_sine": pi, "trapezoid": 4.0, "flat_top": 2 * pi, "kerb": pi / 2}
    return factors[bump.shape] * height / bump.width


def detail(bump: Bump) -> float:
    """Length over which the bump rises and falls once [m]: its width, its two ramps put together, a kerb's twice."""
    return {"flat_top": 0.5, "trapezoid": 0.5, "kerb": 2.0}.get(bump.shape, 1.0) * bump.width


def stationary_deviation(roughness: float) -> float:
    """Standard deviation of the endless road [m]: root of the PSD's integral, Gd n0² π / (2 n00)."""
    return sqrt(roughness * REFERENCE_FREQUENCY**2 * pi / (2 * CUTOFF_FREQUENCY))


@cached
def _fade(keep: float, count: int) -> tuple[FloatArray, FloatArray]:
    """Powers 1, 2, … of a number, each the one before times it: a longer road only goes on; 1 over them; (count,)."""
    powers = np.full(count, keep).cumprod()
    return powers, 1 / powers


@cached
def _roughness(roughness: float, seed: int, length: float) -> tuple[FloatArray, FloatArray]:
    """Samples of dz/dx = -2π n00 z + 2π n0 √Gd w from `_BEFORE` on, exact at the grid points, and their differences.

    Var(w) = 1/(2Δx) makes the one-sided PSD Gd(n0) n0² / (n² + n00²) (ISO 8608 with a cut-off). The same
    seed gives the same road for every length: a longer one only goes on.
    """
    count = grid_samples(length)
    keep = exp(-2 * pi * CUTOFF_FREQUENCY * GRID)
    fade, grow = _fade(keep, count)
    samples = np.random.default_rng(seed).standard_normal(count)
    samples[1:] *= sqrt(1 - keep**2)
    samples *= grow
    samples.cumsum(out=samples)  # each sample is `keep` of the one before, and its noise
    samples *= fade
    samples *= stationary_deviation(roughness)
    rise = samples[1:] - samples[:-1]
    samples.flags.writeable = rise.flags.writeable = False
    return samples, rise


@cached
def _measured(measured: MeasuredRoad, length: float) -> tuple[FloatArray, FloatArray]:
    """The same of a measured road: level before its first height."""
    heights, before = measured.heights(), round(_BEFORE / GRID)
    samples = np.full(grid_samples(length), heights[-1])
    samples[:before] = heights[0]
    count = min(len(heights), len(samples) - before)
    samples[before : before + count] = heights[:count]
    rise = samples[1:] - samples[:-1]
    samples.flags.writeable = rise.flags.writeable = False
    return samples, rise


def profile(road: Road) -> RoadProfile:
    """The road of a scenario.

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
        raise RidelabError(message, field="road.length")
    return RoadProfile(*_measured(road.measured, road.length), road.bump)
