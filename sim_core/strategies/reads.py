"""Which of the scenario's fields a strategy's result depends on: those of what its controller uses, and its own.

What a drive looks at can be recorded (`sim_core.scenario.access`); `check_controller` and tests hold both together.
"""

import inspect
from contextlib import suppress
from functools import cache
from typing import Any

from pydantic import BaseModel

from sim_core.control.controller import Controller
from sim_core.control.declared import ScenarioField, own_values
from sim_core.errors import RidelabError
from sim_core.scenario import Preview, Scenario
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
SENSORS_AHEAD = (
    "estimation.knows_preview",
    "mismatch.preview_offset",
    "mismatch.preview_gain",
    "mismatch.preview_resolution",
    "mismatch.preview_delay",
    "speed.detection_distance",
)
PREVIEW: dict[Preview, tuple[str, ...]] = {
    "none": (),
    "wheelbase": ("estimation.knows_preview",),
    "obstacle": SENSORS_AHEAD,
    "lookahead": (*SENSORS_AHEAD, "mismatch.preview_noise", "mpc.expected_offset", "mpc.expected_noise"),
}
MOST_INFORMED: Preview = "lookahead"
CLASS_ATTRIBUTES = (
    "speed_plan",
    "actuated",
    "delayed",
)  # decide what is read: the same for all objects of a class


def effective_preview(strategy: type[Controller], scenario: Scenario | None = None) -> Preview:
    """Return what a strategy previews; where code of its own decides that in each run, the kind that reads most.

    Args:
        strategy: The strategy.
        scenario: Where it is driven; None for anywhere, whatever its fields say there.
    """
    if preview_varies_at_runtime(strategy):
        return MOST_INFORMED
    preview: Any = MOST_INFORMED
    if not is_set_by_field(strategy, "preview"):
        preview = strategy().preview
    elif scenario is not None:
        with suppress(RidelabError):  # what it refuses has a key, too: its failure is stored
            preview = strategy().for_scenario(scenario).preview
    return preview if preview in PREVIEW else MOST_INFORMED


def preview_varies_at_runtime(strategy: type[Controller]) -> bool:
    """Check whether a strategy's own code may give it another preview in each run, which no field says."""
    is_property = hasattr(inspect.getattr_static(strategy, "preview"), "__get__")
    return is_property or strategy.for_scenario is not Controller.for_scenario


def is_set_by_field(strategy: type[Controller], name: str) -> bool:
    """Check whether a declared field says a run's value: neither an object's `__init__` nor code in each run does."""
    by_code = name == "preview" and preview_varies_at_runtime(strategy)
    return name in strategy.declared and not by_code and name not in own_values(strategy())


def dependencies(strategy: type[Controller], plan: SpeedPlan, preview: Preview) -> tuple[str, ...]:
    """Dotted names of the parts and fields that its result depends on; on nothing else.

    The speed policy, which decides the plan, is not among them.

    Args:
        strategy: The strategy.
        plan: Its speed plan.
        preview: What it previews.
    """
    names = [*EVERY_RUN, *(each.name for each in strategy.declared.values() if isinstance(each, ScenarioField))]
    if strategy.actuated:
        names += ACTUATORS
    names += PREVIEW[preview]
    if plan == "planned":
        names += SPEED_PLAN
    options = (f"{OWN}{strategy.id}",) if strategy.options() else ()
    return (*merge_into_parts(frozenset(names)), *options)


@cache
def merge_into_parts(names: frozenset[str]) -> tuple[str, ...]:
    """Return the same fields, with a part's name in place of those of all its fields."""
    return tuple(sorted(_of_part(Scenario, "", names)))


def _of_part(part: type[BaseModel], prefix: str, names: frozenset[str]) -> set[str]:
    """Return those of a part, whose fields begin with `prefix`."""
    fields, own = {f"{prefix}{name}": info.annotation for name, info in part.model_fields.items()}, set[str]()
    for name, kind in fields.items():
        if name in names:
            own.add(name)
        elif isinstance(kind, type) and issubclass(kind, BaseModel):
            own |= _of_part(kind, f"{name}.", names)
    return {prefix.removesuffix(".")} if fields and own == fields.keys() else own
