"""What is wrong with a controller, in words, before anybody relies on its numbers."""

import inspect
import re
from collections.abc import Iterator
from dataclasses import replace

import numpy as np

from sim_core.catalogue import METRICS
from sim_core.control.controller import Controller, checked_value, scenario_value
from sim_core.control.declared import Option, ScenarioField
from sim_core.controller_files import format_error
from sim_core.errors import ForceError, RidelabError
from sim_core.metrics.evaluate import evaluate
from sim_core.result import StrategyResult
from sim_core.scenario import Bump, Road, Scenario
from sim_core.scenario.access import record_accesses
from sim_core.scenario.dotted import is_within
from sim_core.simulate import prepare, simulate
from sim_core.strategies import STRATEGIES, make_controller, reads_in, speed_plan_on, strategy_named
from sim_core.strategies.reads import dependencies

_SHORT = Scenario(road=Road(length=60, bump=Bump(start=30)))
_SAME_FORCE = 1e-4  # relative: a solver's answer is no closer to the linear law's
_NEGLIGIBLE = 1e-6  # in SI units: smaller differences do not count
ID = "^[a-z][a-z0-9_]{0,63}$"
_TAKEN = ("none",)  # what a view says where no strategy is chosen


def check_controller(controller: str | type[Controller] | Controller, scenario: Scenario | None = None) -> list[str]:
    """Look at a controller's fields, then drive it over a short road several times.

    Args:
        controller: Its class, an object of it, or the id of one of `STRATEGIES`.
        scenario: What to drive; by default the paper's bump on a road of 60 m.

    Returns:
        A sentence for each thing that is wrong; none where nothing was found.

    Raises:
        UnknownNameError: No such strategy.

    Example:
        >>> from sim_core import Controller, check_controller
        >>> class Nothing(Controller):
        ...     "Gives no force."
        ...     id = "nothing"
        ...     def force(self, seen):
        ...         return 0.0, 0.0
        >>> check_controller(Nothing)
        ['label is empty']
    """
    if isinstance(controller, str):
        controller = strategy_named(controller)
    kind: type = controller if isinstance(controller, type) else type(controller)
    if not issubclass(kind, Controller):
        return ["A controller is a class derived from sim_core.Controller, or an object of one"]
    wrong = declaration_faults(kind)
    return wrong or _driven(controller, _SHORT if scenario is None else scenario)


def _driven(controller: type[Controller] | Controller, scenario: Scenario) -> list[str]:
    """Return what is wrong with its runs."""
    try:
        instance = make_controller(controller)
        kind = type(instance)
        first, again = simulate(scenario, instance), simulate(scenario, instance)
        other = simulate(scenario, controller) if isinstance(controller, type) else first
        has_both = kind.linear_law is not Controller.linear_law and kind.force is not Controller.force
        by_force = evaluate(replace(prepare(scenario, instance), follows_law=False)) if has_both else first
        undeclared = undeclared_reads(scenario, controller)
    except (Exception, SystemExit) as error:  # noqa: BLE001 - of anybody's code
        return [failure(error, controller)]
    if first.summary() != other.summary():
        return [
            "Two runs of new objects differ: it uses something that changes outside the object, such as a list of the "
            "class, a random number or the time; make it in start, a random generator with a seed"
        ]
    if first.summary() != again.summary():
        return ["A second run of the same object differs: start has to forget the run before"]
    if not instance.actuated and first.events["limited_steps"]:
        return ["It says that it has no actuators, and gives a force"]
    if not _close(first, by_force):
        return ["force and linear_law give different forces where no limit binds"]
    return [
        f"It reads scenario field {name} without declaring it, so stored results would not be recomputed when {name} "
        f'changes; declare it with scenario_field("{name}")'
        for name in undeclared
    ]


def undeclared_reads(scenario: Scenario, controller: type[Controller] | Controller) -> list[str]:
    """Return the scenario's fields that a drive looks at, and that its result is not known to depend on.

    A controller whose preview is a field of the scenario is also driven where that field is none: only there does it
    show that its code looks ahead all the same.

    Raises:
        RidelabError: A run fails, as in `simulate`.
    """
    kind = controller if isinstance(controller, type) else type(controller)
    scenarios = [scenario]
    if isinstance(kind.declared.get("preview"), ScenarioField):
        parts = {"mpc": scenario.mpc, "lqr": scenario.lqr}
        none = {name: part.model_copy(update={"preview": "none"}) for name, part in parts.items()}
        scenarios.append(scenario.model_copy(update=none))
    return sorted({name for each in scenarios for name in _undeclared(each, controller, kind)})


def _undeclared(scenario: Scenario, controller: type[Controller] | Controller, kind: type[Controller]) -> Iterator[str]:
    """Yield those that it looks at in one scenario."""
    _, looked_at = record_accesses(scenario, lambda recording: simulate(recording, controller))
    declared: tuple[str, ...] = reads_in(scenario, kind)
    if isinstance(controller, Controller):  # an object may be given another preview than its class has
        plan = speed_plan_on(kind, scenario)
        declared += dependencies(kind, plan, controller.for_scenario(scenario).preview)
    yield from (name for name in looked_at - {"speed.policy"} if not any(is_within(name, each) for each in declared))


def declaration_faults(kind: type[Controller]) -> list[str]:
    """Return what is wrong with its id, label, description and fields."""
    if taken := [name for name in kind.declared if not _may_be_declared(name)]:
        return [f"{name}: this name is used by Controller itself; rename the option" for name in taken]
    wrong = []
    name: object = kind.id  # a visitor's class may hold anything
    label: object = kind.label
    if not (isinstance(name, str) and re.match(ID, name)):
        wrong.append("id begins with a small letter and has small letters, digits and underscores only, 64 at most")
    elif STRATEGIES.get(name, kind) is not kind or name in _TAKEN:
        wrong.append(f"id is that of a strategy of Ridelab's; taken are {', '.join((*STRATEGIES, *_TAKEN))}")
    if not isinstance(label, str):
        wrong.append("label is no text")
    elif not label:
        wrong.append("label is empty")
    if kind.__doc__ is None or not kind.description():
        wrong.append("It has no docstring, whose first line describes it")
    if kind.force is Controller.force and kind.linear_law is Controller.linear_law:
        wrong.append("It defines neither force nor linear_law")
    for declared, field in kind.declared.items():
        try:
            if isinstance(field, Option):
                checked_value(kind, declared, field.default)
            else:
                scenario_value(Scenario(), field.name)
        except RidelabError as error:
            wrong.append(error.message if isinstance(field, Option) else f"{declared}: {error.message}")
    return wrong


def _may_be_declared(name: str) -> bool:
    """Check whether an option or a scenario's field may have that name: it takes the place of nothing else."""
    own_names = {*vars(Controller), *vars(Controller)["__annotations__"]} - {"preview", "prediction_horizon"}
    return name not in own_names and not name.startswith("_")


def failure(error: BaseException, controller: type[Controller] | Controller) -> str:
    """Return an error of a run in a sentence, with the line of the controller's own file that led to it."""
    if isinstance(error, RidelabError) and not isinstance(error, ForceError):
        return error.message
    try:
        file = inspect.getfile(controller if isinstance(controller, type) else type(controller))
    except (TypeError, OSError):  # a class of a notebook or a prompt is in none
        return error.message if isinstance(error, RidelabError) else f"{type(error).__name__}: {error}"
    return format_error(error, file)


def _close(first: StrategyResult, second: StrategyResult) -> bool:
    of_signals = [metric for metric in METRICS.values() if metric.path[0] == "metrics"]
    ours, theirs = ([metric.of(each.summary()) for metric in of_signals] for each in (first, second))
    return np.allclose(ours, theirs, rtol=_SAME_FORCE, atol=_NEGLIGIBLE)
