"""What passes between plant and ECU: the one table of channels and their ranges, and the converters' rounding.

The C header, docs/how-to/hil.md and the loop take the ranges from here.
"""

from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from sim_core import catalogue
from sim_core.arrays import FloatArray
from sim_core.vehicle.half_car import STATES

Codes = NDArray[np.int32]


@dataclass(frozen=True, slots=True, kw_only=True)
class Channel:
    """A measured quantity: `full_scale` is what its converter's last step on either side stands for, in `unit`."""

    key: str
    label: str
    unit: str
    full_scale: float


# Ranges (ours) leave the paper's crossing about a factor of two; a value beyond is clipped, and counted.
SENSORS: tuple[Channel, ...] = (
    Channel(key="front_deflection", label="Suspension deflection, front", unit="m", full_scale=0.15),
    Channel(key="rear_deflection", label="Suspension deflection, rear", unit="m", full_scale=0.15),
    Channel(key="front_tyre_deflection", label="Tyre deflection, front", unit="m", full_scale=0.1),
    Channel(key="rear_tyre_deflection", label="Tyre deflection, rear", unit="m", full_scale=0.1),
    Channel(key="body_velocity", label="Body velocity", unit="m/s", full_scale=2.0),
    Channel(key="pitch_rate", label="Pitch rate", unit="rad/s", full_scale=4.0),
    Channel(key="front_wheel_velocity", label="Wheel velocity, front", unit="m/s", full_scale=4.0),
    Channel(key="rear_wheel_velocity", label="Wheel velocity, rear", unit="m/s", full_scale=4.0),
)
PREVIEW: tuple[Channel, ...] = (
    Channel(key="front_road_velocity", label="Road velocity ahead, front axle", unit="m/s", full_scale=4.0),
    Channel(key="rear_road_velocity", label="Road velocity ahead, rear axle", unit="m/s", full_scale=4.0),
    Channel(key="braking_deceleration", label="Braking deceleration ahead", unit="m/s^2", full_scale=10.0),
)
STAGES = tuple(catalogue.STAGES)  # by the number that stands for each


def highest_code(bits: int) -> int:
    """The last step on either side of zero: codes are -highest to highest, so that zero is exact and both sides alike.

    Args:
        bits: Resolution of the converter.
    """
    return int(2 ** (bits - 1) - 1)


def full_scales(intervals: int) -> FloatArray:
    """Range of each input channel: the states, then each preview channel in every interval (8 + 3 · intervals,)."""
    sensors = [channel.full_scale for channel in SENSORS]
    return np.array(sensors + [channel.full_scale for channel in PREVIEW for _ in range(intervals)])


def convert(values: FloatArray, full_scale: FloatArray | float, bits: int) -> tuple[Codes, int]:
    """Codes of values (…, n) and how many of them were beyond the range; rounds to nearest, clips at the ends."""
    highest = highest_code(bits)
    steps = np.rint(values / full_scale * highest)
    codes = steps.clip(-highest, highest)
    return codes.astype(np.int32), int(np.count_nonzero(codes != steps))


assert len(SENSORS) == STATES  # noqa: S101  # the sensors measure the state, one each
