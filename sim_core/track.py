"""A drive over a road, sampled: everything about a run that no suspension changes.

Strategies that drive alike share it: it is made once per road, drive and step, and kept.
"""

from dataclasses import dataclass
from math import ceil

import numpy as np

from sim_core.caching import kept
from sim_core.half_car import DISTURBANCES
from sim_core.longitudinal import Drive, run_in_steps
from sim_core.result import FloatArray
from sim_core.road import profile
from sim_core.scenario import Road


@dataclass(frozen=True, slots=True, eq=False, kw_only=True)
class Track:
    """Control steps from the run-in to the road's end, and what the car meets in each.

    Attributes:
        time: Control instants (steps + 1,) [s], 0 when the front axle is at x = 0.
        fine: Fine steps in each control step.
        position: Of the front axle at the control instants that begin a step (steps,) [m].
        disturbance: Road velocities front and rear [m/s], braking deceleration [m/s^2], each held over a fine step;
            (steps, 3 · fine), fine step after fine step.
        kept: The fine samples on record, from x = 0 to the road's end.
        series: The record's signals that no suspension changes (signals.SIGNALS).
    """

    time: FloatArray
    fine: int
    position: FloatArray
    disturbance: FloatArray
    kept: slice
    series: dict[str, FloatArray]

    @property
    def step(self) -> float:
        """Control step [s]."""
        return float(self.time[1] - self.time[0])

    @property
    def fine_step(self) -> float:
        """Fine step [s]."""
        return self.step / self.fine


@kept(48)
def track(road: Road, wheelbase: float, drive: Drive, step: float, longest_fine_step: float) -> Track:
    """Sample a drive (control step and longest fine step in s, wheelbase in m)."""
    surface, duration = profile(road), drive.time_at(road.length)
    before = run_in_steps(drive.initial_speed, step)
    steps = before + int(duration / step + 1e-6) + 1  # the last one begins at the road's end or before it
    fine = ceil(step / longest_fine_step - 1e-9)
    h = step / fine

    fine_time = h * np.arange(-before * fine, (steps - before) * fine + 1, dtype=np.float64)
    position, speed = drive.at(fine_time)
    front, rear = surface.height(position), surface.height(position - wheelbase)
    braking = drive.sample(drive.braking, fine_time[:-1] + h / 2)
    held = np.stack([np.diff(front) / h, np.diff(rear) / h, braking], axis=-1)

    kept = slice(before * fine, before * fine + int(duration / h + 1e-6) + 1)
    series = {
        "time": fine_time[kept],
        "position": position[kept],
        "speed": speed[kept],
        "front_road": front[kept],
        "rear_road": rear[kept],
        "brake_pressure": drive.sample(drive.pressure, fine_time[kept]),
        "brake_deceleration": drive.sample(drive.braking, fine_time[kept]),
    }
    for values in series.values():
        values.flags.writeable = False
    return Track(
        time=step * np.arange(-before, steps - before + 1, dtype=np.float64),
        fine=fine,
        position=position[:-1:fine],
        disturbance=held.reshape(steps, fine * DISTURBANCES),
        kept=kept,
        series=series,
    )
