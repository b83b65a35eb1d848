"""What there is to choose from, as plain JSON: the scenario's schema, the catalogue, strategies, presets, vehicles."""

from dataclasses import asdict
from typing import Any

from sim_core import catalogue as names
from sim_core.comparison.vehicle_cautions import vehicle_facts
from sim_core.scenario import SCHEMA_VERSION, Scenario
from sim_core.scenario.data_sheet import DataSheet
from sim_core.scenario.presets import PRESETS
from sim_core.scenario.vehicles import VEHICLES
from sim_core.strategies import STRATEGIES

Json = dict[str, Any]
_QUANTITIES = ("signals", "windows", "statistics", "stages", "comfort", "events", "run_figures", "references")


def schema() -> Json:
    """Return the scenario's JSON Schema with its version, and beside it that of a data sheet."""
    beside = {"schema_version": SCHEMA_VERSION, "data_sheet": DataSheet.model_json_schema()}
    return {**Scenario.model_json_schema(), **beside}


def catalogue() -> Json:
    """Return everything that has a name and a unit, and which signals have metrics and which the paper compares."""
    keys = {"metric_signals": list(names.METRIC_SIGNALS), "paper_signals": list(names.PAPER_SIGNALS)}
    lists = {name: getattr(names, name.upper()) for name in _QUANTITIES}
    return {name: [asdict(each) for each in items.values()] for name, items in lists.items()} | keys


def strategies() -> list[Json]:
    """Return the id and the label of every strategy of ours."""
    return [{"id": each.id, "label": each.label} for each in STRATEGIES.values()]


def presets() -> list[Json]:
    """Return every preset, the paper's first."""
    return [each.model_dump(mode="json") for each in PRESETS.values()]


def vehicles() -> list[Json]:
    """Return every vehicle with its sources, characteristics and cautions."""
    return [each.model_dump(mode="json") | vehicle_facts(each.vehicle) for each in VEHICLES.values()]
