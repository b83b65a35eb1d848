"""The drive towards the bump a second time, in small steps; torques by the core's rules (test_fuzzy judges them)."""

from dataclasses import dataclass
from math import tanh

import numpy as np
from numpy.typing import NDArray

from sim_core.scenario import Scenario
from sim_core.speed.fuzzy import torque_rules

Array = NDArray[np.float64]


@dataclass(frozen=True)
class Motion:
    """Position [m], speed [m/s], pressure [Pa] and braking deceleration [m/s^2] every 0.5 ms from the detection on."""

    position: Array
    speed: Array
    pressure: Array
    braking: Array


def brake_to_bump(scenario: Scenario) -> Motion:
    """The drive from detection to the bump, fuzzy alone: Eq. 4-6 and the pressure's lag, explicit steps of 0.5 ms."""
    car, brake, plan = scenario.vehicle, scenario.brake, scenario.speed
    mass = car.body_mass + car.front_wheel_mass + car.rear_wheel_mass
    most = brake.maximum_deceleration * mass * brake.wheel_radius
    k = 2 * brake.friction_coefficient
    rules = torque_rules(scenario.fuzzy)
    target, band = plan.target_speed_kmh / 3.6, 2.5 / 3.6
    h, x = 0.0005, max(0.0, scenario.road.bump.start - plan.detection_distance)
    v, pressure, demand, rows = plan.initial_speed_kmh / 3.6, 0.0, 0.0, []
    for i in range(10**6):
        if x >= scenario.road.bump.start:
            break
        inside = v - target <= band
        if i % 20 == 0:
            share = 0.0 if inside else rules.share((v - target) * 3.6, scenario.road.bump.start - x)
            per_brake = share * most / brake.brakes
            demand = per_brake / (k * brake.effective_radius * brake.piston_area)
        pad = pressure * brake.piston_area
        sliding = v * brake.effective_radius / brake.wheel_radius
        friction = brake.friction_coefficient * pad * tanh(2 * sliding / brake.threshold_speed)
        braking = brake.brakes * 2 * friction * brake.effective_radius / (brake.wheel_radius * mass)
        drag = brake.rolling_resistance * 9.80665 + 1.2 / 2 * brake.drag_area * v * v / mass
        # Inside the band the drive closes the error in half a second, with at most 2 m/s², and never brakes.
        push = min(max(drag + (target - v) / 0.5, 0.0), 2.0) if inside else 0.0
        rows.append((x, v, pressure, braking))
        x += h * v
        v += h * (push - drag - braking)
        pressure += h * (demand - pressure) / brake.pressure_lag
    return Motion(*np.array(rows).T)
