"""What is inside an FMU of any version: variables by name, C sources, and the C that says where each variable is."""

from collections.abc import Iterable, Iterator, Mapping, Sequence
from dataclasses import dataclass
from pathlib import Path
from typing import Literal

SOURCES = Path(__file__).parent / "source"
Causality = Literal["input", "output", "parameter", "constant"]
_LETTER = {"input": "i", "output": "o", "parameter": "p", "constant": "c"}


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


@dataclass(frozen=True, slots=True, kw_only=True)
class Model:
    """One model.

    Attributes:
        name: Of its files, a C identifier.
        description: In words.
        variables: In the order of their value references.
        sources: C text by file name, headers too.
        sizes: Macros of the C that says where variables are.
        step: Communication step that suits it [s].
        notes: Paragraphs for whoever uses it.
    """

    name: str
    description: str
    variables: Sequence[Variable]
    sources: Mapping[str, str]
    sizes: Mapping[str, float]
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


def sources(names: Iterable[str], folder: Path = SOURCES) -> dict[str, str]:
    """C files of a folder by name."""
    return {name: (folder / name).read_text(encoding="utf-8") for name in names}


def variables_header(model: Model, token: str) -> str:
    """`ridelab_variables.h`: where each variable is, what it is, what it begins with."""
    places: dict[str, int] = {}
    for place, variable in enumerate(model.variables):
        places.setdefault(f"V_{variable.name.partition('[')[0].upper()}", place)
    enumerators = ", ".join(f"{name} = {place}" for name, place in places.items())
    marks = {
        "RIDELAB_CAUSALITY": "".join(_LETTER[each.causality] for each in model.variables),
        "RIDELAB_WHOLE": "".join(str(int(each.whole)) for each in model.variables),
        "RIDELAB_TOKEN": token,
    }
    lines = ["/* Generated. */", "#ifndef RIDELAB_VARIABLES_H", "#define RIDELAB_VARIABLES_H", ""]
    lines += [f'#define {name} "{text}"' for name, text in marks.items()]
    lines += [f"#define {name} {value!r}" for name, value in model.sizes.items()]
    lines.append(f"#define RIDELAB_START {{{', '.join(repr(float(each.start)) for each in model.variables)}}}")
    lines += [f"enum {{ {enumerators}, VARIABLES = {len(model.variables)} }};", "", "#endif", ""]
    return "\n".join(lines)
