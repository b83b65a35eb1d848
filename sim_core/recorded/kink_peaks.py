"""Tyre loads between a recording's samples, where it was driven over the very road of a scenario."""

from collections.abc import Mapping, Sequence
from math import inf

import numpy as np

from sim_core.arrays import FloatArray
from sim_core.metrics.sampled import STEP_TOLERANCE, TimeSpan
from sim_core.road.profile import grid_positions, kinks, road_profile
from sim_core.scenario import Scenario

HEIGHT_TOLERANCE = 1e-4  # recorded heights are the scenario's where none is further off [m]
AXLES = ("front", "rear")


def heights_match(scenario: Scenario, signals: Mapping[str, FloatArray], position: FloatArray) -> tuple[bool, bool]:
    """Check for both axles whether the recorded road heights are the scenario's at those positions (samples,) [m]."""
    surface = road_profile(scenario.road)
    front, rear = (
        f"{axle}_road" in signals
        and bool(np.abs(signals[f"{axle}_road"] - surface.height(position - behind)).max() <= HEIGHT_TOLERANCE)
        for axle, behind in zip(AXLES, (0.0, scenario.rear_axle_offset), strict=True)
    )
    return front, rear


def peaks_at_kinks(
    scenario: Scenario, signals: Mapping[str, FloatArray], sections: Sequence[TimeSpan | None]
) -> FloatArray | None:
    """Return the largest tyre loads where the axles meet kinks of the road between samples, as a run has them.

    A load deviates there from the line between both samples by the tyre's stiffness times the kink's height above the
    road's chord. That is known where the heights under the axles were recorded and are the scenario's.

    Args:
        scenario: Whose road and car.
        signals: Of the recording (samples,), `position` on that road [m] and `time` [s] among them.
        sections: First and last time of each [s]; None for one that was not recorded.

    Returns:
        By section and axle the largest magnitude (sections, 2) [N], 0 of an axle whose heights are not known; None
        where neither's are.
    """
    surface, vehicle = road_profile(scenario.road), scenario.real_vehicle
    peaks, matching = np.zeros((len(sections), len(AXLES))), heights_match(scenario, signals, signals["position"])
    stiffness = vehicle.front_tyre_stiffness, vehicle.rear_tyre_stiffness
    time = signals["time"]
    # A section's end is not told from a kink that is so near [s].
    near = STEP_TOLERANCE * float(np.median(np.diff(time)))
    for axle, behind in enumerate((0.0, scenario.rear_axle_offset)):
        if not matching[axle]:
            continue
        position = signals["position"] - behind
        met = np.concatenate([grid_positions(len(surface.roughness)), kinks(surface.bump)])
        met = met[(met >= position[0]) & (met <= position[-1])]
        at, line, chord = (
            np.interp(met, position, values)
            for values in (time, signals[f"{AXLES[axle]}_tyre_load"], surface.height(position))
        )
        least = -vehicle.static_loads[axle] if vehicle.tyre_lift_off else -inf
        loads = np.maximum(line + stiffness[axle] * (surface.height(met) - chord), least)
        for section, span in enumerate(sections):
            if span is not None:
                inside = (at >= span[0] - near) & (at <= span[1] + near)
                peaks[section, axle] = np.abs(loads[inside]).max(initial=0.0)
    return peaks if any(matching) else None
