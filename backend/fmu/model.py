"""What is inside an FMU of any version: variables by name, and the numbers that its program reads."""

import struct
import zlib
from collections.abc import Iterable, Iterator, Sequence
from dataclasses import dataclass
from typing import Literal, get_args

import numpy as np

from sim_core.arrays import FloatArray

Causality = Literal["input", "output", "parameter", "constant"]  # in the order of source/resources.h


@dataclass(frozen=True, slots=True, kw_only=True)
class Variable:
    """A number that has a name; its value reference is its place.

    Attributes:
        name: As the importer shows it.
        causality: What it is; a constant is told, and never set.
        description: In words.
        unit: SI, as FMI writes it; 1 for none.
        start: Its value before anything sets it; of an output none is told.
        whole: Whether it is a whole number.
        least: Smallest value; None for no limit.
        most: Largest one.
    """

    name: str
    causality: Causality
    description: str
    unit: str = "1"
    start: float = 0.0
    whole: bool = False
    least: float | None = None
    most: float | None = None


@dataclass(frozen=True, slots=True, eq=False, kw_only=True)
class Model:
    """A model, which is a program and the numbers that it reads.

    Attributes:
        kind: Which program it is, one of `programs.KINDS`.
        name: Of its files, a C identifier.
        description: In words.
        variables: In the order of their value references.
        numbers: What its program takes from its resources, in the order of its C.
        step: Communication step that suits it [s].
        notes: Paragraphs for whoever uses it.
    """

    kind: str
    name: str
    description: str
    variables: Sequence[Variable]
    numbers: FloatArray
    step: float
    notes: Sequence[str]


def array(
    name: str, causality: Causality, descriptions: Iterable[str], units: Iterable[str], starts: Iterable[float] = ()
) -> Iterator[Variable]:
    """Variables `name[1]`, `name[2]` … of as many descriptions."""
    start = iter(starts)
    for i, (description, unit) in enumerate(zip(descriptions, units, strict=False), 1):
        yield Variable(
            name=f"{name}[{i}]", causality=causality, description=description, unit=unit, start=next(start, 0.0)
        )


def resources(model: Model, token: str) -> bytes:
    """Return `resources/numbers.bin` as source/resources.h describes it."""
    variables = model.variables
    causalities = get_args(Causality)
    text = "".join(f"{each}\0" for each in (token, *(variable.name for variable in variables))).encode()
    text += bytes(-len(text) % 8)
    numbers = np.concatenate(
        [
            [len(variables)],
            [causalities.index(each.causality) for each in variables],
            [each.whole for each in variables],
            [each.start for each in variables],
            model.numbers,
        ]
    )
    body = struct.pack("<I", len(text)) + text + numbers.astype("<f8").tobytes()
    return b"RIDELAB1" + struct.pack("<I", zlib.crc32(body)) + body
