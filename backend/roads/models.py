"""The shapes of what is answered about measured roads."""

from datetime import datetime

from pydantic import Field

from backend.models import Answer, CautionAnswer


class FoundBumpAnswer(Answer):
    """A bump in the profile; with height 0 a scenario's bump there has the car brake for it, and nothing is added."""

    start: float = Field(description="Where it begins [m]")
    width: float = Field(description="[m]")
    height: float = Field(description="Above the road around it, negative in a pothole [m]")


class IriAnswer(Answer):
    """International Roughness Index (ASTM E1926) of the heights as they came."""

    tracks: list[float] = Field(description="Of each wheel track, left before right [m/km]")
    mean: float = Field(description="Of the tracks [m/km]")


class EstimateAnswer(Answer):
    """A fitted value with its 95 % interval."""

    value: float
    low: float
    high: float


class SpectrumAnswer(Answer):
    """Displacement PSD, smoothed in the bands of ISO 8608."""

    frequency: list[float] = Field(description="Centres of the bands [1/m]")
    density: list[float] = Field(description="Mean PSD in each, of all tracks [m³]")


class RoadAnalysis(Answer):
    """What the heights of a file amount to as they came; all null where that file is not known any more."""

    iri: IriAnswer | None = None
    iso_class: str | None = Field(
        None,
        description="Road class of ISO 8608 by `roughness`, A to H; null below 20 m, and where the interval of "
        "`roughness` spans more than a factor of 16, which a caution of kind `spectrum` then says",
    )
    roughness: EstimateAnswer | None = Field(None, description="Gd(n0) of the line fitted to `spectrum` [m³]")
    waviness: EstimateAnswer | None = Field(None, description="Its negative slope w: Gd(n) = Gd(n0) (n/n0)^-w")
    spectrum: SpectrumAnswer | None = None


class RoadHead(RoadAnalysis):
    """A measured road."""

    id: str = Field(description="For `road.profile` of a scenario; equal heights have equal ids")
    length: float = Field(description="Greatest `road.length` on it [m]")
    samples: int = Field(description="Heights, 10 mm apart")
    bumps: list[FoundBumpAnswer] = Field(description="The largest first")
    cautions: list[CautionAnswer] = Field(description="What its heights have that a road's hardly have")


class CreatedRoad(RoadHead):
    """A road that was uploaded."""

    warnings: list[str] = Field(description="What was done to the file, and what may be wrong with it")


class RoadAnswer(RoadHead):
    """A road with its heights."""

    distance: list[float] = Field(description="About as many as asked for, peaks among them [m]")
    height: list[float] = Field(description="There [m]")


class RoadRow(Answer):
    """A road in a list."""

    id: str
    length: float = Field(description="[m]")
    samples: int
    created_at: datetime = Field(description="When it was last sent")


class RoadPage(Answer):
    """The newest roads."""

    roads: list[RoadRow]
    next: str | None = Field(description="Cursor of the next page; null: this is the last one")
