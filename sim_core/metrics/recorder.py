"""What a run is measured by while it is driven."""

from math import inf

import numpy as np

from sim_core.kernel.record import Recorder
from sim_core.loop.run import Run
from sim_core.metrics.comfort import weighting
from sim_core.metrics.windows import Windows
from sim_core.road.profile import kinks


def make_recorder(run: Run, windows: Windows) -> Recorder:
    """Return what measures the run's car in its steps, over the rough road, the bump, and what follows it."""
    excitation, short, vehicle = run.excitation, run.steps.short, run.scenario.real_vehicle
    lifted = [-static for static in vehicle.static_loads]
    least = lifted if vehicle.tyre_lift_off else [-inf, -inf]  # one that does not lift off pulls on the road
    grid, surface = excitation.grid, excitation.surface
    beside, on_bump = surface.slope_range()
    return Recorder(
        fine=grid.fine // short,
        first=grid.run_in_steps * short,
        ends=windows.ends,
        max_chord_deviation=np.array([beside, on_bump, beside]) * windows.step_distance / 4,
        weighted_samples=len(grid.series["time"]),
        weighting=weighting(grid.fine_step),
        tyres=np.array([[vehicle.front_tyre_stiffness, vehicle.rear_tyre_stiffness], least, lifted]),
        clearance=np.array(vehicle.stop_clearances),
        road=(surface.roughness, surface.layout),
        position=grid.axles,
        height=excitation.height,
        kinks=np.array([*sorted(kinks(surface.bump)), inf]),  # a tyre load may peak just there
    )
