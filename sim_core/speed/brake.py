"""Brake chain and driving resistances: torque demand -> line pressure -> friction -> deceleration (Eq. 4-6)."""

from dataclasses import dataclass
from math import exp, tanh

from sim_core.scenario import GRAVITY, Brake, Vehicle

AIR_DENSITY = 1.2  # [kg/m^3]


@dataclass(frozen=True, slots=True, kw_only=True)
class BrakeChain:
    """The chain's constants for one car, with Eq. 6's missing fraction bar and Eq. 5's tanh (docs/physics.md).

    `pressure_per_torque` is 1/(k r_b A) of one brake times its share of the torque [Pa/(N·m)];
    `deceleration_per_pressure` [m/s^2/Pa]; `friction_slope` is 2 v_r/v_d per car speed [s/m].
    """

    pressure_per_torque: float
    deceleration_per_pressure: float
    friction_slope: float
    maximum_deceleration: float
    maximum_torque: float
    rolling: float
    air: float
    lag: float

    def deceleration(self, pressure: float, speed: float) -> float:
        """Deceleration by the brakes alone [m/s^2] at a line pressure [Pa] and speed [m/s] (Eq. 4-5)."""
        return self.deceleration_per_pressure * pressure * tanh(self.friction_slope * speed)

    def resistance(self, speed: float) -> float:
        """Deceleration by rolling and air drag [m/s^2]; not part of a_brake."""
        return self.rolling + self.air * speed * speed

    def decay(self, duration: float) -> float:
        """Share of a pressure error that is left after a time [s]: first-order lag."""
        return exp(-duration / self.lag) if self.lag > 0 else 0.0


def brake_chain(brake: Brake, vehicle: Vehicle) -> BrakeChain:
    """The constants for a car: k = 2 µ is the brake factor, so T = 2 µ P A r_b for one brake."""
    mass = vehicle.total_mass
    torque_per_pressure = 2 * brake.friction_coefficient * brake.effective_radius * brake.piston_area
    return BrakeChain(
        pressure_per_torque=1 / (torque_per_pressure * brake.brakes),
        deceleration_per_pressure=brake.brakes * torque_per_pressure / (brake.wheel_radius * mass),
        friction_slope=2 * brake.effective_radius / brake.wheel_radius / brake.threshold_speed,
        maximum_deceleration=brake.maximum_deceleration,
        maximum_torque=brake.maximum_deceleration * brake.wheel_radius * mass,
        rolling=brake.rolling_resistance * GRAVITY,
        air=AIR_DENSITY * brake.drag_area / (2 * mass),
        lag=brake.pressure_lag,
    )
