"""The fuzzy speed controller's rule base: sets of speed error, distance and torque, and the rules between them."""

from collections.abc import Callable, Iterator
from typing import Annotated, Literal, Self

from pydantic import AfterValidator, Field, ValidationInfo, field_validator, model_validator
from pydantic_core import PydanticCustomError

from sim_core.scenario.fields import Part, at

SET_NAMES = ("O", "S", "M", "L", "V")  # Table 1's: very low, medium-low, medium, medium-high, very high
SPEED_ERROR_MAX = 30.0  # universe [0, 30] km/h
DISTANCE_MAX = 80.0  # universe [0, 80] m
MOST_SETS, MOST_RULES = 20, 400
_NARROWEST = 1e-6  # width and slope: narrower ones would divide by nothing

Function = Literal["trimf", "trapmf", "gaussmf", "gauss2mf", "gbellmf", "sigmf", "smf", "zmf", "pimf"]
# What each membership function takes, in words; how many numbers; and whether it takes these.
_TAKES: dict[Function, tuple[str, int, Callable[..., bool]]] = {
    "trimf": ("three ascending corners, not all alike", 3, lambda a, b, c: a <= b <= c and a < c),
    "trapmf": ("four ascending corners, not all alike", 4, lambda a, b, c, d: a <= b <= c <= d and a < d),
    "gaussmf": ("a mean and a width above 0", 2, lambda mean, width: width >= _NARROWEST),
    "gauss2mf": (
        "two means in ascending order, each followed by a width above 0",
        4,
        lambda mean, width, second, its_width: mean <= second and min(width, its_width) >= _NARROWEST,
    ),
    "gbellmf": (
        "a width and a slope above 0, and a centre",
        3,
        lambda width, slope, centre: min(width, slope) >= _NARROWEST,
    ),
    "sigmf": ("a centre and a slope", 2, lambda centre, slope: True),
    "smf": ("a foot and a ceiling above it", 2, lambda foot, ceiling: foot < ceiling),
    "zmf": ("a ceiling and a foot above it", 2, lambda ceiling, foot: ceiling < foot),
    "pimf": ("a foot, a ceiling, its end and a foot, ascending", 4, lambda a, b, c, d: a < b <= c < d),
}


class FuzzySet(Part):
    """A set by its membership function: one of scikit-fuzzy's by name, and its arguments in their order there."""

    name: Annotated[str, Field(pattern=r"^[A-Za-z0-9_-]{1,30}$")]
    function: Function
    corners: Annotated[tuple[Annotated[float, Field(ge=-10_000, le=10_000)], ...], Field(strict=False)]

    @field_validator("corners", mode="after")
    @classmethod
    def _as_the_function_takes_them(cls, corners: tuple[float, ...], info: ValidationInfo) -> tuple[float, ...]:
        if "function" in info.data:
            words, number, takes = _TAKES[info.data["function"]]
            if len(corners) != number or not takes(*corners):
                raise PydanticCustomError(
                    "corners", "{function} takes {words}", {"function": info.data["function"], "words": words}
                )
        return corners


def _not_empty(items: tuple[Part, ...]) -> tuple[Part, ...]:
    if not items:  # pydantic's own `min_length` leaves out items that are wrong, and would blame the list too
        raise PydanticCustomError("empty", "There has to be at least one")
    return items


_NOT_EMPTY = AfterValidator(_not_empty)


def _different_names(sets: tuple[FuzzySet, ...]) -> tuple[FuzzySet, ...]:
    names = [each.name for each in sets]
    if len(set(names)) < len(names):
        raise PydanticCustomError("same_name", "Two sets have the same name")
    return sets


_Sets = Annotated[
    tuple[FuzzySet, ...],
    Field(strict=False, max_length=MOST_SETS, json_schema_extra={"minItems": 1}),
    _NOT_EMPTY,
    AfterValidator(_different_names),
]


class FuzzyInputs(Part):
    """The sets of both inputs."""

    speed_error: _Sets
    distance: _Sets


class Condition(Part):
    """What a rule asks for: a set of one input, or of both."""

    speed_error: str | None = None
    distance: str | None = None

    @model_validator(mode="after")
    def _asks_for_something(self) -> Self:
        if self.speed_error is None and self.distance is None:
            raise PydanticCustomError("no_condition", "A rule asks for a set of speed_error, of distance or of both")
        return self


class FuzzyRule(Part):
    """One rule, which holds as far as the less true of what it asks for."""

    condition: Condition = Field(alias="if")
    then: str


def _table_1() -> Iterator[FuzzyRule]:
    # Rows: distance to the bump O to V; columns: speed error O to V; entries: braking torque.
    for distance, row in zip(SET_NAMES, ("OMLVV", "OMLVV", "OSMLL", "OSMML", "OSSMM"), strict=True):
        for speed_error, torque in zip(SET_NAMES, row, strict=True):
            yield FuzzyRule.model_validate({"if": {"speed_error": speed_error, "distance": distance}, "then": torque})


def even_triangles(end: float) -> tuple[FuzzySet, ...]:
    """Return Table 1's sets: five even triangles over a universe from 0; the outer two are halves."""
    width = end / (len(SET_NAMES) - 1)
    return tuple(
        FuzzySet(name=name, function="trimf", corners=((i - 1) * width, i * width, (i + 1) * width))
        for i, name in enumerate(SET_NAMES)
    )


TABLE_1 = tuple(_table_1())


_Rules = Annotated[
    tuple[FuzzyRule, ...],
    Field(strict=False, max_length=MOST_RULES, json_schema_extra={"minItems": 1}),
    _NOT_EMPTY,
]


class Fuzzy(Part):
    """The fuzzy speed controller (section 3.1): Mamdani's minimum and maximum, centroid; by default the paper's."""

    inputs: FuzzyInputs | None = None
    output: _Sets | None = None
    rules: _Rules | None = None

    @property
    def speed_errors(self) -> tuple[FuzzySet, ...]:
        """Return the sets of the speed error [km/h]."""
        return even_triangles(SPEED_ERROR_MAX) if self.inputs is None else self.inputs.speed_error

    @property
    def distances(self) -> tuple[FuzzySet, ...]:
        """Return the sets of the distance [m]."""
        return even_triangles(DISTANCE_MAX) if self.inputs is None else self.inputs.distance

    @property
    def torques(self) -> tuple[FuzzySet, ...]:
        """Return the sets of the torque, as a share of the greatest."""
        return self.output or even_triangles(1.0)

    @model_validator(mode="after")
    def _rules_name_sets(self) -> Self:
        errors, distances, torques = (
            [each.name for each in sets] for sets in (self.speed_errors, self.distances, self.torques)
        )
        for index, rule in enumerate(self.rules or TABLE_1):
            asked = rule.condition
            for place, name, names in (
                ("if.speed_error", asked.speed_error, errors),
                ("if.distance", asked.distance, distances),
                ("then", rule.then, torques),
            ):
                if name is not None and name not in names:
                    if self.rules is None:
                        raise at("rules", "Table 1 asks for sets O, S, M, L, V: other sets need rules of their own")
                    raise at(f"rules.{index}.{place}", f"There is no such set; there are {', '.join(names)}")
        return self
