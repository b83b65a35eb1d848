"""modelDescription.xml of FMI 2.0 and 3.0, and what else describes an FMU in its zip."""

import xml.etree.ElementTree as ET
from collections.abc import Sequence
from html import escape
from typing import Literal

from backend.fmu import programs
from backend.fmu.model import Model, Variable
from sim_core import __version__

Version = Literal["2.0", "3.0"]
GENERATED_BY = f"Ridelab {__version__}"
_UNITS = {
    "1": {},
    "m": {"m": 1},
    "s": {"s": 1},
    "kg": {"kg": 1},
    "Hz": {"s": -1},
    "m/s": {"m": 1, "s": -1},
    "m/s2": {"m": 1, "s": -2},
    "rad/s": {"rad": 1, "s": -1},
    "rad/s2": {"rad": 1, "s": -2},
    "kg.m2": {"kg": 1, "m": 2},
    "N": {"kg": 1, "m": 1, "s": -2},
    "N/m": {"kg": 1, "s": -2},
    "N.s/m": {"kg": 1, "s": -1},
    "N.s/rad": {"kg": 1, "m": 1, "s": -1, "rad": -1},
}  # in base units


def model_description(model: Model, version: Version, token: str) -> bytes:
    """Return the content of `modelDescription.xml`."""
    root = ET.Element("fmiModelDescription", fmiVersion=version, modelName=model.name, description=model.description)
    root.set("guid" if version == "2.0" else "instantiationToken", token)
    root.set("generationTool", GENERATED_BY)
    root.set("license", "Apache-2.0")
    root.set("variableNamingConvention", "structured")
    co_simulation = ET.SubElement(root, "CoSimulation", modelIdentifier=model.name)
    co_simulation.set("canHandleVariableCommunicationStepSize", "true")
    if version == "2.0":
        co_simulation.set("canNotUseMemoryManagementFunctions", "true")
        files = ET.SubElement(co_simulation, "SourceFiles")
        for name in compiled_files(model, version):
            ET.SubElement(files, "File", name=name)
    units = ET.SubElement(root, "UnitDefinitions")
    for unit in sorted({each.unit for each in model.variables} | {"s"}):
        base = {name: str(exponent) for name, exponent in _UNITS[unit].items()}
        ET.SubElement(ET.SubElement(units, "Unit", name=unit), "BaseUnit", base)
    ET.SubElement(root, "DefaultExperiment", startTime="0", stopTime="10", stepSize=repr(model.step))
    variables, structure = ET.SubElement(root, "ModelVariables"), ET.SubElement(root, "ModelStructure")
    outputs = [place for place, each in enumerate(model.variables) if each.causality == "output"]
    if version == "2.0":
        for place, variable in enumerate(model.variables):
            scalar = ET.SubElement(variables, "ScalarVariable", _common(variable, place))
            ET.SubElement(scalar, "Integer" if variable.whole else "Real", _values(variable))
        for kind in ("Outputs", "InitialUnknowns"):
            unknowns = ET.SubElement(structure, kind)
            for place in outputs:
                ET.SubElement(unknowns, "Unknown", index=str(place + 1))
    else:
        time = str(len(model.variables))
        ET.SubElement(
            variables, "Float64", name="time", valueReference=time, causality="independent", variability="continuous",
            unit="s",
        )  # fmt: skip
        for place, variable in enumerate(model.variables):
            kind = "Int32" if variable.whole else "Float64"
            ET.SubElement(variables, kind, _common(variable, place) | _values(variable))
        for kind in ("Output", "InitialUnknown"):
            for place in outputs:
                ET.SubElement(structure, kind, valueReference=str(place))
    return _text(root)


def build_description(model: Model, version: Version) -> bytes:
    """Return `sources/buildDescription.xml`, which FMI 3.0 asks for."""
    root = ET.Element("fmiBuildDescription", fmiVersion=version)
    files = ET.SubElement(ET.SubElement(root, "BuildConfiguration", modelIdentifier=model.name), "SourceFileSet")
    files.set("language", "C11")
    for name in compiled_files(model, version):
        ET.SubElement(files, "SourceFile", name=name)
    return _text(root)


def compiled_files(model: Model, version: Version) -> list[str]:
    """Return the C files that are compiled; the others are included."""
    return sorted(name for name in programs.sources(model.kind, version) if name.endswith(".c"))


def documentation(model: Model, missing: Sequence[str]) -> bytes:
    """Return `documentation/index.html`; `missing` are the platforms of which no binary is inside."""
    rows = "".join(
        f"<tr><td><code>{each.name}</code><td>{each.causality}<td>{escape(each.unit)}"
        f"<td>{'' if each.causality == 'output' else f'{each.start:g}'}<td>{escape(each.description)}"
        for each in model.variables
    )
    reason = "it was not compiled where this FMU was made; in a checkout of Ridelab `make binaries` compiles it"
    notes = [*model.notes, *(f"No binary for {platform}: {reason}." for platform in missing)]
    notes.append("The sources are inside; any C11 compiler builds them, without another file.")
    notes.append(
        "The program reads this FMU's numbers from resources/numbers.bin, which sources/resources.h describes."
    )
    return (
        f'<!doctype html><html lang="en"><meta charset="utf-8"><title>{model.name}</title>'
        f"<h1>{escape(model.description)}</h1>{''.join(f'<p>{escape(note)}</p>' for note in notes)}"
        f"<table><tr><th>Variable<th>Causality<th>Unit<th>Start<th>Description{rows}</table></html>\n"
    ).encode()


def _common(variable: Variable, place: int) -> dict[str, str]:
    constant = variable.causality == "constant"
    continuous = "discrete" if variable.whole else "continuous"
    variability = {"constant": "constant", "parameter": "fixed"}.get(variable.causality, continuous)
    return {
        "name": variable.name,
        "valueReference": str(place),
        "causality": "local" if constant else variable.causality,
        "variability": variability,
        "description": variable.description,
    }


def _values(variable: Variable) -> dict[str, str]:
    written = (lambda value: str(int(value))) if variable.whole else repr
    values = {} if variable.whole or variable.unit == "1" else {"unit": variable.unit}
    limits = {"min": variable.least, "max": variable.most}
    values |= {name: written(limit) for name, limit in limits.items() if limit is not None}
    if variable.causality != "output":
        values["start"] = written(variable.start)
    return values


def _text(root: ET.Element) -> bytes:
    ET.indent(root)
    text: bytes = ET.tostring(root, encoding="UTF-8", xml_declaration=True)
    return text + b"\n"
