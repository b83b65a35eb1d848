"""The suspension controller: one contract for Ridelab's own and for a visitor's.

A controller is a class with an id, a label and a docstring, whose first line describes it. Its numbers are annotated
fields: options of its own, or fields of the scenario. `sim_core.simulate` takes the class, or an object of it, as it
takes the id of one in `sim_core.STRATEGIES`.

`force` is asked once a control step. A law that is linear while no limit binds may also say so by
`linear_law`; many control steps are then driven at once, and `force` is asked only where one of its limits binds.
`sim_core.check_controller` tells what is wrong with a controller.
"""

from collections.abc import Callable, Mapping, Sequence
from copy import copy
from dataclasses import dataclass
from functools import cache
from operator import attrgetter
from typing import Any, ClassVar, Self, get_type_hints
from weakref import WeakKeyDictionary

import numpy as np
from numpy.typing import NDArray
from pydantic import Field, TypeAdapter

from sim_core.arrays import FloatArray
from sim_core.control.declared import DeclaredFields, Option, ScenarioField, own_values
from sim_core.control.law import LinearLaw
from sim_core.control.plan import Plan
from sim_core.control.seen import Seen, Setup
from sim_core.errors import RefusedError, RidelabError, UnknownNameError
from sim_core.kernel.qp import Qp
from sim_core.scenario import Preview, Scenario, dotted
from sim_core.scenario.fields import Part
from sim_core.speed.profile import SpeedPlan
from sim_core.vehicle.model import SemiActiveDampers

Force = Sequence[float] | NDArray[np.float64]
_DEFAULTS = Scenario()


@dataclass(slots=True)
class Report:
    """What a controller says of a run beside its forces; None where it has no such thing.

    Attributes:
        solves: Control steps with a QP.
        fallbacks: Of them, those that another solver than the first one solved.
        failures: Of them, those that none solved.
        max_slack: Largest predicted deflection beyond its limit [m].
        limited_steps: Control steps in which a limit of its own shaped the force; in a run's events, those in which
            the limits of forces or actuators did are counted too.
        most_iterations: Most iterations of the solver in one step.
        clipped_values: Measured values beyond the range of their converters.

    Example:
        >>> from sim_core import Controller, Scenario, simulate
        >>> class OftenLimited(Controller):
        ...     def force(self, seen):
        ...         self.report.limited_steps += 1
        ...         return 0.0, 0.0
        >>> result = simulate(Scenario(), OftenLimited)
        >>> result.events["limited_steps"] > 1000
        True
    """

    solves: int = 0
    fallbacks: int = 0
    failures: int = 0
    max_slack: float = 0.0
    limited_steps: int = 0
    most_iterations: int | None = None
    clipped_values: int | None = None


class Controller:
    """A suspension controller and the speed plan it is driven with: a strategy.

    A subclass sets `id`, `label` and fields (`option`, `scenario_field`), and defines `force` or `linear_law`. A run
    calls `start` once with a `Setup`, then `force` with a `Seen` in each control step that no law decides, then `end`.
    Each run drives a shallow copy of the object: attributes that `start` sets belong to one run, while a list or array
    made before is shared by all, so that `start` has to make it anew.

    Attributes:
        id: Name in scenarios, files and addresses: a small letter, then small letters, digits and underscores.
        label: Name in tables and plots.
        speed_plan: `planned` brakes for the bump, `constant` does not; a scenario's `speed.policy` may overrule it.
        actuated: Whether there are actuators; False is a passive suspension.
        delayed: Whether its commands take effect when `arrivals` says, not at once.
        preview: What of the road ahead `Seen` reports: none, wheelbase, lookahead or obstacle (`mpc.preview` in
            docs/reference/scenario.md). None by default: a controller that looks ahead sets it, to one of these or to
            a field such as `scenario_field("mpc.preview")`.
        prediction_horizon: For how many control steps ahead, set together with `preview`.
        report: Counts of the present run, for its events; new at each start.
        declared: Its options and scenario fields by their names.
        files: Names of further files that it reads, such as weights, beside its own one.
        file_digest: SHA-256 of its file and of those, where `load_controllers` loaded it; None elsewhere.

    Example:
        >>> from sim_core import Controller, Scenario, option, simulate
        >>> class BodyDamper(Controller):
        ...     "Damps the body's vertical motion."
        ...     id, label = "body_damper", "Body damper"
        ...     damping: float = option(2000.0, unit="N s/m", ge=0, le=20_000, help="Force per body velocity.")
        ...     def force(self, seen):
        ...         each = -self.damping * seen.state[4] / 2
        ...         return each, each
        >>> soft, hard = (simulate(Scenario(), BodyDamper(damping=value)) for value in (500.0, 5000.0))
        >>> hard.comfort["weighted_rms"] < soft.comfort["weighted_rms"]
        True
    """

    id: ClassVar[str] = ""
    label: ClassVar[str] = ""
    speed_plan: ClassVar[SpeedPlan] = "planned"
    actuated: ClassVar[bool] = True
    delayed: ClassVar[bool] = False
    preview: Preview = "none"
    prediction_horizon: int = 0
    report: Report
    declared = DeclaredFields()
    files: ClassVar[Sequence[str]] = ()
    file_digest: ClassVar[str | None] = None

    def __init__(self, **values: Any) -> None:
        """Set fields; what is not given has its default, or the scenario's value in a run.

        Raises:
            RidelabError: There is no such field, or it does not take the value.
        """
        self.report = Report()
        self._own_values = {name: checked_value(type(self), name, value) for name, value in values.items()}
        self._set(_DEFAULTS)

    @classmethod
    def description(cls) -> str:
        """Return the first line of its docstring."""
        return (cls.__doc__ or "").strip().partition("\n")[0]

    @classmethod
    def options(cls) -> dict[str, Option]:
        """Return its own fields by their names."""
        return {name: each for name, each in cls.declared.items() if isinstance(each, Option)}

    @property
    def preview_steps(self) -> int:
        """Control steps for which the road ahead is reported."""
        return self.prediction_horizon

    def for_scenario(self, scenario: Scenario) -> Self:
        """Return a copy for one run: a scenario field has that scenario's value, unless the object was given one.

        Raises:
            RidelabError: A field does not take the value that the object or the scenario has for it.
        """
        ready = copy(self)
        ready.report = Report()
        given, declared = own_values(self), self.declared
        ready._own_values = {
            name: checked_value(type(self), name, value) for name, value in given.items() if name in declared
        }
        ready._set(scenario)
        return ready

    def start(self, setup: Setup) -> None:
        """Prepare for a run; called once before its first step."""

    def force(self, seen: Seen) -> Force | None:
        """Return both actuators' forces for one control step: front and rear [N], up on the body.

        They are held for one sample time, and kept within the force limit. By default those of `linear_law`.

        Args:
            seen: What is known just before the command changes.

        Returns:
            Two numbers; None, of a delayed controller, where no command came.

        Raises:
            RidelabError: The class defines neither this nor `linear_law`.
        """
        law = self.linear_law(seen.stage)
        if law is None:
            raise undefined(self, "force(seen) or linear_law(stage)")
        return linear_force(law, seen)

    def linear_law(self, stage: str) -> LinearLaw | None:
        """Return the law of a driving stage while no limit binds; None for a controller that is not linear.

        Where its forces are within the force limit and its own limits hold, they are the command. Elsewhere `force` is
        asked. It should be the same object in each call, so that what is prepared for it is kept. A delayed controller
        is not asked for a law.
        """
        return None

    def qp(self, stage: str) -> Qp | None:
        """What decides the steps of a driving stage in which a limit of its law binds; None where `force` does."""
        return None

    def plan(self, seen: Seen) -> Plan | None:
        """Return what it plans for the coming control steps; None for a controller that plans nothing.

        Asked where somebody wants to know why a force was commanded, between `start` and `end`, never during a run. Of
        a delayed controller `seen.previous_force` is here what it answered last.
        """
        return None

    def dampers(self) -> SemiActiveDampers | None:
        """Return the car's dampers where this controller sets their coefficients; None where actuators act beside them.

        `force` then says what control adds to the passive damper's force, up on the body, and each damper gives the
        nearest to it that its least and most coefficient allow at its speed. A law that knows hard and soft only asks
        for a force far beyond them: against the deflection's speed for hard, with it for soft.
        """
        return None

    def arrivals(self, setup: Setup) -> NDArray[np.intp]:
        """Return, of a delayed controller, the short step at which each control step's command takes effect (steps,).

        Short steps are `setup.short_step` long and count from the first control step's beginning; a command that is to
        arrive after the run never does.
        """
        return np.arange(setup.steps) * setup.short_steps

    def end(self) -> None:
        """Release what `start` took; called once after a run, also after one that failed."""

    def _set(self, scenario: Scenario) -> None:
        options, declared, given = scenario.own.of(self.id), self.declared, own_values(self)
        for name in options:
            if not isinstance(declared.get(name), Option):
                raise RefusedError(f"{self.label} has no such option", field=option_name(type(self), name))
        for name, field in declared.items():
            if name in given:
                value = given[name]
            elif isinstance(field, ScenarioField):
                value = scenario_value(scenario, field.name)
            else:
                value = checked_value(type(self), name, options[name]) if name in options else field.default
            vars(self)[name] = value  # not by assigning, which would make it the object's own


def linear_force(law: LinearLaw, seen: Seen) -> FloatArray:
    """Return a law's forces for what is seen (2,) [N]; one without `preview_gain` needs no preview."""
    disturbances = None if law.preview_gain is None else seen.disturbances
    return law.force(seen.state, seen.previous_force, disturbances)


def undefined(controller: Controller, methods: str) -> RefusedError:
    """Return the error of a controller whose class has to define one of these methods, and does not."""
    return RefusedError(f"{type(controller).__name__} has to define {methods}")


def scenario_value(scenario: Scenario, name: str) -> Any:
    """Return the value of a scenario's field, or a whole part, by its dotted name.

    Raises:
        UnknownNameError: A scenario has no such field.
    """
    return _getter(name)(scenario)


@cache
def _getter(name: str) -> Callable[[Scenario], Any]:
    part: Any = _DEFAULTS
    for key in name.split("."):
        if key not in type(part).model_fields:
            raise UnknownNameError(f"A scenario has no field {name}; there are {', '.join(dotted.offered(name))}")
        part = getattr(part, key)
    return attrgetter(name)


_OptionFields = tuple[dict[str, Option], dict[str, dotted.DottedField]]  # of which options these are the fields
_option_fields: WeakKeyDictionary[type[Controller], _OptionFields] = WeakKeyDictionary()


def option_fields(kind: type[Controller]) -> Mapping[str, dotted.DottedField]:
    """Return a controller's options as fields of the scenario, by their own names."""
    options = kind.options()
    known = _option_fields.get(kind)
    if known is None or known[0] != options:
        types = get_type_hints(kind)
        fields = {
            name: _option_field(kind, name, types.get(name, type(each.default))) for name, each in options.items()
        }
        known = _option_fields[kind] = options, fields
    return known[1]


def option_name(kind: type[Controller], name: str) -> str:
    """Return the dotted name of a controller's option."""
    return f"{dotted.OWN}{kind.id}.{name}"


def _option_field(kind: type[Controller], name: str, annotation: Any) -> dotted.DottedField:
    option = kind.options()[name]
    title, unit = f"{kind.label}: {name.replace('_', ' ')}", option.unit.replace(" ", "·")
    limits: Any = Field(ge=option.ge, le=option.le)
    return dotted.DottedField.of(option_name(kind, name), title, unit, annotation, limits, option.default)


def checked_value(kind: type[Controller], name: str, value: Any) -> Any:
    """Return a field's value, of its type and within its bounds.

    Raises:
        RidelabError: There is no such field, or it does not take the value; the message begins with the field's name.
    """
    field = kind.declared.get(name)
    if field is None:
        raise RefusedError(f"{kind.__name__} has no field of that name; there are {', '.join(kind.declared)}")
    if isinstance(field, ScenarioField):
        part, dotted_name = scenario_value(_DEFAULTS, field.name), field.name
        adapter = TypeAdapter(type(part)) if isinstance(part, Part) else dotted.field(field.name).adapter
    else:
        described = option_fields(kind)[name]
        dotted_name, adapter = described.name, described.adapter
    try:
        return dotted.validated(adapter, value, dotted_name)
    except RidelabError as error:
        raise RefusedError(f"{name}: {error.message}", field=dotted_name) from None
