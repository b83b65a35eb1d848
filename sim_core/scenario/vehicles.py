"""Vehicles with their sources: half-cars of one track, made from published data of whole cars.

A whole car's masses and inertia are halved, springs, dampers and tyres are one wheel's, as in the preset
`half_car_consistent`. The data and their sources: vehicles.toml. Derived numbers are rounded to five digits.
"""

import tomllib
from collections.abc import Mapping
from dataclasses import dataclass
from pathlib import Path
from typing import Any

from sim_core.scenario.vehicle import Vehicle

Pair = tuple[float, float]
_HALVED = "Masses and inertia are half the whole car's, an axle's mass half its two wheels'"


@dataclass(frozen=True, slots=True, kw_only=True)
class VehiclePreset:
    """A vehicle with a name, where its numbers are from, and how those follow that no source has."""

    id: str
    label: str
    description: str
    vehicle: Vehicle
    sources: tuple[str, ...]
    derived: tuple[str, ...]


def one_track(
    *,
    body_mass: float,
    pitch_inertia: float,
    cg_height: float,
    cg_to_axles: Pair,
    axle_masses: Pair,
    springs: Pair,
    damping: Pair,
    tyres: Pair,
    rebound_ratio: float = 1,
) -> Vehicle:
    """Return half of a whole car: its left or right track. Pairs are of the front and of the rear axle.

    Args:
        body_mass: Sprung mass of the whole car [kg].
        pitch_inertia: Of the whole body about its pitch axis [kg m^2].
        cg_height: Of the body's centre of gravity above the road [m].
        cg_to_axles: From the centre of gravity to both axles [m].
        axle_masses: Unsprung masses, of both wheels [kg].
        springs: Of one wheel [N/m].
        damping: Of one wheel [N s/m].
        tyres: Stiffness of one [N/m].
        rebound_ratio: Damping in rebound over that in compression.
    """
    half = {"body_mass": body_mass / 2, "pitch_inertia": pitch_inertia / 2}
    values = {**half, "cg_height": cg_height, "rebound_ratio": rebound_ratio}
    for name, (front, rear) in {
        "cg_to_{}": cg_to_axles,
        "{}_wheel_mass": (axle_masses[0] / 2, axle_masses[1] / 2),
        "{}_spring": springs,
        "{}_damping": damping,
        "{}_tyre_stiffness": tyres,
    }.items():
        values |= {name.format("front"): front, name.format("rear"): rear}
    return Vehicle.model_validate({name: _rounded(value) for name, value in values.items()})


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


def _preset(
    name: str, entry: dict[str, Any], sources: dict[str, list[str]], earlier: Mapping[str, VehiclePreset]
) -> VehiclePreset:
    """Return the vehicle that an entry of vehicles.toml describes."""
    vehicle = (
        loaded(earlier[entry["empty"]].vehicle, *entry["load"]) if "load" in entry else one_track(**entry["whole_car"])
    )
    return VehiclePreset(
        id=name,
        label=entry["label"],
        description=entry["description"],
        vehicle=vehicle,
        sources=tuple(text for source in entry["sources"] for text in sources[source]),
        derived=(_HALVED, *entry.get("derived", ())),
    )


def _vehicles() -> dict[str, VehiclePreset]:
    data = tomllib.loads(Path(__file__).with_suffix(".toml").read_text(encoding="utf-8"))
    found: dict[str, VehiclePreset] = {}
    for name, entry in data["vehicles"].items():
        found[name] = _preset(name, entry, data["sources"], found)
    return found


VEHICLES = _vehicles()
