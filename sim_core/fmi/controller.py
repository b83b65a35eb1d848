"""An FMU as a controller: its parameters are options, its inputs what a controller sees, its outputs both forces."""

import hashlib
import os
import re
import sys
from collections.abc import Iterable
from pathlib import Path
from types import ModuleType
from typing import Any, ClassVar

import numpy as np

from sim_core.arrays import FloatArray
from sim_core.catalogue import STAGES
from sim_core.control.controller import Controller
from sim_core.control.declared import option, scenario_field
from sim_core.control.seen import Seen, Setup
from sim_core.errors import RefusedError
from sim_core.fmi.archive import unpack
from sim_core.fmi.description import NUMBERS, Description, Variable
from sim_core.fmi.instance import Instance, Numbers
from sim_core.vehicle.half_car import STATES

FORCES = ("force_front", "force_rear")
_SINGLE = ("speed", "position", "stage")
_STATE = tuple(f"state[{i + 1}]" for i in range(STATES))
_MEASURED = ("deflection_front", "deflection_rear", "body_acceleration", "pitch_rate")
_ROAD = ("road_front", "road_rear")
_PREVIEWED = re.compile(r"(preview_front|preview_rear|braking)\[([1-9]\d{0,3})\]")
_PREVIEWED_KINDS = ("preview_front", "preview_rear", "braking")
_FIXED = (*_SINGLE, *_STATE, *_MEASURED, *_ROAD)
_OFFERED = "speed, position, stage, state[1] to state[8], " + ", ".join((*_MEASURED, *_ROAD)) + ", " + ", ".join(
    f"{name}[1]…" for name in _PREVIEWED_KINDS
)  # fmt: skip


class FmuController(Controller):
    """A controller whose forces an FMU gives; each run has an instance of its own.

    A subclass is made for each FMU by `controllers_of_fmu`.
    """

    unpacked: ClassVar[tuple[Description, Path, Path]]  # as `unpack` gives them
    parameters: ClassVar[dict[str, Variable]]

    def start(self, setup: Setup) -> None:
        """Make an instance and initialize it with the options.

        Raises:
            RidelabError: It cannot be made, or is for another sample time.
        """
        fmu, step = self.unpacked[0], setup.sample_time
        fmu_step = next((each.start for each in fmu.variables if each.name == "sample_time"), None)
        if fmu_step is not None and abs(fmu_step - step) > 1e-9 * step:
            message = f"{self.label}: the FMU is for control steps of {fmu_step:g} s, the scenario has {step:g} s"
            raise RefusedError(message, field="mpc.sample_time")
        inputs = [each for each in fmu.variables if each.causality == "input"]
        outputs = [each for name in FORCES for each in fmu.variables if each.name == name]
        self._inputs = [(numbers, [self._place(name) for name in names]) for numbers, names in _typed(fmu, inputs)]
        self._outputs = [(numbers, [FORCES.index(name) for name in names]) for numbers, names in _typed(fmu, outputs)]
        names = {each.name for each in inputs}
        self._measures, self._sees_road = not names.isdisjoint(_MEASURED), any(map(_sees_road, names))
        self._sample_time = step
        self._instance = Instance(*self.unpacked, self.label)
        self._instance.begin(list(self._options()))

    def force(self, seen: Seen) -> FloatArray:
        """Return both outputs after a step from what is seen.

        Raises:
            RidelabError: The FMU reports an error.
        """
        values = self._values(seen)
        for numbers, places in self._inputs:
            numbers.values[:] = [numbers.number(values[place]) for place in places]
            self._instance.set(numbers)
        self._instance.step(seen.step * self._sample_time, self._sample_time)
        forces = np.empty(len(FORCES))
        for numbers, places in self._outputs:
            self._instance.get(numbers)
            forces[places] = list(numbers.values)
        return forces

    def end(self) -> None:
        """Free the instance."""
        if hasattr(self, "_instance"):  # else it did not start
            self._instance.end()

    def _place(self, name: str) -> int:
        """Return where an input stands in what `_values` gives."""
        if previewed := _PREVIEWED.fullmatch(name):
            kind = _PREVIEWED_KINDS.index(previewed[1])
            return len(_FIXED) + kind * self.prediction_horizon + int(previewed[2]) - 1
        return _FIXED.index(name)

    def _values(self, seen: Seen) -> list[float]:
        stage = tuple(STAGES).index(seen.stage)
        measured = seen.measurement.tolist() if self._measures else [0.0] * len(_MEASURED)
        values = [seen.speed, seen.position, stage, *seen.state.tolist(), *measured]
        if not self.prediction_horizon:
            return values
        expected, heights = seen.disturbances, np.zeros((self.prediction_horizon, 2))
        if self._sees_road:
            heights = seen.preview
        now = heights[0] - expected[:2, 0] * self._sample_time
        return [*values, *now.tolist(), *heights.T.ravel().tolist(), *expected[2].tolist()]

    def _options(self) -> Iterable[Numbers]:
        fmu = self.unpacked[0]
        values = {variable.name: getattr(self, name) for name, variable in self.parameters.items()}
        for numbers, names in _typed(fmu, self.parameters.values()):
            numbers.values[:] = [numbers.number(values[name]) for name in names]
            yield numbers


def _typed(fmu: Description, variables: Iterable[Variable]) -> Iterable[tuple[Numbers, list[str]]]:
    """Variables of each type together, with their names."""
    by_type: dict[str, list[Variable]] = {}
    for variable in variables:
        by_type.setdefault(variable.type, []).append(variable)
    for kind, those in by_type.items():
        yield Numbers(fmu, kind, [each.reference for each in those]), [each.name for each in those]


def controllers_of_fmu(path: Path, content: bytes) -> dict[str, type[Controller]]:
    """Return the controller that an FMU is, by its id: the file's name.

    Args:
        path: Of its file.
        content: What stands in it.

    Raises:
        RidelabError: It is none that Ridelab can drive; the message says why.
    """
    unpacked = fmu, _, _ = unpack(content)
    horizon = _checked(fmu)
    parameters = _parameters(fmu)
    name = re.sub(r"[^a-z0-9_]+", "_", path.stem.lower()).lstrip("_0123456789") or "fmu"
    module = ModuleType(f"ridelab_controllers_fmu_{hashlib.sha256(os.fsencode(path) + content).hexdigest()[:16]}")
    module.__file__ = str(path)
    sys.modules[module.__name__] = module  # where `inspect` looks for the file
    fields: dict[str, Any] = {
        each: option(variable.start, unit=variable.unit, ge=variable.least, le=variable.most, help=variable.description)
        for each, variable in parameters.items()
    }
    preview = scenario_field("mpc.preview") if any(map(_sees_road, _inputs(fmu))) else "none"
    kind = type(
        "Fmu",
        (FmuController,),
        {
            "__doc__": fmu.text or f"The FMU {fmu.name}.",
            "__module__": module.__name__,
            "__annotations__": {each: type(variable.start) for each, variable in parameters.items()},
            "id": name,
            "label": fmu.name or name,
            "unpacked": unpacked,
            "parameters": parameters,
            "preview": preview,
            "prediction_horizon": horizon,
            **fields,
        },
    )
    return {name: kind}


def _checked(fmu: Description) -> int:
    """Return how many steps ahead its inputs look.

    Raises:
        RidelabError: It lacks a force, or wants what Ridelab does not give.
    """
    outputs = {each.name for each in fmu.variables if each.causality == "output"}
    if missing := [name for name in FORCES if name not in outputs]:
        there = ", ".join(sorted(outputs)[:20]) or "none"
        raise RefusedError(f"It has no output {' and no output '.join(missing)}; its outputs are {there}")
    horizon = 0
    for each in fmu.variables:
        if each.causality == "input":
            previewed = _PREVIEWED.fullmatch(each.name)
            if previewed is None and each.name not in _FIXED:
                raise RefusedError(f"Its input {each.name[:80]} is none that Ridelab gives; there are {_OFFERED}")
            horizon = max(horizon, int(previewed[2]) if previewed else int(each.name in _ROAD))
        if (each.causality == "input" or each.name in FORCES) and (each.type not in NUMBERS or each.is_array):
            raise RefusedError(f"Its variable {each.name[:80]} is no single number")
    return horizon


def _inputs(fmu: Description) -> list[str]:
    return [each.name for each in fmu.variables if each.causality == "input"]


def _sees_road(name: str) -> bool:
    """Check whether an input is a height of the road, of which there are as many kinds as of preview."""
    return name in _ROAD or name.startswith(_PREVIEWED_KINDS[:2])


def _parameters(fmu: Description) -> dict[str, Variable]:
    """Parameters that are numbers with a start value, by the name of the option."""
    options: dict[str, Variable] = {}
    for variable in fmu.variables:
        if variable.causality != "parameter" or variable.start is None or variable.is_array:
            continue
        name = re.sub(r"\W+", "_", variable.name, flags=re.ASCII).strip("_") or "parameter"
        name = f"p_{name}" if name[0].isdigit() else name
        while hasattr(FmuController, name) or name in options:
            name += "_"
        options[name] = variable
    return options
