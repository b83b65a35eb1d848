"""Vehicles with their sources: half-cars of one track, made from published data of whole cars.

A whole car's masses and inertia are halved, springs, dampers and tyres are one wheel's, as in the preset
`half_car_consistent`. The data and their sources: vehicles.toml. Derived numbers are rounded to five digits.
"""

import tomllib
from collections.abc import Mapping
from pathlib import Path

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


def _rounded(value: float) -> float:
    return float(f"{value:.5g}")


_TABLE = tomllib.loads(Path(__file__).with_suffix(".toml").read_text(encoding="utf-8"))
VEHICLES = {
    name: VehiclePreset(
        id=name,
        label=entry["label"],
        description=entry["description"],
        vehicle=one_track(entry["whole_car"]),
        sources=tuple(text for source in entry["sources"] for text in _TABLE["sources"][source]),
        derived=(_HALVED_IN_WORDS, *entry.get("derived", ())),
    )
    for name, entry in _TABLE["vehicles"].items()
}
