"""Vehicles with their sources: half-cars of one track, made from published data of whole cars.

A whole car's masses and inertia are halved, springs, dampers and tyres are one wheel's, as in the preset
`half_car_consistent`. The data and their sources: vehicles.toml. Derived numbers are rounded to five digits.
"""

import tomllib
from collections.abc import Mapping
from pathlib import Path
from typing import Any

from pydantic import BaseModel

from sim_core.scenario.vehicle import Vehicle

_HALVED = "body_mass", "pitch_inertia", "front_wheel_mass", "rear_wheel_mass"
_HALVED_IN_WORDS = "Masses and inertia are half the whole car's, an axle's mass half its two wheels'"


class VehiclePreset(BaseModel, frozen=True):
    """A vehicle with a name, where its numbers are from, and how those follow that no source has."""

    id: str
    label: str
    description: str
    vehicle: Vehicle
    sources: tuple[str, ...]
    derived: tuple[str, ...]


def one_track(whole_car: Mapping[str, float]) -> Vehicle:
    """Return half of a whole car: its left or right track.

    Args:
        whole_car: Fields of `Vehicle` in their units; masses of body and wheels, and pitch inertia, of both tracks.
    """
    half = {name: _rounded(value / 2 if name in _HALVED else value) for name, value in whole_car.items()}
    return Vehicle.model_validate(half)


def loaded(vehicle: Vehicle, mass: float, behind_front_axle: float, length: float) -> Vehicle:
    """Return the vehicle with a load spread evenly along its body, at the height of the body's centre of gravity.

    Centre of gravity and pitch inertia are those of both bodies together (parallel axis theorem).

    Args:
        vehicle: Without it.
        mass: Of the load [kg].
        behind_front_axle: Where its middle is [m].
        length: Over which it is spread [m].
    """
    total = vehicle.body_mass + mass
    to_front = (vehicle.body_mass * vehicle.cg_to_front + mass * behind_front_axle) / total
    distance = behind_front_axle - vehicle.cg_to_front
    inertia = vehicle.pitch_inertia + vehicle.body_mass * mass / total * distance**2 + mass * length**2 / 12
    changes = {
        "body_mass": total,
        "pitch_inertia": inertia,
        "cg_to_front": to_front,
        "cg_to_rear": vehicle.wheelbase - to_front,
    }
    return vehicle.model_copy(update={name: _rounded(value) for name, value in changes.items()})


def _rounded(value: float) -> float:
    return float(f"{value:.5g}")


def _vehicles() -> dict[str, VehiclePreset]:
    data: dict[str, Any] = tomllib.loads(Path(__file__).with_suffix(".toml").read_text(encoding="utf-8"))
    presets: dict[str, VehiclePreset] = {}
    for name, entry in data["vehicles"].items():
        if "load" in entry:
            vehicle = loaded(presets[entry["empty"]].vehicle, *entry["load"])
        else:
            vehicle = one_track(entry["whole_car"])
        presets[name] = VehiclePreset(
            id=name,
            label=entry["label"],
            description=entry["description"],
            vehicle=vehicle,
            sources=tuple(text for source in entry["sources"] for text in data["sources"][source]),
            derived=(_HALVED_IN_WORDS, *entry.get("derived", ())),
        )
    return presets


VEHICLES = _vehicles()
