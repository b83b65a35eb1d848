"""The shapes of what is answered about lists: presets, vehicles, strategies, the catalogue, kinds of problem."""

from pydantic import Field

from backend.json_types import JsonObject
from backend.models import Answer, CautionAnswer, CharacteristicsAnswer, Source
from sim_core.scenario import Scenario, Vehicle


class PresetAnswer(Answer):
    """A named scenario."""

    id: str
    label: str
    description: str
    scenario: Scenario


class ConditionAnswer(Answer):
    """That a field of the scenario has one of some values."""

    field: str = Field(
        description="Its dotted name; `road.has_bump` is no field, but whether the bump's end is on the road"
    )
    values: list[str | bool | float | None] = Field(description="One of these")
    excluded: bool = Field(description="Whether it must have none of them instead")


class ConditionalReadsAnswer(Answer):
    """Fields on which a result depends where all of some conditions hold."""

    fields: list[str] = Field(description="Dotted names of fields, and of whole parts")
    conditions: list[ConditionAnswer] = Field(description="Without one it always does")


class StrategyAnswer(Answer):
    """A strategy: what it does, which parts of the scenario it reads, how it is drawn."""

    id: str
    label: str
    description: str
    reads: list[str]
    reads_when: list[ConditionalReadsAnswer] = Field(
        description="All that its result may depend on, at any speed policy, with the conditions under which it does: "
        "a field has an effect where all conditions of one entry with it hold"
    )
    colour: str
    dark_colour: str = Field(description="On a dark background")
    dash: str
    own: bool = Field(description="Whether it comes from a file or a package of the operator's")
    source: Source | None = Field(description="Of one's own; null for Ridelab's")
    options: JsonObject = Field(description="JSON Schema of its options, which a scenario sets as `own.ID.OPTION`")
    fault: str | None = Field(description="Why it cannot be driven at the moment: what is wrong with its file")
    one_road_resolution: dict[str, float] = Field(
        description="Smaller changes [%] on one road may be random variation; by statistic, comfort metrics as an RMS. "
        "Of two strategies the larger one counts"
    )


class ProblemAnswer(Answer):
    """One kind of problem, by which programs go."""

    name: str = Field(description="The end of its `type`, which is `urn:problem-type:ridelab:` and this")
    statuses: list[int] = Field(description="HTTP statuses it comes with, nearly always one")
    title: str
    meaning: str = Field(description="What happened")
    remedy: str = Field(description="What whoever asked can do about it")


class QuantityAnswer(Answer):
    """One named quantity; unit `1` for none."""

    key: str
    label: str
    unit: str
    symbol: str
    description: str
    notable: float = Field(description="From this size on an event is worth a warning; 0 for what warns of nothing")


class Catalogue(Answer):
    """Everything that has a name and a unit."""

    signals: list[QuantityAnswer]
    metric_signals: list[str]
    paper_signals: list[str]
    windows: list[QuantityAnswer]
    statistics: list[QuantityAnswer]
    stages: list[QuantityAnswer]
    comfort: list[QuantityAnswer]
    events: list[QuantityAnswer]
    run_figures: list[QuantityAnswer]
    references: list[QuantityAnswer]


class VehicleAnswer(Answer):
    """A vehicle with its sources; one track of the car, as every half-car here."""

    id: str
    label: str
    description: str
    vehicle: Vehicle
    characteristics: CharacteristicsAnswer
    cautions: list[CautionAnswer]
    sources: list[str] = Field(description="Where its numbers are from")
    derived: list[str] = Field(description="How those follow that no source has")


class HalfCarAnswer(Answer):
    """The half-car that a data sheet makes."""

    vehicle: Vehicle
    characteristics: CharacteristicsAnswer
    cautions: list[CautionAnswer]
