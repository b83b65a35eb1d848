"""What is said of a vehicle that is hardly a car: a whole one's mass on one track, a whole axle's springs."""

from typing import Any

import pytest

from backend.http.openapi import EXAMPLES
from sim_core.comparison.vehicle_cautions import scenario_cautions, vehicle_cautions
from sim_core.scenario import Scenario, Vehicle
from sim_core.scenario.data_sheet import DataSheet
from sim_core.scenario.presets import PRESETS
from sim_core.scenario.vehicles import VEHICLES

SOFT = {"front_spring": 20_000, "rear_spring": 20_000}
SAG, FREQUENCY = ("sag", "vehicle.body_mass"), ("body_frequency", "vehicle.body_mass")


@pytest.mark.parametrize(
    ("values", "expected", "said"),
    [
        ({"body_mass": 2400}, [SAG], "by 568 mm at the front axle (0.63 Hz)"),
        ({"body_mass": 1271}, [("sag", "vehicle.front_spring")], "301 mm at the front axle (0.87 Hz)"),
        ({"rear_spring": 12_000}, [SAG], "362 mm at the rear axle (0.81 Hz)"),
        ({"body_mass": 9000, **SOFT}, [SAG, FREQUENCY], "0.28 Hz at the front axle"),
        (
            {"body_mass": 250, "front_spring": 150_000, "rear_spring": 20_000},
            [("body_frequency", "vehicle.front_spring")],
            "3.9 Hz at the front axle",
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


def test_a_body_at_the_edge_of_what_is_usual_is_not_cautioned() -> None:
    """A typed 0.5 Hz comes back a hair lower or higher: what is written decides."""
    sheet = EXAMPLES["DataSheet"] | {"front_frequency": 0.5, "rear_frequency": 3.0}
    (sag,) = vehicle_cautions(DataSheet.model_validate(sheet).half_car())
    assert sag.kind == "sag"
    assert "(0.5 Hz)" in sag.text


def test_the_papers_own_sag_is_told_from_ones_own() -> None:
    """Whatever else is changed: what decides is the body, its springs and its centre of gravity."""
    for vehicle in (Vehicle(), Vehicle(front_damping=3000, rear_spring=31_000)):
        (caution,) = vehicle_cautions(vehicle)
        assert (caution.kind, caution.field) == ("paper_sag", "vehicle.front_spring")
        assert caution.text.endswith("These are the paper's own values (Table 2).")


STIFF = {"front_spring": 45_000, "rear_spring": 45_000}
PAPERS, LOADED = ("paper_sag", "vehicle.front_spring"), ("sag", "mismatch.body_mass")
STOPS = ("rests_on_stops", "vehicle.bump_stop_clearance")


@pytest.mark.parametrize(
    ("vehicle", "mismatch", "expected"),
    [
        (STIFF, {"body_mass": 2}, [LOADED]),
        (STIFF, {"springs": 0.5}, [("sag", "mismatch.springs")]),
        ({}, {"body_mass": 1.1}, [PAPERS, LOADED]),
        ({}, {"damping": 0.5, "tyres": 1.2}, [PAPERS]),  # what is equal of both is said once
        ({}, {"body_mass": 0.5}, [PAPERS]),
        ({"bump_stop_clearance": 0.05}, {"body_mass": 1.5}, [PAPERS, LOADED, STOPS]),
        ({**STIFF, "bump_stop_clearance": 0.2}, {"body_mass": 1.05}, []),
        ({**STIFF, "body_mass": 400}, {"springs": 3}, [("body_frequency", "mismatch.springs")]),
    ],
)
def test_the_driven_cars_own_values_are_said_beside_the_believed_ones(
    vehicle: dict[str, Any], mismatch: dict[str, Any], expected: list[tuple[str, str]]
) -> None:
    cautions = scenario_cautions(Scenario.model_validate({"vehicle": vehicle, "mismatch": mismatch}))
    assert [(each.kind, each.field) for each in cautions] == expected


def test_a_car_that_rests_on_its_stops_sags_less_than_its_springs_alone_would() -> None:
    loaded = {"vehicle": {"bump_stop_clearance": 0.05}, "mismatch": {"body_mass": 1.5}}
    _, sag, stops = scenario_cautions(Scenario.model_validate(loaded))
    # 150 mm more on the springs alone; with the stop (27 · 150 + 200 · 50)/(27 + 200) = 61.9 mm.
    assert "by 362 mm at the front axle" in sag.text
    assert "by 12 mm at the front axle" in stops.text


def test_no_vehicle_with_sources_and_no_preset_is_cautioned() -> None:
    vehicles = [*(each.vehicle for each in VEHICLES.values()), *(each.scenario.vehicle for each in PRESETS.values())]
    assert {each.kind for vehicle in vehicles for each in vehicle_cautions(vehicle)} == {"paper_sag"}
