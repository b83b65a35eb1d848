"""Kinds of scenario fields: a number with its unit, a whole number, three weights; each knows its limits and range."""

from functools import cache
from typing import Annotated, Any

from pydantic import AfterValidator, BaseModel, ConfigDict, Field, JsonValue
from pydantic.config import JsonDict
from pydantic_core import PydanticCustomError

from sim_core.scenario.search_words import search_terms, search_words


def quantity(unit: str, *, soft: tuple[float, float], ge: float, le: float, shown: str | None = None) -> Any:
    """Return what a number may be, for its type's `Annotated`: hard limits `ge` to `le`, slider range `soft`.

    `shown` is the unit people think of it in, where that is another one: forms show and read it so.
    """
    extra: dict[str, JsonValue] = {"unit": unit, "soft_range": list(soft)}
    if shown is not None:
        extra["shown_unit"] = shown
    return Field(ge=ge, le=le, json_schema_extra=extra)


def field(default: Any, title: str, description: str, *, note: str | None = None) -> Any:
    """Return a field of a part; `...` has no default.

    `note` stands beside the title in forms, where a value may be misunderstood without it.
    """
    extra: JsonDict = {} if note is None else {"note": note}
    return Field(default, title=title, description=description, json_schema_extra=extra)


# In a field's type: it is younger than stored results, and at its default no part of what a result is known by.
ADDED = "added"


def _with_search_words(schema: JsonDict, part: type[BaseModel]) -> None:
    """Add to each field's JSON Schema what people may look for it by."""
    words, properties = search_words().get(part.__name__, {}), schema.get("properties")
    for name, each in properties.items() if isinstance(properties, dict) else ():
        found = [term for key in ("*", name) if key in words for term in search_terms(words[key])]
        if found and isinstance(each, dict):
            each["search_words"] = list[JsonValue](found)


class Part(BaseModel):
    """Base of every part: frozen, hashable, strict about names and types, no NaN or infinity."""

    model_config = ConfigDict(
        frozen=True,
        extra="forbid",
        strict=True,
        allow_inf_nan=False,
        validate_default=True,
        hide_input_in_errors=True,
        serialize_by_alias=True,
        json_schema_extra=_with_search_words,
    )

    def identity(self) -> dict[str, Any]:
        """What a stored result or run is known by, plain JSON: every member, of those marked `ADDED` what is set.

        So a member that is added leaves every identity as it was where nobody sets it.
        """
        plain = self.model_dump(mode="json")
        self._leave_out_unset(plain)
        return plain

    def _leave_out_unset(self, plain: dict[str, Any]) -> None:
        values = vars(self)
        for name, default in _added(type(self)):
            if values[name] == default:
                del plain[name]
        for name, value in values.items():
            if isinstance(value, Part) and name in plain:
                value._leave_out_unset(plain[name])


@cache
def _added(part: type[Part]) -> tuple[tuple[str, Any], ...]:
    """Names and defaults of its fields that are marked `ADDED`."""
    return tuple((name, info.default) for name, info in part.model_fields.items() if ADDED in info.metadata)


def _not_all_zero(weights: tuple[float, float, float]) -> tuple[float, float, float]:
    if not any(weights):
        raise PydanticCustomError("all_zero_weights", "At least one weight must be greater than 0")
    return weights


Weight = Annotated[float, Field(ge=0, le=1000)]
# strict=False on the tuple alone: JSON has arrays only. The numbers inside stay strict.
Weights = Annotated[
    tuple[Weight, Weight, Weight],
    Field(
        strict=False,
        json_schema_extra={
            "unit": "1",
            "soft_range": [0, 10],
            "item_titles": ["Body acceleration", "Pitch acceleration", "Tyre load"],
        },
    ),
    AfterValidator(_not_all_zero),
]


def at(field: str, message: str) -> PydanticCustomError:
    """Return an error of a whole model that belongs to one field; `ctx['field']` names it, dotted."""
    return PydanticCustomError("inconsistent", "{reason}", {"field": field, "reason": message})
