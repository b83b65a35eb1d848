"""What is said of a vehicle that is hardly a car: a whole one's mass on one track, a whole axle's springs."""

from typing import Any

import pytest

from backend.http.openapi import EXAMPLES
from sim_core.comparison.vehicle_cautions import scenario_cautions, vehicle_cautions
from sim_core.scenario import Scenario
from sim_core.scenario.data_sheet import DataSheet
from sim_core.scenario.presets import PRESETS
from sim_core.scenario.vehicles import VEHICLES
from tests import wording


@pytest.mark.parametrize("parts", wording.asked_in("cautions"), ids=str)
def test_what_no_car_has_is_said_at_its_field(parts: dict[str, Any]) -> None:
    """Of the believed car, then of the driven one where it differs; the paper's own sag is told from one's own.

    With a load of half a body the springs alone would give by 150 mm more; with the stop it is
    (27 · 150 + 200 · 50)/(27 + 200) = 61.9 mm.
    """
    cautions = scenario_cautions(Scenario.model_validate(parts))
    wording.check("cautions", parts, [[each.kind, each.field, each.text] for each in cautions])


def test_a_body_at_the_edge_of_what_is_usual_is_not_cautioned() -> None:
    """A typed 0.5 Hz comes back a hair lower or higher: what is written decides."""
    sheet = EXAMPLES["DataSheet"] | {"front_frequency": 0.5, "rear_frequency": 3.0}
    (sag,) = vehicle_cautions(DataSheet.model_validate(sheet).half_car())
    assert sag.kind == "sag"
    assert "(0.5 Hz)" in sag.text


def test_no_vehicle_with_sources_and_no_preset_is_cautioned() -> None:
    vehicles = [*(each.vehicle for each in VEHICLES.values()), *(each.scenario.vehicle for each in PRESETS.values())]
    assert {each.kind for vehicle in vehicles for each in vehicle_cautions(vehicle)} == {"paper_sag"}
