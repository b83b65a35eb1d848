"""The shapes of what is answered about measured roads."""

from pydantic import Field

from backend.models import Answer


class FoundBumpAnswer(Answer):
    """A bump in the profile; with height 0 a scenario's bump there has the car brake for it, and nothing is added."""

    start: float = Field(description="Where it begins [m]")
    width: float = Field(description="[m]")
    height: float = Field(description="Above the road around it, negative in a pothole [m]")


class RoadHead(Answer):
    """A measured road."""

    id: str = Field(description="For `road.profile` of a scenario; equal heights have equal ids")
    length: float = Field(description="Greatest `road.length` on it [m]")
    samples: int = Field(description="Heights, 10 mm apart")
    bumps: list[FoundBumpAnswer] = Field(description="The largest first")


class CreatedRoad(RoadHead):
    """A road that was uploaded."""

    warnings: list[str] = Field(description="What was done to the file, and what may be wrong with it")


class RoadAnswer(RoadHead):
    """A road with its heights."""

    distance: list[float] = Field(description="About as many as asked for, peaks among them [m]")
    height: list[float] = Field(description="There [m]")
