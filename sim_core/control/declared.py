"""The fields that a controller's class declares: options of its own, and fields of the scenario."""

from collections.abc import Mapping
from copy import copy
from dataclasses import dataclass
from itertools import chain
from typing import Any


class DeclaredField:
    """A declared field: what is assigned to it in an object is the object's own value, as one that was given.

    A descriptor that only sets: whatever else a controller sets or reads costs as much as in any object.
    """

    __slots__ = ()

    def __set_name__(self, kind: type, name: str) -> None:
        if any(each is self for other, each in vars(kind).items() if other != name):
            setattr(kind, name, copy(self))  # of `front = rear = option(1.0)`: each has to find its name

    def __set__(self, controller: Any, value: Any) -> None:
        members = chain.from_iterable(vars(each).items() for each in type(controller).__mro__)
        name = next(name for name, each in members if each is self)
        vars(controller)[name] = value
        # Another dictionary: a copy of the object may have the same one.
        controller._own_values = {**own_values(controller), name: value}


@dataclass(frozen=True, slots=True, kw_only=True)
class ScenarioField(DeclaredField):
    """A controller's field whose value is that of a scenario's field, by its dotted name."""

    name: str


@dataclass(frozen=True, slots=True, kw_only=True)
class Option(DeclaredField):
    """A controller's own field: its default, unit, bounds and help."""

    default: Any
    unit: str
    ge: float | None
    le: float | None
    help: str


def scenario_field(name: str) -> Any:
    """Return a field of a controller that takes its value from the scenario.

    Args:
        name: Dotted name of the scenario's field, such as `mpc.force_weight`, or of a whole part.

    Example:
        >>> from sim_core import Controller, Scenario, scenario_field
        >>> class Weighed(Controller):
        ...     force_weight: float = scenario_field("mpc.force_weight")
        >>> heavier = Scenario.model_validate({"mpc": {"force_weight": 2e-9}})
        >>> Weighed().for_scenario(heavier).force_weight
        2e-09
    """
    return ScenarioField(name=name)


def option(default: Any, *, unit: str = "1", ge: float | None = None, le: float | None = None, help: str = "") -> Any:  # noqa: A002 - what it is to whoever sets it
    """Return a field of a controller that is its own.

    Args:
        default: Its value where nobody gives one.
        unit: Of a number; `1` for none.
        ge: Smallest value.
        le: Largest value.
        help: One sentence for whoever sets it.

    Example:
        >>> from sim_core import Controller, option
        >>> class BodyDamper(Controller):
        ...     damping: float = option(2000.0, unit="N s/m", ge=0, le=20_000, help="Force per body velocity.")
        >>> BodyDamper().damping, BodyDamper(damping=500.0).damping
        (2000.0, 500.0)
    """
    return Option(default=default, unit=unit, ge=ge, le=le, help=help)


class DeclaredFields:
    """The fields that a class declares, as it is now; one that a subclass replaces by a plain value is none of them."""

    def __get__(self, _: object, kind: type) -> Mapping[str, ScenarioField | Option]:
        members: dict[str, Any] = {}
        for each in reversed(kind.__mro__):
            members.update(vars(each))
        return {name: value for name, value in members.items() if isinstance(value, ScenarioField | Option)}


def own_values(controller: object) -> Mapping[str, Any]:
    """Return the declared fields that a controller was given or assigned, which it has whatever a scenario says."""
    values: dict[str, Any] = vars(controller).get("_own_values", {})  # none where __init__ has set nothing yet
    return values
