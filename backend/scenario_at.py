"""The scenario of one point: a plain scenario with some of its fields changed. Runs in workers: no web here."""

from collections.abc import Mapping

from pydantic import ValidationError

from backend.json_types import JsonObject
from sim_core.scenario import SCHEMA_VERSION, Scenario, dotted
from sim_core.scenario.measured import MeasuredRoad
from sim_core.scenario.versions import restored

NO_ROADS: Mapping[str, MeasuredRoad] = {}


def scenario_at(
    base: JsonObject,
    changes: JsonObject,
    schema_version: int = SCHEMA_VERSION,
    roads: Mapping[str, MeasuredRoad] = NO_ROADS,
) -> Scenario:
    """The scenario of one point, on its measured road where `roads` has it.

    Fields have the names they had under that schema version.

    Raises:
        NewerScenarioError: A newer version of Ridelab stored it.
        ValidationError: Its fields contradict each other.
    """
    changed = dotted.with_changes(base, changes)
    current = schema_version == SCHEMA_VERSION
    scenario = Scenario.model_validate(changed) if current else restored(changed, schema_version)
    road = roads.get(scenario.road.profile or "")
    return scenario if road is None else scenario.on(road)


def contradiction(error: ValidationError) -> str:
    """Why the fields of a point contradict each other, as its row's reason."""
    first = error.errors(include_input=False, include_url=False)[0]
    field = first.get("ctx", {}).get("field") or ".".join(map(str, first["loc"]))
    return f"{field}: {first['msg']}" if field else str(first["msg"])
