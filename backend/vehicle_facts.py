"""What every answer about a scenario or a vehicle says of the vehicle; no part of what is sent."""

from dataclasses import asdict

from backend.json_types import JsonObject
from sim_core.comparison.vehicle_cautions import vehicle_cautions
from sim_core.scenario import Vehicle, characteristics


def vehicle_facts(vehicle: Vehicle) -> JsonObject:
    """Return a vehicle's characteristics and cautions, plain."""
    return {
        "characteristics": asdict(characteristics(vehicle)),
        "cautions": [asdict(caution) for caution in vehicle_cautions(vehicle)],
    }
