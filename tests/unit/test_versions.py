"""Stored scenarios of older schema versions become today's, a step at a time."""

import json
from pathlib import Path
from typing import Any

import pytest

from sim_core.scenario import SCHEMA_VERSION, Scenario
from sim_core.scenario.versions import STEPS, NewerScenarioError, restored, upgraded

SCENARIOS = Path(__file__).parents[1] / "data" / "scenarios_of_releases.json"  # of 0.4.0: faults/test_release.py
RELEASES: dict[str, list[dict[str, Any]]] = json.loads(SCENARIOS.read_text())


@pytest.mark.parametrize("newer", [SCHEMA_VERSION + 1, SCHEMA_VERSION + 100])
def test_a_newer_version_is_refused_and_named(newer: int) -> None:
    with pytest.raises(NewerScenarioError, match=rf"schema version {newer}\b.*1 to {SCHEMA_VERSION}\b"):
        upgraded({}, newer)


def test_there_is_a_step_for_every_version() -> None:
    assert set(STEPS) == set(range(1, SCHEMA_VERSION))


@pytest.mark.parametrize(
    ("stored", "version", "told"),
    [
        ({"estimation": {"kind": "kalman", "acceleration_noise": 0.1}}, 1, False),
        ({"estimation": {"kind": "exact"}}, 1, False),  # a sweep or an edit may make it estimated
        ({}, 1, False),
        ({"estimation": {"kind": "kalman"}}, 2, True),
        ({}, 2, True),
        ({"estimation": {"knows_preview": True}}, 1, True),  # a link's answer names the version it was stored under
    ],
)
def test_filters_stored_until_0_3_0_are_told_of_no_preview(stored: dict[str, Any], version: int, told: bool) -> None:
    before = json.dumps(stored)
    scenario = restored(stored, version)
    assert scenario.estimation.knows_preview == told
    assert scenario == Scenario.model_validate({**stored, "estimation": scenario.estimation.model_dump()})
    assert json.dumps(stored) == before


@pytest.mark.parametrize("version", RELEASES)
def test_scenarios_of_a_release_are_read_with_every_value_they_had(version: str) -> None:
    assert RELEASES[version]
    for run in RELEASES[version]:
        stored = run["scenario"]
        assert _part_of(restored(stored, run["schema_version"]).model_dump(mode="json"), stored) == stored


def _part_of(value: Any, shape: Any) -> Any:
    """The members of `value` that `shape` has too."""
    return {name: _part_of(value[name], each) for name, each in shape.items()} if isinstance(shape, dict) else value


def test_a_field_that_changes_nothing_is_no_part_of_a_scenarios_identity() -> None:
    """Release 0.2.0 knew fewer fields: what no step of the schema adds leaves the identity as it was."""
    for run in RELEASES["0.2.0"]:
        stored, version = run["scenario"], run["schema_version"]
        identity = restored(stored, version).identity()
        assert identity == upgraded(stored, version), "a new field, neither of a step nor marked ADDED"
