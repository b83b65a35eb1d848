"""Parts of the scenario for what is not ideal; by default everything is, as in the paper."""

from math import copysign
from typing import Annotated, Literal

from sim_core.scenario.damper import scaled
from sim_core.scenario.fields import ADDED, Part, quantity
from sim_core.scenario.road import Seed
from sim_core.scenario.vehicle import Vehicle

StiffnessFactor = Annotated[float, quantity("1", soft=(0.8, 1.2), ge=0.2, le=5)]
HeightNoise = Annotated[float, quantity("m", soft=(0, 0.005), ge=0, le=0.1, shown="mm")]


class Actuator(Part):
    """Suspension actuators; ideal by default, as in the paper."""

    bandwidth: Annotated[float | None, quantity("Hz", soft=(2, 50), ge=0.5, le=1000)] = None
    rate_limit: Annotated[float | None, quantity("N/s", soft=(10_000, 500_000), ge=1000, le=1e8)] = None
    saturation: Annotated[float | None, quantity("N", soft=(500, 10_000), ge=1, le=1_000_000)] = None


class Mismatch(Part):
    """What the real car and the real sensors have other than the controllers believe; nothing by default.

    The controllers, and the speed plan, go by `vehicle`; the car that is driven has these factors on top.
    """

    body_mass: Annotated[float, quantity("1", soft=(0.7, 1.4), ge=0.3, le=3)] = 1
    springs: StiffnessFactor = 1
    damping: Annotated[float, quantity("1", soft=(0.5, 1.5), ge=0.05, le=5)] = 1
    tyres: StiffnessFactor = 1
    rebound_ratio: Annotated[float, quantity("1", soft=(1, 3), ge=0.1, le=10), ADDED] = 1
    preview_offset: Annotated[float, quantity("m", soft=(-0.5, 0.5), ge=-10, le=10)] = 0
    preview_gain: Annotated[float, quantity("1", soft=(0.7, 1.3), ge=0, le=3)] = 1
    preview_noise: HeightNoise = 0
    preview_resolution: Annotated[float, quantity("m", soft=(0, 0.3), ge=0, le=2), ADDED] = 0
    preview_delay: Annotated[float, quantity("s", soft=(0, 0.05), ge=0, le=1)] = 0

    def real(self, vehicle: Vehicle) -> Vehicle:
        """Return the car that is driven: the one that controllers believe in, with these errors."""
        if (self.body_mass, self.springs, self.damping, self.tyres, self.rebound_ratio) == (1, 1, 1, 1, 1):
            return vehicle
        factors = {
            **dict.fromkeys(("body_mass", "pitch_inertia"), self.body_mass),
            **dict.fromkeys(("front_spring", "rear_spring"), self.springs),
            **dict.fromkeys(("front_damping", "rear_damping"), self.damping),
            **dict.fromkeys(("front_tyre_stiffness", "rear_tyre_stiffness"), self.tyres),
            "rebound_ratio": self.rebound_ratio,
        }
        curves = ("front_damper_curve", "rear_damper_curve")
        real = vehicle.model_copy(
            update={
                **{name: getattr(vehicle, name) * factor for name, factor in factors.items()},
                **{name: scaled(getattr(vehicle, name), self.damping) for name in curves},
            }
        )
        real._lowered = _lowered(vehicle, real)
        return real


def _lowered(believed: Vehicle, real: Vehicle) -> tuple[float, float]:
    """Return how much further the real car's weight compresses front and rear suspension than the believed one's [m].

    Springs have the same length without a load, and stops stay where they are: the weight W of the body is borne where
    W = k (sag + x) + k_stop (|x| - clearance) sign x, the last beyond the clearance only.
    """
    clearance, stop = real.bump_stop_clearance, real.bump_stop_stiffness

    def beyond(free: float, spring: float) -> float:
        if clearance is None or abs(free) <= clearance:
            return free
        return copysign((spring * abs(free) + stop * clearance) / (spring + stop), free)

    (believed_front, believed_rear), (front, rear) = believed.body_loads, real.body_loads
    return (
        beyond(front / real.front_spring - believed_front / believed.front_spring, real.front_spring),
        beyond(rear / real.rear_spring - believed_rear / believed.rear_spring, real.rear_spring),
    )


class Estimation(Part):
    """What controllers are told of the car's state: the state itself, or what a Kalman filter makes of sensors."""

    kind: Annotated[Literal["exact", "kalman"], ADDED] = "exact"
    knows_preview: bool = True
    acceleration_noise: Annotated[float, quantity("m/s^2", soft=(0.01, 0.5), ge=1e-4, le=10), ADDED] = 0.05
    deflection_noise: Annotated[float, quantity("m", soft=(0.0001, 0.005), ge=1e-6, le=0.1, shown="mm"), ADDED] = 0.0005
    pitch_rate_noise: Annotated[float, quantity("rad/s", soft=(0.0005, 0.02), ge=1e-6, le=1), ADDED] = 0.002


class Hil(Part):
    """Hardware in the loop: the controller apart from the plant, as `lv_hil` drives it (section 4.2)."""

    bits: Annotated[int, quantity("1", soft=(8, 16), ge=4, le=24)] = 12
    compensation: Literal["predict", "none"] = "predict"
    iterations: Annotated[int, quantity("1", soft=(1, 60), ge=0, le=200)] = 30
    noise: Annotated[float, quantity("1", soft=(0, 0.005), ge=0, le=0.2)] = 0
    jitter: Annotated[float, quantity("s", soft=(0, 0.01), ge=0, le=0.05)] = 0
    packet_loss: Annotated[float, quantity("1", soft=(0, 0.2), ge=0, le=0.9)] = 0
    seed: Seed = 1
