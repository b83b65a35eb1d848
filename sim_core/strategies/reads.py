"""Which of the scenario's fields a strategy's result depends on: those of what its controller uses, and its own.

What a drive looks at can be recorded (`sim_core.scenario.access`); `check_controller` and tests hold both together.
"""

import inspect
from collections.abc import Iterator
from contextlib import suppress
from functools import cache
from itertools import chain
from typing import Any, get_args

from pydantic import BaseModel

from sim_core.control.controller import Controller
from sim_core.control.declared import ScenarioField, own_values
from sim_core.errors import RidelabError
from sim_core.scenario import Preview, Scenario
from sim_core.scenario.dotted import OWN
from sim_core.scenario.fields import field_texts
from sim_core.speed.profile import SpeedPlan

PREVIEWS: tuple[Preview, ...] = get_args(Preview)
MOST_INFORMED: Preview = "lookahead"
CLASS_ATTRIBUTES = "speed_plan", "actuated", "delayed"  # decide what is read: the same for all objects of a class


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
    return preview if preview in PREVIEWS else MOST_INFORMED


def preview_varies_at_runtime(strategy: type[Controller]) -> bool:
    """Check whether a strategy's own code may give it another preview in each run, which no field says."""
    is_property = hasattr(inspect.getattr_static(strategy, "preview"), "__get__")
    return is_property or strategy.for_scenario is not Controller.for_scenario


def is_set_by_field(strategy: type[Controller], name: str) -> bool:
    """Check whether a declared field says a run's value: neither an object's `__init__` nor code in each run does."""
    by_code = name == "preview" and preview_varies_at_runtime(strategy)
    return name in strategy.declared and not by_code and name not in own_values(strategy())


def dependencies(strategy: type[Controller], plan: SpeedPlan, preview: Preview) -> tuple[str, ...]:
    """Return the dotted names of the parts and fields on which alone its result depends.

    The speed policy, which decides the plan, is not among them.

    Args:
        strategy: The strategy.
        plan: Its speed plan.
        preview: What it previews.
    """
    readers = ["every_run", preview, *["actuators"] * strategy.actuated, *["speed_plan"] * (plan == "planned")]
    declared = [each.name for each in strategy.declared.values() if isinstance(each, ScenarioField)]
    options = [f"{OWN}{strategy.id}"] if strategy.options() else []
    return merge_into_parts(frozenset(chain(declared, options, *map(fields_read_by, readers))))


@cache
def fields_read_by(reader: str) -> tuple[str, ...]:
    """Return the dotted names of the fields and whole parts that a reader of fields.toml reads, such as `every_run`."""
    return tuple(_read_by(reader, Scenario, ""))


def _read_by(reader: str, part: type[BaseModel], prefix: str) -> Iterator[str]:
    for name, info in part.model_fields.items():
        kind: Any = info.annotation
        if reader in field_texts(part, name).get("read_by", "").split():
            yield f"{prefix}{name}"
        elif isinstance(kind, type) and issubclass(kind, BaseModel):
            yield from _read_by(reader, kind, f"{prefix}{name}.")


@cache
def merge_into_parts(names: frozenset[str]) -> tuple[str, ...]:
    """Return the same fields, with a part's name in place of those of all its fields; custom options come last."""
    options = (name for name in names if name.startswith(OWN))
    return (*sorted(_of_part(Scenario, "", names)), *sorted(options))


def _of_part(part: type[BaseModel], prefix: str, names: frozenset[str]) -> set[str]:
    """Return those of a part, whose fields begin with `prefix`."""
    fields, own = {f"{prefix}{name}": info.annotation for name, info in part.model_fields.items()}, set[str]()
    for name, kind in fields.items():
        if name in names:
            own.add(name)
        elif isinstance(kind, type) and issubclass(kind, BaseModel):
            own |= _of_part(kind, f"{name}.", names)
    return {prefix.removesuffix(".")} if fields and own == fields.keys() else own
