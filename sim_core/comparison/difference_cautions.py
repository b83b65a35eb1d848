"""Warnings about results of different roads or scenarios."""

from collections.abc import Iterator, Mapping, Sequence
from typing import Any

from sim_core.comparison.caution import Caution
from sim_core.comparison.rows import Row
from sim_core.comparison.verdict import begin_sentence
from sim_core.scenario import Scenario

MOST_FIELDS = 3  # that one sentence names
_TUNED = "fuzzy", "mpc", "lqr", "hook", "own"  # what belongs to a strategy: to compare two of them is no fault


def difference_cautions(scenario: Scenario, reference: Scenario, row: Row, baseline: str) -> tuple[Caution, ...]:
    """Return the warnings of a result whose scenario is not that of the baseline's result.

    Args:
        scenario: What was driven.
        reference: What the baseline was driven in.
        row: The strategy.
        baseline: The baseline's label.

    Returns:
        `other_road` where the roads differ, `other_scenario` where the car, its speed or its sensors do. A controller's
        own parameters may differ.
    """
    fields = list(_different(scenario.model_dump(), reference.model_dump()))
    roads = [field for field in fields if field.startswith("road.")]
    others = [field for field in fields if field.partition(".")[0] not in ("road", *_TUNED)]
    subject, cautions = begin_sentence(row.label), []
    if roads:
        text = (
            f"{subject} was driven on another road than {baseline} ({_names(roads)}): part of a difference comes "
            "from the road."
        )
        cautions.append(Caution(kind="other_road", text=text, field=roads[0], strategy=row.key))
    if others:
        text = (
            f"{subject} was driven in another scenario than {baseline} ({_names(others)}): part of a difference may "
            "come from that."
        )
        cautions.append(Caution(kind="other_scenario", text=text, field=others[0], strategy=row.key))
    return tuple(cautions)


def _different(one: Mapping[str, Any], other: Mapping[str, Any], part: str = "") -> Iterator[str]:
    """Return the dotted names of the fields in which two scenarios differ."""
    for name in dict.fromkeys([*one, *other]):
        value, reference = one.get(name), other.get(name)
        if isinstance(value, Mapping) and isinstance(reference, Mapping):
            yield from _different(value, reference, f"{part}{name}.")
        elif value != reference:
            yield f"{part}{name}"


def _names(fields: Sequence[str]) -> str:
    more = len(fields) - MOST_FIELDS
    return ", ".join(fields[:MOST_FIELDS]) + (f" and {more} more" if more > 0 else "")
