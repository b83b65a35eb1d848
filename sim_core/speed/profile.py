"""The car's speed along the road: constant, or planned by a fuzzy controller towards the bump (section 3.1, Figure 8).

It depends on nothing vertical, so it is made once per road and shared by every strategy that drives it.
"""

from collections.abc import Iterable
from dataclasses import dataclass
from functools import lru_cache
from math import ceil
from typing import Literal

import numpy as np

from sim_core.arrays import FloatArray
from sim_core.caching import cached, small_cached
from sim_core.kernel.binding import plan_speed
from sim_core.road.profile import RUN_IN
from sim_core.scenario import Brake, Fuzzy, Scenario, Speed
from sim_core.scenario.parts import KMH
from sim_core.speed.brake import brake_chain, pressure_decay
from sim_core.speed.fuzzy import torque_rules

SpeedPlan = Literal["planned", "constant"]  # whether the car slows down for the bump
TARGET_BAND = 2.5 * KMH  # half width of the band the paper aims at, 20 to 25 km/h [m/s]
SPEED_CONTROL_PERIOD = 0.01  # period of the speed controller [s]
ENGINE_TIME_CONSTANT = 0.5  # with which the engine closes a speed error [s] (ours)
ENGINE_ACCELERATION = 2.0  # it gives at most [m/s^2] (ours)
# A place so little ahead of the car counts as reached [m]: far more than rounding, which differs between processors,
# and far less than changes a metric. Otherwise a step that meets a place exactly reaches it on some processors only.
POSITION_TOLERANCE = 1e-9


@dataclass(frozen=True, slots=True, eq=False, kw_only=True)
class SpeedProfile:
    """Speed over time: samples every SPEED_CONTROL_PERIOD from the detection to the bump's end, constant around them.

    `time` counts from x = 0 [s]; before the first sample the car holds the initial speed, after the last its own.
    """

    initial_speed: float
    time: FloatArray
    position: FloatArray
    speed: FloatArray
    pressure: FloatArray
    braking: FloatArray

    def at(self, time: FloatArray) -> tuple[FloatArray, FloatArray]:
        """Return position [m] and speed [m/s] at times [s] of any shape: cubic Hermite between samples."""
        t0, t1 = self.time[0], self.time[-1]
        inside = np.clip(time, t0, t1)
        step = self.time[1] - t0
        place = (inside - t0) / step
        i = np.minimum(place.astype(np.intp), len(self.time) - 2)
        s = place - i
        v0, v1 = self.speed[i], self.speed[i + 1]
        x0, x1 = self.position[i], self.position[i + 1]
        position = x0 + s * s * (3 - 2 * s) * (x1 - x0) + step * s * (1 - s) * ((1 - s) * v0 - s * v1)
        before, after = np.minimum(time - t0, 0.0), np.maximum(time - t1, 0.0)
        position = position + before * self.speed[0] + after * self.speed[-1]
        return position, v0 + s * (v1 - v0)

    def sample(self, values: FloatArray, time: FloatArray) -> FloatArray:
        """Return one of the sampled columns at times [s], linear in between; its end values outside."""
        return np.interp(time, self.time, values)

    def time_at(self, position: float) -> float:
        """Return when the front axle is at a position [m] [s]."""
        return _time_at(self, position)

    def control_steps(self, road_length: float, step: float) -> tuple[int, int]:
        """Return the control steps [s each] before x = 0 and in all; the last begins before the road's end [m]."""
        run_in_steps = ceil(RUN_IN / (self.initial_speed * step))
        return run_in_steps, run_in_steps + int(self.time_at(road_length) / step + 1e-6) + 1


@lru_cache(maxsize=32)
def _time_at(profile: SpeedProfile, position: float) -> float:
    """Return the inverse of `SpeedProfile.at`, kept: every run with that profile asks for the same few places."""
    if position <= profile.position[0]:
        return float(profile.time[0] + (position - profile.position[0]) / profile.speed[0])
    if position >= profile.position[-1]:
        return float(profile.time[-1] + (position - profile.position[-1]) / profile.speed[-1])
    i = int(np.searchsorted(profile.position, position)) - 1
    x0, x1 = float(profile.position[i]), float(profile.position[i + 1])
    v0, v1 = float(profile.speed[i]), float(profile.speed[i + 1])
    step = float(profile.time[1] - profile.time[0])
    low, high = 0.0, 1.0
    for _ in range(50):  # bisection: the cubic of `at` is monotonic here
        s = (low + high) / 2
        reached = x0 + s * s * (3 - 2 * s) * (x1 - x0) + step * s * (1 - s) * ((1 - s) * v0 - s * v1)
        low, high = (s, high) if reached < position else (low, s)
    return float(profile.time[i]) + step * high


def make_speed_profile(scenario: Scenario, plan: SpeedPlan) -> SpeedProfile:
    """Return how fast the scenario's road is driven, and where the car is when."""
    if plan == "constant":
        return _constant(scenario.speed.initial)
    places = scenario.braking_start, scenario.bump_start, scenario.bump_left
    return _planned(scenario.speed, scenario.fuzzy, scenario.brake, scenario.vehicle.total_mass, *places)


@small_cached(256)
def _constant(speed: float) -> SpeedProfile:
    time, none = np.array([0.0, SPEED_CONTROL_PERIOD]), np.zeros(2)
    return _profile(speed, time, (time * speed, np.full(2, speed), none, none))


@cached
def _planned(
    speed: Speed, fuzzy: Fuzzy, brake: Brake, mass: float, detection: float, bump_start: float, bump_end: float
) -> SpeedProfile:
    """Step the speed controller and the brake chain from the detection until the rear axle has left the bump.

    Per period: the fuzzy torque sets the pressure demand (zero inside the target band, where the engine holds the
    target instead), the pressure follows with its lag exactly, speed by the midpoint rule. On the bump the car
    coasts; only if it would fall below the band does the engine keep it moving.

    Args:
        speed: Initial and target speed, and which controller.
        fuzzy: Its rules.
        brake: The brake chain.
        mass: Of the car [kg].
        detection: Where the front axle is when the bump is detected [m].
        bump_start: Where the front axle meets the bump [m].
        bump_end: Where it is when the rear one has left it [m].
    """
    h, initial = SPEED_CONTROL_PERIOD, speed.initial
    plan = (
        *(*brake_chain(brake, mass), min(speed.target, initial), TARGET_BAND, bump_start, bump_end, POSITION_TOLERANCE),
        *(h, pressure_decay(brake, h / 2), pressure_decay(brake, h)),
        *(speed.controller == "guarded", KMH, ENGINE_TIME_CONSTANT, ENGINE_ACCELERATION),
    )
    rows = plan_speed(torque_rules(fuzzy).prepared, np.array(plan, dtype=np.float64), detection, initial)
    table = np.ascontiguousarray(rows.T)
    table[2:, -1] = 0.0  # from here on the engine holds the speed, the brakes are off
    time = detection / initial + h * np.arange(table.shape[1], dtype=np.float64)
    return _profile(initial, time, table)


def _profile(initial_speed: float, time: FloatArray, columns: Iterable[FloatArray]) -> SpeedProfile:
    position, speed, pressure, braking = columns
    return SpeedProfile(
        initial_speed=initial_speed, time=time, position=position, speed=speed, pressure=pressure, braking=braking
    )
