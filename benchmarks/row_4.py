"""The half-car as Eq. 7 of the paper is printed: its row 4 has C_s1 and u_1 under the rear wheel.

Table 2's C_s1 and C_s2 are equal, so that only the force differs.
"""

from dataclasses import replace
from unittest import mock

from backend.compute.memory import keep_freed_memory
from sim_core.scenario import Vehicle
from sim_core.vehicle.half_car import LinearModel, half_car


def printed_half_car(vehicle: Vehicle) -> LinearModel:
    """Return the model of a vehicle with u_1 in the rear wheel's row in place of u_2.

    Raises:
        ValueError: Its dampers differ.
    """
    if vehicle.front_damping != vehicle.rear_damping:
        raise ValueError("Dampers are equal, as in Table 2")
    model = half_car(vehicle)
    B = model.B.copy()
    B[-1] = B[-1, ::-1]
    return replace(model, B=B)


def drive_as_printed() -> None:
    """Make the car, and what controllers know of it, the printed one: from this process' beginning to its end."""
    keep_freed_memory()
    for module in ("half_car", "plant"):
        mock.patch(f"sim_core.vehicle.{module}.half_car", printed_half_car).start()
