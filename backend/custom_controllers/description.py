"""What the service knows of a custom controller, and the class that stands for it where it is not driven."""

import inspect
from collections.abc import Mapping
from dataclasses import dataclass
from pathlib import Path
from typing import Any, Literal

from backend.json_types import JsonObject
from sim_core import Controller, DampingController, EcuController, LinearLaw, PredictiveController, SpeedPlan
from sim_core.check_controller import declaration_faults
from sim_core.control.controller import option_fields
from sim_core.control.declared import Option, ScenarioField
from sim_core.controller_files import ControllerCodeError
from sim_core.strategies.reads import effective_preview, is_set_by_field

LONGEST_LABEL = 80
_BASES: dict[str, type[Controller]] = {  # the first that it derives from says what its runs cost
    each.__name__: each for each in (EcuController, PredictiveController, DampingController, Controller)
}
_TYPES: dict[Any, Any] = {"number": float, "integer": int, "boolean": bool, "string": str}


@dataclass(frozen=True, slots=True, kw_only=True)
class Description:
    """A controller without its code.

    Attributes:
        id: Its id.
        label: Its label.
        text: Its docstring.
        base: The name of the class of ours that it derives from.
        speed_plan: Its own.
        actuated: Whether it has actuators.
        delayed: Whether its commands take effect later.
        linear: Whether it says a linear law.
        fixed: Of what it sees of the road ahead, what no field says; where its code decides that, what reads most.
        declared: Its options and scenario fields by name.
        options: JSON Schema of each option.
        files: Further files that it reads.
        file: Where it stands.
        digest: Of its file and of those.
    """

    id: str
    label: str
    text: str
    base: str = Controller.__name__
    speed_plan: SpeedPlan = "planned"
    actuated: bool = True
    delayed: bool = False
    linear: bool = False
    fixed: Mapping[str, Any]
    declared: Mapping[str, Option | ScenarioField]
    options: Mapping[str, JsonObject]
    files: tuple[str, ...] = ()
    file: Path
    digest: str


def described(controller: type[Controller]) -> Description:
    """A controller's description.

    Raises:
        ControllerCodeError: It declares something that cannot be used.
    """
    file = Path(inspect.getfile(controller))
    wrong = declaration_faults(controller)
    if wrong:
        raise ControllerCodeError(f"{file}, class {controller.__name__}: {'; '.join(wrong)}")
    made = controller()
    fixed = {"preview": effective_preview(controller), "prediction_horizon": made.preview_steps}
    return Description(
        id=controller.id,
        label=" ".join(controller.label.split())[:LONGEST_LABEL],
        text=controller.description(),
        base=next(name for name, base in _BASES.items() if issubclass(controller, base)),
        speed_plan=controller.speed_plan,
        actuated=bool(controller.actuated),
        delayed=bool(controller.delayed),
        linear=controller.linear_law is not Controller.linear_law,
        fixed={name: value for name, value in fixed.items() if not is_set_by_field(controller, name)},
        declared=dict(controller.declared),
        options={name: _schema(controller, name, each) for name, each in controller.options().items()},
        files=tuple(controller.files),
        file=file,
        digest=str(controller.file_digest),
    )


def _schema(controller: type[Controller], name: str, option: Option) -> JsonObject:
    field = option_fields(controller)[name]
    schema = field.adapter.json_schema()
    schema |= {"title": name.replace("_", " ").capitalize(), "description": option.help, "default": option.default}
    if schema.get("type") in ("number", "integer"):
        size = abs(option.default) or 1
        schema["unit"] = field.unit
        schema["soft_range"] = [
            -2 * size if option.ge is None and option.default < 0 else option.ge or 0,
            2 * size if option.le is None else option.le,
        ]
    return schema


def proxy_class(description: Description) -> type[Controller]:
    """A class with the same fields, which cannot be driven."""
    base = _BASES[description.base]
    members = {
        "__doc__": description.text,
        "__annotations__": {name: _type(schema) for name, schema in description.options.items()},
        **{name: getattr(description, name) for name in ("id", "label", "speed_plan", "actuated", "delayed", "files")},
        **description.fixed,
        **description.declared,
        "__init__": _assigning(description, base),
        "file_digest": description.digest,
    }
    if description.linear and base.linear_law is Controller.linear_law:
        members["linear_law"] = _linear_law
    return type(description.id, (base,), members)


def _assigning(description: Description, base: type[Controller]) -> Any:
    """Return an `__init__` that assigns to a declared field what the controller's own code does."""

    def __init__(self: Controller, **values: Any) -> None:  # noqa: N807 - it becomes a class's
        base.__init__(self, **values)
        for name in description.fixed.keys() & description.declared.keys():
            setattr(self, name, description.fixed[name])

    return __init__


def _linear_law(_controller: Controller, _stage: str) -> LinearLaw | None:
    return None


def _type(schema: JsonObject) -> Any:
    if "enum" in schema:
        return Literal[tuple(schema["enum"])]
    return _TYPES.get(schema.get("type"), Any)
