"""The road of a scenario: its roughness or a measured profile, and the bumps on it."""

from dataclasses import dataclass
from math import pi
from typing import Annotated, Any, Literal, get_args

from pydantic import BeforeValidator, Field, PrivateAttr
from pydantic_core import PydanticCustomError

from sim_core.scenario.fields import ADDED, Part, quantity
from sim_core.scenario.measured import ID_PATTERN, MeasuredRoad

MAX_SEED = 2**32 - 1
Seed = Annotated[int, quantity("1", soft=(1, 20), ge=0, le=MAX_SEED)]
RearAxle = Literal["in_turn", "together"]
BumpShape = Literal["cosine", "half_sine", "circular", "flat_top", "trapezoid", "kerb"]


@dataclass(frozen=True, slots=True, kw_only=True)
class ShapeFacts:
    """What has to be known of a shape beside its heights, which sim_core/kernel/road.c has.

    Attributes:
        steepest: Slope of one that is as high as it is wide; None where it depends on the height otherwise.
        ascent: Over which part of the width it rises and falls once.
        kinks: At which shares of the width the slope jumps.
        stays_up: Whether the road stays up behind it.
    """

    steepest: float | None
    ascent: float = 1.0
    kinks: tuple[float, ...] = ()
    stays_up: bool = False


SHAPES: dict[BumpShape, ShapeFacts] = {
    "cosine": ShapeFacts(steepest=pi),
    "half_sine": ShapeFacts(steepest=pi, kinks=(0.0, 1.0)),
    "circular": ShapeFacts(steepest=None, kinks=(0.0, 1.0)),
    "flat_top": ShapeFacts(steepest=2 * pi, ascent=0.5),
    "trapezoid": ShapeFacts(steepest=4.0, ascent=0.5, kinks=(0.0, 0.25, 0.75, 1.0)),
    "kerb": ShapeFacts(steepest=pi / 2, ascent=2.0, stays_up=True),
}


class Bump(Part):
    """The obstacle, or several alike in a row, added to the roughness (Eq. 2-3)."""

    shape: BumpShape = "cosine"
    height: Annotated[float, quantity("m", soft=(-0.15, 0.2), ge=-1, le=1, shown="cm")] = 0.1
    width: Annotated[float, quantity("m", soft=(0.3, 10), ge=0.05, le=100)] = 4
    start: Annotated[float, quantity("m", soft=(30, 130), ge=1, le=3000)] = 100
    count: Annotated[int, quantity("1", soft=(1, 10), ge=1, le=200), ADDED] = 1
    spacing: Annotated[float, quantity("m", soft=(0.3, 20), ge=0.05, le=1000), ADDED] = 10

    @property
    def length(self) -> float:
        """Return the distance from the start of the first bump to the end of the last [m]."""
        return (self.count - 1) * self.spacing + self.width

    @property
    def end(self) -> float:
        """Return where the last bump ends [m]."""
        return self.start + self.length


RoadClass = Literal["A", "B", "C", "D", "E", "F", "G", "H"]
CLASS_MEANS = {name: 16e-6 * 4**index for index, name in enumerate(get_args(RoadClass))}  # ISO 8608, table C.1 [m^3]


def _class_mean(value: Any) -> Any:
    """Return the mean roughness of a class that is named; anything else as it is."""
    if not isinstance(value, str):
        return value
    if value not in CLASS_MEANS:
        raise PydanticCustomError("road_class", "Input should be a number or a road class of ISO 8608, A to H")
    return CLASS_MEANS[value]


MAX_ROUGHNESS = CLASS_MEANS["H"]
_BY_CLASS = BeforeValidator(
    _class_mean, json_schema_input_type=Annotated[float, Field(ge=0, le=MAX_ROUGHNESS)] | RoadClass
)


class Road(Part):
    """Rough road made in space by ISO 8608, or a measured one, with bumps (section 2.1)."""

    roughness: Annotated[float, quantity("m^3", soft=(0, 1024e-6), ge=0, le=MAX_ROUGHNESS), _BY_CLASS] = 64e-6
    seed: Seed = 1
    length: Annotated[float, quantity("m", soft=(110, 300), ge=5, le=3000)] = 150
    profile: Annotated[str | None, ADDED] = Field(default=None, pattern=ID_PATTERN)
    rear_axle: Annotated[RearAxle, ADDED] = "in_turn"
    bump: Bump = Bump()
    _measured: MeasuredRoad | None = PrivateAttr(None)

    @property
    def measured(self) -> MeasuredRoad | None:
        """Return the heights of `profile`, where `Scenario.on` got them; never those of another road."""
        return self._measured if self._measured is not None and self._measured.id == self.profile else None

    @property
    def ends_with_profile(self) -> bool:
        """Check whether its length is that of its `profile`, which `Scenario.on` sets: none was given."""
        return self.profile is not None and "length" not in self.model_fields_set

    @property
    def follows_profile(self) -> bool:
        """Check whether its length, or the place of a bump of height 0, is its profile's, as `Scenario.on` sets it."""
        has_place = self.bump.height or "start" in self.bump.model_fields_set
        return self.ends_with_profile or (self.profile is not None and not has_place)

    @property
    def has_bump(self) -> bool:
        """Check whether there is a bump, or with height 0 a place of one: beyond the road's end there is none."""
        return self.bump.end <= self.length

    @property
    def is_smooth(self) -> bool:
        """Check whether there is nothing but the bumps."""
        return self.profile is None and not self.roughness
