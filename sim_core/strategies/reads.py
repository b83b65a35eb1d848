"""Which of the scenario's fields a strategy's result depends on: those of every run, and its controller's own."""

from functools import cache

from pydantic import BaseModel

from sim_core.control.controller import Controller, ScenarioField
from sim_core.scenario import Scenario
from sim_core.scenario.dotted import OWN
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


def dependencies(strategy: type[Controller], plan: SpeedPlan) -> tuple[str, ...]:
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
    options = (f"{OWN}{strategy.id}",) if strategy.options() else ()
    return (*by_parts(frozenset(names)), *options)


@cache
def by_parts(names: frozenset[str]) -> tuple[str, ...]:
    """The same fields, with a part's name in place of those of all its fields."""
    return tuple(sorted(_of_part(Scenario, "", names)))


def _of_part(part: type[BaseModel], prefix: str, names: frozenset[str]) -> set[str]:
    """Those of a part, whose fields begin with `prefix`."""
    fields, own = {f"{prefix}{name}": info.annotation for name, info in part.model_fields.items()}, set[str]()
    for name, kind in fields.items():
        if name in names:
            own.add(name)
        elif isinstance(kind, type) and issubclass(kind, BaseModel):
            own |= _of_part(kind, f"{name}.", names)
    return {prefix.removesuffix(".")} if fields and own == fields.keys() else own
