"""The problem kinds the service answers with, from problem_kinds.toml; docs/reference/api.md and OpenAPI show them."""

import tomllib
from dataclasses import dataclass
from pathlib import Path

TYPES = "urn:problem-type:ridelab:"


@dataclass(frozen=True, slots=True, kw_only=True)
class ProblemKind:
    """One kind of problem (RFC 9457).

    Attributes:
        name: End of its `type`, for machines.
        statuses: HTTP statuses it comes with, nearly always one.
        title: The same for every such problem; the name in words unless the file has another.
        meaning: What happened; the default of `detail`.
        remedy: What whoever asked can do about it.
    """

    name: str
    statuses: tuple[int, ...]
    title: str
    meaning: str
    remedy: str


def _read() -> dict[str, ProblemKind]:
    """Return the kinds of problem_kinds.toml by name, in its order."""
    file = Path(__file__).with_name("problem_kinds.toml")
    return {
        name: ProblemKind(
            name=name,
            statuses=tuple(entry["statuses"]),
            title=entry.get("title", name.replace("-", " ").capitalize()),
            meaning=entry["meaning"],
            remedy=entry["remedy"],
        )
        for name, entry in tomllib.loads(file.read_text(encoding="utf-8")).items()
    }


KINDS = _read()
OF_STATUS = {status: kind for kind in reversed(KINDS.values()) for status in kind.statuses}
