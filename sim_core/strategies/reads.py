"""Which of the scenario's fields a strategy's result depends on: those of every run, and its controller's own."""

from collections.abc import Sequence
from functools import cache

from pydantic import BaseModel

from sim_core.control.controller import Controller, ScenarioField
from sim_core.scenario import Scenario
from sim_core.speed.profile import SpeedPlan

EVERY_RUN = (
    "vehicle",
    "road",
    "speed.initial_speed_kmh",
    "mpc.deflection_limit",
    "mismatch.body_mass",
    "mismatch.springs",
    "mismatch.damping",
    "mismatch.tyres",
    "mismatch.rebound_ratio",
)
SPEED_PLAN = ("speed.target_speed_kmh", "speed.detection_distance", "speed.controller", "fuzzy", "brake")
ACTUATORS = (
    "actuator",
    "estimation.kind",
    "estimation.acceleration_noise",
    "estimation.deflection_noise",
    "estimation.pitch_rate_noise",
    "mpc.sample_time",
    "mpc.force_limit",
)
PREVIEW = (
    "estimation.knows_preview",
    "mismatch.preview_offset",
    "mismatch.preview_gain",
    "mismatch.preview_noise",
    "mismatch.preview_resolution",
    "mismatch.preview_delay",
    "mpc.expected_offset",
    "mpc.expected_noise",
)


def fields_read(strategy: type[Controller], plan: SpeedPlan) -> tuple[str, ...]:
    """Dotted names of the parts and fields that its result depends on at that speed plan; on nothing else.

    The speed policy, which decides the plan, is not among them.
    """
    declared = {name: each.name for name, each in strategy.declared.items() if isinstance(each, ScenarioField)}
    names = [*EVERY_RUN, *declared.values()]
    if strategy.actuated:
        names += ACTUATORS
    if "preview" in declared:
        names += PREVIEW
    if plan == "planned":
        names += SPEED_PLAN
    return tuple(sorted(_whole_parts(names)))


def _whole_parts(names: Sequence[str]) -> set[str]:
    """The same fields, with a part's name in place of those of all its fields."""
    left = set(names)
    for part, own in parts().items():
        if left >= own:
            left = left - own | {part}
    return left


@cache
def parts() -> dict[str, set[str]]:
    """By dotted name the fields of each part of a scenario, those of inner parts before those of outer ones."""
    found: dict[str, set[str]] = {}
    _collect(Scenario, "", found)
    return found


def _collect(model: type[BaseModel], prefix: str, found: dict[str, set[str]]) -> None:
    for name, info in model.model_fields.items():
        kind = info.annotation
        if isinstance(kind, type) and issubclass(kind, BaseModel):
            _collect(kind, f"{prefix}{name}.", found)
            found[f"{prefix}{name}"] = {f"{prefix}{name}.{inner}" for inner in kind.model_fields}
