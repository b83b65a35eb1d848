"""Where the paper is silent or misprinted and a reader may choose: open questions and their choices, and named sets.

All are data, interpretations.toml; each choice is a few fields of the scenario. Three sets have a name: the paper as
Ridelab reads it, as most of its printed changes are reached, and as its printed absolutes come out nearest. In answers
and addresses a question is called a reading.
"""

import tomllib
from collections.abc import Mapping
from dataclasses import dataclass, field
from pathlib import Path
from typing import Any

from sim_core.errors import UnknownNameError

OURS = "ours"
TYRE_LOADS = "tyre_loads"  # the question that changes no run, only how tyre loads are shown

_LOADS = ("front_tyre_load", "rear_tyre_load")

# First and last position of the front axle [m].
Intervals = tuple[tuple[float, float], ...]


@dataclass(frozen=True, slots=True, kw_only=True)
class Choice:
    """One answer to an open question.

    Attributes:
        id: Stable name.
        label: Short, for a switch.
        source: The sentence or equation of the paper that has it, or `OURS`.
        changes: The fields it changes, by dotted name.
        intervals: Where the RMS on the rough road are taken, of a choice of the question `window`; None is up to the
            bump.
        load_factor: By which tyre loads are multiplied where they are shown, of a choice of the question `tyre_loads`.
    """

    id: str
    label: str
    source: str
    changes: Mapping[str, Any] = field(default_factory=dict)
    intervals: Intervals | None = None
    load_factor: float = 1.0


@dataclass(frozen=True, slots=True, kw_only=True)
class OpenQuestion:
    """A question that the paper leaves open; Ridelab's choice is the first."""

    id: str
    title: str
    description: str
    choices: tuple[Choice, ...]

    @property
    def default(self) -> str:
        """Ridelab's choice."""
        return self.choices[0].id

    def choice(self, name: str) -> Choice:
        """Return the choice of that id.

        Raises:
            UnknownNameError: There is none; the message lists them.
        """
        for each in self.choices:
            if each.id == name:
                return each
        raise UnknownNameError(f"Unknown choice; there are {', '.join(each.id for each in self.choices)}")


@dataclass(frozen=True, slots=True, kw_only=True)
class Interpretation:
    """A named set of choices; `otherwise` has those that are not the default, by question."""

    id: str
    title: str
    description: str
    otherwise: Mapping[str, str]

    @property
    def choices(self) -> dict[str, str]:
        """Question -> choice, all of them."""
        return {each.id: self.otherwise.get(each.id, each.default) for each in OPEN_QUESTIONS.values()}


def _question(entry: dict[str, Any]) -> OpenQuestion:
    return OpenQuestion(choices=tuple(Choice(**each) for each in entry.pop("choice")), **entry)


DATA = tomllib.loads(Path(__file__).with_name("interpretations.toml").read_text(encoding="utf-8"))
OPEN_QUESTIONS = {entry["id"]: _question(entry) for entry in DATA["question"]}
INTERPRETATIONS = {entry["id"]: Interpretation(**entry) for entry in DATA["interpretation"]}
DEFAULT, FAVOURABLE, NEAREST = (INTERPRETATIONS[name] for name in ("default", "favourable", "nearest"))


def open_question(name: str) -> OpenQuestion:
    """Return the question of that id.

    Raises:
        UnknownNameError: There is none; the message lists the ids.
    """
    try:
        return OPEN_QUESTIONS[name]
    except KeyError:
        raise UnknownNameError(f"Unknown reading; there are {', '.join(OPEN_QUESTIONS)}") from None


def load_factor(choices: Mapping[str, str], signal: str) -> float:
    """Return by what a signal's absolutes are multiplied where they are shown: 2 for doubled tyre loads, else 1.

    Raises:
        UnknownNameError: There is no such choice.
    """
    question = open_question(TYRE_LOADS)
    return question.choice(choices.get(TYRE_LOADS, question.default)).load_factor if signal in _LOADS else 1.0


def changes_of(choices: Mapping[str, str]) -> dict[str, Any]:
    """Return the scenario's fields under these choices, by dotted name; questions not named take Ridelab's choice.

    Raises:
        UnknownNameError: No such question or choice.
    """
    changes: dict[str, Any] = {}
    for name, choice in choices.items():
        changes |= open_question(name).choice(choice).changes
    return changes


def interpretation_of(choices: Mapping[str, str]) -> str | None:
    """Return the id of the set that makes just these choices (question -> choice, all of them), if one does."""
    return next((each.id for each in INTERPRETATIONS.values() if each.choices == choices), None)
