"""Peaks of the tyre loads where the road's slope changes between two samples, by the C of kernel/road.c."""

from math import inf

import numpy as np

from sim_core.arrays import FloatArray
from sim_core.kernel import binding
from sim_core.loop.excitation import Excitation
from sim_core.metrics.windows import Windows
from sim_core.road.profile import kinks
from sim_core.scenario import Vehicle


def peaks_with_kinks(
    loads: FloatArray,
    highest: FloatArray,
    peaks: FloatArray,
    vehicle: Vehicle,
    windows: Windows,
    excitation: Excitation,
) -> FloatArray:
    """Largest magnitude of the tyre loads in each section (2, sections) [N].

    At a kink of the road a load deviates from the line between the samples by the tyre's stiffness times the height of
    the kink above the road's chord. Only kinks that may raise a peak count: under commands whose samples come near it.

    Args:
        loads: Front and rear (2, fine steps of a command + 1, commands) [N].
        highest: Their largest magnitude under each command (2, commands) [N].
        peaks: Their largest magnitude in each section at samples (2, sections) [N].
        vehicle: The real one.
        windows: Where the sections lie.
        excitation: The road under the axles.

    Raises:
        ValueError: It is that of another record.
    """
    surface = excitation.surface
    of_bump = np.array([*sorted(kinks(surface.bump)), inf])
    beside, on_bump = surface.slope_range()
    rise = np.array([beside, on_bump, beside]) * windows.step_distance / 4  # of the road above a chord, at most
    front, rear = (-static if vehicle.tyre_lift_off else -inf for static in vehicle.static_loads)
    tyres = np.array([[vehicle.front_tyre_stiffness, front], [vehicle.rear_tyre_stiffness, rear]])
    all_peaks = np.array(peaks, order="C")
    road = surface.roughness, surface.layout, excitation.grid.axles, excitation.height
    binding.kink_peaks(*road, loads, highest, tyres, of_bump, windows.ends, rise, all_peaks)
    return all_peaks
