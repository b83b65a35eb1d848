"""An FMU's zip."""

import hashlib
import json
from collections.abc import Sequence

from backend.custom_controllers.registry import run_in_sandbox_process
from backend.ecu.export import zipped
from backend.fmu.binaries import PLATFORMS, binaries
from backend.fmu.controller import controller_model
from backend.fmu.description import (
    Version,
    build_description,
    compiled_files,
    documentation,
    model_description,
)
from backend.fmu.model import Model, sources, variables_header
from backend.fmu.vehicle import vehicle_model
from sim_core.ecu.sources import SOURCES as ECU_SOURCES
from sim_core.scenario import Scenario

LICENCE = ECU_SOURCES.parent.parent / "LICENSE"


def fmu(
    scenario: Scenario, strategy: str, of: str, version: Version, platforms: Sequence[str] = tuple(PLATFORMS)
) -> bytes:
    """The scenario's controller or vehicle as an FMU.

    Raises:
        UnknownNameError: No such strategy.
        RidelabError: The strategy's controller cannot be exported.
    """
    model = (
        vehicle_model(scenario)
        if of == "vehicle"
        else run_in_sandbox_process(strategy, controller_model, scenario, strategy)
    )
    return _zipped(model, scenario, version, platforms)


def _zipped(model: Model, scenario: Scenario, version: Version, platforms: Sequence[str]) -> bytes:
    own = {**model.sources, **sources([f"fmi{version[0]}.c"])}
    token = "{" + hashlib.sha256(repr((version, model, sorted(own.items()))).encode()).hexdigest()[:32] + "}"
    own["ridelab_variables.h"] = variables_header(model, token)
    built, missing = binaries(model.name, own, compiled_files(model, version), version, platforms)
    plain = json.dumps(scenario.model_dump(mode="json"), indent=1) + "\n"
    licence = "documentation/license.txt" if version == "2.0" else "documentation/licenses/license.txt"
    content = {
        "modelDescription.xml": model_description(model, version, token),
        **built,
        **{f"sources/{name}": text.encode() for name, text in sorted(own.items())},
        "documentation/index.html": documentation(model, missing),
        licence: LICENCE.read_bytes(),
        "resources/scenario.json": plain.encode(),
    }
    if version == "3.0":
        content["sources/buildDescription.xml"] = build_description(model, version)
    return zipped(content)
