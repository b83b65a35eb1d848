"""An FMU's zip."""

import hashlib
import json
from collections.abc import Sequence

from backend.custom_controllers.registry import run_in_sandbox_process
from backend.ecu.export import zipped
from backend.fmu import programs
from backend.fmu.controller import controller_model
from backend.fmu.description import Version, build_description, documentation, model_description
from backend.fmu.model import Model, resources
from backend.fmu.vehicle import vehicle_model
from sim_core.ecu.sources import SOURCES as ECU_SOURCES
from sim_core.scenario import Scenario

LICENCE = ECU_SOURCES.parent.parent / "LICENSE"


def fmu(
    scenario: Scenario, strategy: str, of: str, version: Version, platforms: Sequence[str] = tuple(programs.PLATFORMS)
) -> bytes:
    """Return the scenario's controller or vehicle as an FMU.

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
    sources = programs.sources(model.kind, version)
    content_hash = hashlib.sha256(repr((version, sorted(sources.items()))).encode() + resources(model, ""))
    token = f"{{{content_hash.hexdigest()[:32]}}}"
    files = {wanted: programs.binary(model.kind, version, wanted) for wanted in platforms}
    missing = [wanted for wanted, file in files.items() if not file.is_file()]
    plain = json.dumps(scenario.model_dump(mode="json"), indent=1) + "\n"
    licence = "documentation/license.txt" if version == "2.0" else "documentation/licenses/license.txt"
    content = {
        "modelDescription.xml": model_description(model, version, token),
        **{
            f"binaries/{wanted if version == '2.0' else programs.PLATFORMS[wanted].name}/{model.name}{file.suffix}": (
                file.read_bytes()
            )
            for wanted, file in files.items()
            if wanted not in missing
        },
        **{f"sources/{name}": text.encode() for name, text in sorted(sources.items())},
        "documentation/index.html": documentation(model, missing),
        licence: LICENCE.read_bytes(),
        "resources/numbers.bin": resources(model, token),
        "resources/scenario.json": plain.encode(),
    }
    if version == "3.0":
        content["sources/buildDescription.xml"] = build_description(model, version)
    return zipped(content)
