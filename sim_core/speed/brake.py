"""Brake chain and driving resistances: torque demand -> line pressure -> friction -> deceleration (Eq. 4-6)."""

from math import exp

from sim_core.scenario import Brake
from sim_core.scenario.vehicle import GRAVITY

AIR_DENSITY = 1.2  # [kg/m^3]


def brake_chain(brake: Brake, mass: float) -> tuple[float, ...]:
    """Return the numbers that `struct plan` of kernel/speed.c begins with (8,).

    With Eq. 6's missing fraction bar and Eq. 5's tanh (docs/explanation/fuzzy-drive.md): k = 2 µ is the brake factor,
    so T = 2 µ P A r_b for one brake. Decelerations by rolling and by air drag are no part of a_brake.

    Args:
        brake: The chain.
        mass: Of the car, wheels included [kg].
    """
    torque_per_pressure = 2 * brake.friction_coefficient * brake.effective_radius * brake.piston_area
    return (
        1 / (torque_per_pressure * brake.brakes),  # of one brake times its share of the torque [Pa/(N·m)]
        brake.maximum_deceleration,
        brake.maximum_deceleration * brake.wheel_radius * mass,  # greatest torque [N·m]
        brake.pressure_lag,
        brake.brakes * torque_per_pressure / (brake.wheel_radius * mass),  # deceleration of a pressure [m/s^2/Pa]
        2 * brake.effective_radius / brake.wheel_radius / brake.threshold_speed,  # slope of the friction [s/m]
        brake.rolling_resistance * GRAVITY,  # deceleration by rolling [m/s^2]
        AIR_DENSITY * brake.drag_area / (2 * mass),  # that by air drag, of the speed's square [1/m]
    )


def pressure_decay(brake: Brake, duration: float) -> float:
    """Return the share of a pressure error that is left after a time [s]: first-order lag."""
    return exp(-duration / brake.pressure_lag) if brake.pressure_lag > 0 else 0.0
