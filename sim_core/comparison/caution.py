"""Something that a reader of results should beware of."""

from dataclasses import dataclass


@dataclass(frozen=True, slots=True, kw_only=True)
class Caution:
    """A fact about a scenario, a road or a result that makes its numbers mean less than they seem to.

    Attributes:
        kind: What it is about, as a name that programs can rely on, such as `"sag"`.
        text: One or more whole sentences for a person, with the numbers and units that led to it.
        field: The dotted scenario field to look at, such as `"vehicle.body_mass"`; None where there is none.
        strategy: The id of the strategy that it applies to; None where it applies to all.

    Example:
        >>> from sim_core import Caution
        >>> sag = Caution(kind="sag", text="The body sinks by 365 mm.", field="vehicle.body_mass")
        >>> sag.strategy is None
        True
    """

    kind: str
    text: str
    field: str | None = None
    strategy: str | None = None
