"""Named sets of readings: the paper as Ridelab reads it, and as most of its printed changes are reached."""

from collections.abc import Mapping
from dataclasses import dataclass

from backend.paper.readings import READINGS


@dataclass(frozen=True, slots=True, kw_only=True)
class Interpretation:
    """A named set of choices; `otherwise` has those that are not the default, by reading."""

    id: str
    title: str
    description: str
    otherwise: Mapping[str, str]

    @property
    def choices(self) -> dict[str, str]:
        """Reading -> choice, all of them."""
        return {each.id: self.otherwise.get(each.id, each.default) for each in READINGS.values()}


DEFAULT = Interpretation(
    id="default",
    title="Default",
    description="Every switch as Ridelab reads the paper.",
    otherwise={},
)
FAVOURABLE = Interpretation(
    id="favourable",
    title="Favourable",
    description="No braking moment (Eq. 7 as printed) and RMS over the full course (section 4.2.2); a control interval "
    "and limits, all ours, that leave the controllers room.",
    otherwise={
        "window": "full_course",
        "braking_moment": "off",
        "sample_time": "5",
        "force_limit": "20",
        "travel_limit": "100",
    },
)
INTERPRETATIONS = {each.id: each for each in (DEFAULT, FAVOURABLE)}


def interpretation_of(choices: Mapping[str, str]) -> str | None:
    """The id of the set that makes just these choices (reading -> choice, all of them), if one does."""
    return next((each.id for each in INTERPRETATIONS.values() if each.choices == choices), None)
