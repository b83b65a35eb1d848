"""What modelDescription.xml says of an FMU (FMI 2.0.4, chapters 2.2 and 4.3; FMI 3.0.2, chapters 2.4 and 4.4)."""

import re
import xml.etree.ElementTree as ET
from collections.abc import Iterator
from dataclasses import dataclass

from sim_core.errors import RefusedError

_IDENTIFIER = re.compile(r"[A-Za-z_]\w*", re.ASCII)
_WHOLE = {"Integer", "Int8", "UInt8", "Int16", "UInt16", "Int32", "UInt32", "Int64", "UInt64"}
_REAL = {"Real", "Float32", "Float64"}
NUMBERS = {*_REAL, *_WHOLE, "Boolean"}


@dataclass(frozen=True, slots=True, kw_only=True)
class Variable:
    """A variable of an FMU; `start`, `least` and `most` are None where nothing is said."""

    name: str
    reference: int
    type: str
    causality: str
    variability: str
    description: str
    unit: str
    start: float | int | bool | None
    least: float | None
    most: float | None
    is_array: bool


@dataclass(frozen=True, slots=True, kw_only=True)
class Description:
    """An FMU for co-simulation; `version` is 2 or 3, `token` its GUID or instantiation token."""

    version: int
    name: str
    text: str
    token: str
    identifier: str
    variables: tuple[Variable, ...]


def read_description(content: bytes) -> Description:
    """Return what the file says.

    Raises:
        RidelabError: It is none, or of an FMU that cannot be driven here; the message says why.
    """
    if b"<!DOCTYPE" in content or b"<!ENTITY" in content:
        raise RefusedError("modelDescription.xml has a document type, which the standard has not")
    try:
        root = ET.fromstring(content)  # noqa: S314 - without entities, and of a file that its owner trusts with code
    except ET.ParseError as error:
        raise RefusedError(f"modelDescription.xml is not well-formed: {error}") from None
    version = root.get("fmiVersion", "")
    if root.tag != "fmiModelDescription" or version.partition(".")[0] not in ("2", "3"):
        raise RefusedError(f"It is of FMI {version or 'without a version'}; 2.0 and 3.0 are driven here")
    own = root.find("CoSimulation")
    if own is None:
        raise RefusedError("It is for model exchange alone; Ridelab drives FMUs for co-simulation")
    identifier, token = own.get("modelIdentifier", ""), root.get("guid") or root.get("instantiationToken") or ""
    if not _IDENTIFIER.fullmatch(identifier):
        raise RefusedError("Its modelIdentifier is no C identifier")
    return Description(
        version=int(version[0]),
        name=root.get("modelName", identifier),
        text=root.get("description", ""),
        token=token,
        identifier=identifier,
        variables=tuple(_variables(root.find("ModelVariables"), version)),
    )


def _variables(listed: ET.Element | None, version: str) -> Iterator[Variable]:
    for element in () if listed is None else listed:
        typed = element if version[0] == "3" else next(iter(element), element)
        name = element.get("name", "")
        try:
            yield Variable(
                name=name,
                reference=int(element.get("valueReference", "")),
                type=typed.tag,
                causality=element.get("causality", "local"),
                variability=element.get("variability", "continuous"),
                description=element.get("description", ""),
                unit=typed.get("unit", "1"),
                start=_start(typed),
                least=_number(typed.get("min")),
                most=_number(typed.get("max")),
                is_array=typed.find("Dimension") is not None,
            )
        except ValueError:
            raise RefusedError(f"Its variable {name[:80]} has a value reference or a number that is none") from None


def _number(text: str | None) -> float | None:
    return None if text is None else float(text)


def _start(typed: ET.Element) -> float | int | bool | None:
    text = typed.get("start")
    if text is None or typed.tag not in NUMBERS or typed.find("Dimension") is not None:
        return None
    if typed.tag == "Boolean":
        return text in ("true", "1")
    return int(text) if typed.tag in _WHOLE else float(text)
