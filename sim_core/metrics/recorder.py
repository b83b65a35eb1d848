"""What a run is measured by while it is driven."""

from functools import lru_cache
from math import inf

import numpy as np

from sim_core.arrays import FloatArray
from sim_core.kernel.record import Recorder
from sim_core.loop.run import Run
from sim_core.metrics.comfort import weighting
from sim_core.metrics.windows import Windows, windows_of
from sim_core.road.profile import kinks
from sim_core.scenario import Bump, Vehicle


def windows(run: Run) -> Windows:
    """Where a run's windows lie."""
    scenario = run.scenario
    bump_end, length = scenario.bump_left, scenario.road.length
    return windows_of(run.excitation.grid, run.speed_profile, scenario.road.bump.start, bump_end, length)


def make_recorder(run: Run) -> Recorder:
    """Of the run's car in its steps, over the rough road, the bump, and what follows it."""
    excitation, of_run, short = run.excitation, windows(run), run.steps.short
    grid, surface = excitation.grid, excitation.surface
    beside, on_bump = surface.slope_range()
    return Recorder(
        fine=grid.fine // short,
        first=grid.before * short,
        ends=of_run.ends,
        rise=np.array([beside, on_bump, beside]) * of_run.step_distance / 4,  # of the road above a chord, at most
        weighted_samples=len(grid.series["time"]),
        weighting=weighting(grid.fine_step),
        tyres=_tyres(run.scenario.real_vehicle),
        road=(surface.roughness, surface.layout),
        position=grid.axles,
        height=excitation.height,
        kinks=_kinks(surface.bump),
    )


@lru_cache(maxsize=128)
def _tyres(vehicle: Vehicle) -> FloatArray:
    """`Recorder`'s tyres: one that does not lift off pulls on the road below no load."""
    lifted = [-static for static in vehicle.static_loads]
    least = lifted if vehicle.tyre_lift_off else [-inf, -inf]
    return np.array([[vehicle.front_tyre_stiffness, vehicle.rear_tyre_stiffness], least, lifted])


@lru_cache(maxsize=128)
def _kinks(bump: Bump) -> FloatArray:
    """Where the bumps' slope jumps, ascending to infinity [m]; a tyre load may peak just there."""
    return np.array([*sorted(kinks(bump)), inf])
