"""The strategies: each a controller and the speed plan it is driven with, in a file of its own.

Adding one is adding its file and its class here.
"""

from contextlib import suppress
from typing import Any

from sim_core.control.controller import Controller, option_fields
from sim_core.controller_files import ControllerFileError, named_controllers
from sim_core.errors import RefusedError, RidelabError, UnknownNameError
from sim_core.scenario import Scenario, dotted
from sim_core.scenario.recorded import recording_id
from sim_core.speed.profile import SpeedPlan
from sim_core.strategies.groundhook import Groundhook
from sim_core.strategies.hybrid import Hybrid
from sim_core.strategies.lqr import Lqr
from sim_core.strategies.lv import Lv
from sim_core.strategies.lv_hil import LvHil
from sim_core.strategies.passive import Passive, SpeedOnly
from sim_core.strategies.reads import CLASS_ATTRIBUTES, dependencies, effective_preview
from sim_core.strategies.skyhook import Skyhook
from sim_core.strategies.suspension_only import SuspensionOnly

STRATEGIES: dict[str, type[Controller]] = {
    strategy.id: strategy
    for strategy in (Lv, LvHil, Lqr, Skyhook, Groundhook, Hybrid, SuspensionOnly, SpeedOnly, Passive)
}
# A recording is compared with drives of these. Delayed ones are slow to simulate, and add no controller of their own.
REFERENCE_STRATEGIES = tuple(name for name, strategy in STRATEGIES.items() if not strategy.delayed)


def strategies() -> dict[str, type[Controller]]:
    """Return our strategies, and those of `RIDELAB_CONTROLLERS` and of installed packages, by id.

    Raises:
        ControllerFileError: One of those files cannot be used.
    """
    return STRATEGIES | {name: each for name, each in named_controllers().items() if name not in STRATEGIES}


def strategy_named(name: str) -> type[Controller]:
    """Return the strategy with that id: one of ours, or of the files that `RIDELAB_CONTROLLERS` or a package names.

    Raises:
        UnknownNameError: There is none; the message lists the ids.
        ControllerFileError: It is none of ours, and one of those files cannot be used.
    """
    if name in STRATEGIES:
        return STRATEGIES[name]
    own = named_controllers()
    if name not in own:
        raise UnknownNameError(f"Unknown strategy; there are {', '.join([*STRATEGIES, *own])}")
    return own[name]


def find_strategy(name: str) -> type[Controller] | None:
    """Return the strategy with that id; None where there is none, or where the files of controllers cannot be used."""
    with suppress(UnknownNameError, ControllerFileError):
        return strategy_named(name)
    return None


def label_of(name: str) -> str:
    """Return what a strategy or a recorded drive is called; the id itself where there is no such strategy any more."""
    if (recording := recording_id(name)) is not None:
        return f"Recording {recording[:6]}"
    strategy = find_strategy(name)
    return name if strategy is None else strategy.label


def _options() -> dict[str, dotted.DottedField]:
    """Return the options of controllers of one's own by dotted name; none where a file cannot be used."""
    with suppress(ControllerFileError):
        fields = [field for each in named_controllers().values() for field in option_fields(each).values()]
        return {field.name: field for field in fields}
    return {}


dotted.use_options(_options)


def make_controller(strategy: str | type[Controller] | Controller) -> Controller:
    """Return an object for the id of a strategy or for a controller's class; an object is returned as it is.

    Raises:
        UnknownNameError: No such strategy.
        RidelabError: It is none of these.
    """
    controller = strategy_named(strategy) if isinstance(strategy, str) else strategy
    if isinstance(controller, type) and issubclass(controller, Controller):
        controller = controller()
    if not isinstance(controller, Controller):
        raise RidelabError("A strategy is an id, a class derived from sim_core.Controller, or an object of one")
    return controller


def controller_for(strategy: str | type[Controller] | Controller, scenario: Scenario) -> Controller:
    """Return the controller of one run, with its scenario's values.

    Raises:
        UnknownNameError: No such strategy.
        RidelabError: It is none, does not take the scenario's values, or an object says otherwise than its class how it
            is driven.
    """
    controller = make_controller(strategy).for_scenario(scenario)
    for name in CLASS_ATTRIBUTES:
        if getattr(controller, name) != getattr(type(controller), name):
            raise RefusedError(f"{controller.label}: set {name} on the class, not on objects")
    return controller


def resolve_speed_plan(strategy: type[Controller], policy: str) -> SpeedPlan:
    """Check whether a strategy slows down for the bump under a scenario's `speed.policy`.

    Raises:
        RidelabError: Its own plan is none.
    """
    plans: dict[str, SpeedPlan] = {"planned": "planned", "constant": "constant"}
    if strategy.speed_plan not in plans:
        raise RefusedError(f"{strategy.label}: speed_plan is planned or constant")
    return plans.get(policy, strategy.speed_plan)


def speed_plan_on(strategy: type[Controller], scenario: Scenario) -> SpeedPlan:
    """Return how a strategy is driven over the scenario's road: at constant speed where that has no bump.

    Raises:
        RidelabError: Its own plan is none.
    """
    plan = resolve_speed_plan(strategy, scenario.speed.policy)
    return plan if scenario.road.has_bump else "constant"


def reads(strategy: type[Controller], policy: str = "by_strategy") -> tuple[str, ...]:
    """Return the dotted names of the parts and fields of a scenario on which alone a strategy's result depends.

    Args:
        strategy: The strategy; with each kind of preview that a scenario may have it look at.
        policy: The scenario's `speed.policy`, which decides how the strategy is driven.
    """
    plan = resolve_speed_plan(strategy, policy)
    return ("speed.policy", *dependencies(strategy, plan, effective_preview(strategy)))


def reads_in(scenario: Scenario, strategy: type[Controller]) -> tuple[str, ...]:
    """Return the dotted names of what a strategy's result depends on in a scenario, with the preview that it has there.

    The speed policy, which decides the speed plan on a road with a bump, is not among them.
    """
    return dependencies(strategy, speed_plan_on(strategy, scenario), effective_preview(strategy, scenario))


def values_read(
    scenario: Scenario, strategy: type[Controller], identity: dict[str, Any] | None = None
) -> dict[str, Any]:
    """Return what a strategy reads of a scenario: dotted name -> plain JSON value, by name.

    The speed policy counts by what is read under it: a strategy at its own speed has one key whatever the policy is.
    `identity` is the scenario's (`Part.identity`), where it was made already.
    """
    identity = identity or scenario.identity()
    values: dict[str, Any] = {}
    for path in reads_in(scenario, strategy):
        *parts, last = path.split(".")
        part = identity
        for key in parts:
            part = part.get(key, {})
        if last in part:
            values |= _leaves(path, part[last])
    return values


def _leaves(path: str, value: Any) -> dict[str, Any]:
    """Return values field by field: a field that is added to a part may not change what others are known by."""
    if not isinstance(value, dict):
        return {path: value}
    return {name: leaf for key, item in value.items() for name, leaf in _leaves(f"{path}.{key}", item).items()}
