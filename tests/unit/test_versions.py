"""Stored scenarios of older schema versions become today's, a step at a time."""

import json
from typing import Any

import pytest

from sim_core.scenario import SCHEMA_VERSION
from sim_core.scenario.versions import STEPS, NewerScenarioError, restored, upgraded
from tests.data import release


def renamed(scenario: dict[str, Any]) -> dict[str, Any]:
    scenario["road"]["height_m"] = scenario["road"].pop("height") / 1000
    return scenario


def nested(scenario: dict[str, Any]) -> dict[str, Any]:
    return {**scenario, "road": {"bump": {"height": scenario["road"]["height_m"]}}}


CHAIN = {1: renamed, 2: nested}


def test_every_step_from_the_stored_version_is_taken_once_and_in_order() -> None:
    first = {"road": {"height": 100}}
    assert upgraded(first, 1, steps=CHAIN, current=3) == {"road": {"bump": {"height": 0.1}}}
    assert upgraded({"road": {"height_m": 0.1}}, 2, steps=CHAIN, current=3) == {"road": {"bump": {"height": 0.1}}}
    assert upgraded(first, 1, steps=CHAIN, current=2) == {"road": {"height_m": 0.1}}


@pytest.mark.parametrize("newer", [SCHEMA_VERSION + 1, SCHEMA_VERSION + 100])
def test_a_newer_version_is_refused_and_named(newer: int) -> None:
    with pytest.raises(NewerScenarioError, match=rf"schema version {newer}\b.*1 to {SCHEMA_VERSION}\b"):
        upgraded({}, newer)


def test_there_is_a_step_for_every_version() -> None:
    assert set(STEPS) == set(range(1, SCHEMA_VERSION))


def test_scenarios_of_release_0_2_0_are_valid_today() -> None:
    runs = release.content()["tables"]["runs"]
    assert runs
    for run in runs:
        scenario = restored(json.loads(run["scenario"]), run["schema_version"])
        assert scenario.identity() == json.loads(run["scenario"]), "a new field, not among its part's ADDED"
