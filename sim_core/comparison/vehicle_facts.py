"""The facts about a vehicle that stand in every answer about it."""

from dataclasses import asdict
from typing import Any

from sim_core.comparison.vehicle_cautions import vehicle_cautions
from sim_core.scenario import Vehicle, characteristics


def vehicle_facts(vehicle: Vehicle) -> dict[str, Any]:
    """Return a vehicle's `characteristics` and `cautions` as plain values.

    Example:
        >>> from sim_core import Scenario
        >>> from sim_core.comparison.vehicle_facts import vehicle_facts
        >>> list(vehicle_facts(Scenario().vehicle))
        ['characteristics', 'cautions']
    """
    return {
        "characteristics": asdict(characteristics(vehicle)),
        "cautions": [asdict(caution) for caution in vehicle_cautions(vehicle)],
    }
