"""What is said of a vehicle that is hardly a car: a whole one's mass on one track, a whole axle's springs."""

from typing import Any

import pytest

from sim_core.comparison.vehicle_cautions import vehicle_cautions
from sim_core.scenario import Vehicle
from sim_core.scenario.presets import PRESETS
from sim_core.scenario.vehicles import VEHICLES

SOFT = {"front_spring": 20_000, "rear_spring": 20_000}


@pytest.mark.parametrize(
    ("values", "expected", "said"),
    [
        ({"body_mass": 2400}, [("sag", "vehicle.body_mass")], "is the body mass a whole car's?"),
        ({"body_mass": 1271}, [("sag", "vehicle.front_spring")], "301 mm at the front axle; usual"),
        ({"rear_spring": 12_000}, [("sag", "vehicle.body_mass")], "362 mm at the rear axle; usual"),
        (
            {"body_mass": 9000, **SOFT},
            [("sag", "vehicle.body_mass"), ("body_frequency", "vehicle.body_mass")],
            "0.28 Hz at the front axle",
        ),
        (
            {"body_mass": 250, "front_spring": 150_000, "rear_spring": 20_000},
            [("body_frequency", "vehicle.front_spring")],
            "3.9 Hz at the front axle; usual is 0.5 to 3 Hz. Masses, springs and dampers are of one track, half of the "
            "car: are the springs a whole axle's?",
        ),
        ({"front_spring": 45_000}, [], ""),
    ],
)
def test_sag_and_natural_frequencies_beyond_a_cars_are_said_at_their_field(
    values: dict[str, Any], expected: list[tuple[str, str]], said: str
) -> None:
    cautions = vehicle_cautions(Vehicle(**values))
    assert [(each.kind, each.field) for each in cautions] == expected
    assert said in " ".join(each.text for each in cautions)
    assert all("paper" not in each.text for each in cautions)


def test_the_papers_own_sag_is_told_from_ones_own() -> None:
    """Whatever else is changed: what decides is the body, its springs and its centre of gravity."""
    for vehicle in (Vehicle(), Vehicle(front_damping=3000, rear_spring=31_000)):
        (caution,) = vehicle_cautions(vehicle)
        assert (caution.kind, caution.field) == ("paper_sag", "vehicle.front_spring")
        assert caution.text.endswith("These are the paper's own values (Table 2).")


def test_no_vehicle_with_sources_and_no_preset_is_cautioned() -> None:
    vehicles = [*(each.vehicle for each in VEHICLES.values()), *(each.scenario.vehicle for each in PRESETS.values())]
    assert {each.kind for vehicle in vehicles for each in vehicle_cautions(vehicle)} == {"paper_sag"}
