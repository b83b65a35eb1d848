"""Stored scenarios of older schema versions, brought to today's a step at a time.

A field that is new with a default under which nothing computes otherwise needs no step: its type is marked `ADDED`,
so that no result is known by another key for it. Everything else does (a field renamed, moved, dropped, in another
unit, with tighter limits or another default): raise `SCHEMA_VERSION`, add the step here and leave a database of the old
version as a fixture (tests/data/release.py).
"""

import copy
from collections.abc import Callable, Mapping
from typing import Any

from sim_core.errors import RidelabError
from sim_core.scenario import SCHEMA_VERSION, Scenario

Step = Callable[[dict[str, Any]], dict[str, Any]]


def _with_unaided_filter(scenario: dict[str, Any]) -> dict[str, Any]:
    """Return a scenario of version 1, of core 0.3.0 and before, whose filter was never told of a preview."""
    return {**scenario, "estimation": {"knows_preview": False, **scenario.get("estimation", {})}}


# Version -> the step from it to the next one. The page (frontend/src/scenario/versions.ts) and the command line
# (client/ridelab/cli/targets.py) take the same steps with what they have stored.
STEPS: Mapping[int, Step] = {1: _with_unaided_filter}


class NewerScenarioError(RidelabError):
    """A newer version of Ridelab stored the scenario; this one cannot know what it means."""


def upgraded(
    scenario: Mapping[str, Any], version: int, *, steps: Mapping[int, Step] = STEPS, current: int = SCHEMA_VERSION
) -> dict[str, Any]:
    """Return a stored scenario as the current schema version writes it; what was passed in stays as it is.

    Args:
        scenario: As it was stored, plain JSON values.
        version: The schema version it was stored under.
        steps: Version -> the step from it to the next one; each may change what it is given.
        current: The version to reach.

    Raises:
        NewerScenarioError: The version is newer than `current`.
    """
    if version > current:
        raise NewerScenarioError(
            f"This scenario has schema version {version}, and this version of Ridelab knows 1 to {current}: "
            "a newer one is needed to read it"
        )
    content: dict[str, Any] = dict(scenario) if version == current else copy.deepcopy(dict(scenario))
    for step in range(version, current):
        content = steps[step](content)
    return content


def restored(scenario: Mapping[str, Any], version: int) -> Scenario:
    """Return the same as today's `Scenario`, complete: what has been added since takes its default.

    Raises:
        NewerScenarioError: The version is newer than today's.
        ValidationError: A step is missing or wrong; the fixtures of every version are tested against this.
    """
    return Scenario.model_validate(upgraded(scenario, version))
