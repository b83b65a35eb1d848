"""What the scenario's fields are made of: a number with its unit, limits and range; three weights; the base of parts.

Titles, descriptions and search words of all fields are in fields.toml.
"""

import tomllib
from collections.abc import Mapping
from functools import cache
from pathlib import Path
from typing import Annotated, Any

from pydantic import AfterValidator, BaseModel, ConfigDict, Field, JsonValue
from pydantic.config import JsonDict
from pydantic_core import PydanticCustomError


def quantity(unit: str, *, soft: tuple[float, float], ge: float, le: float, shown: str | None = None) -> Any:
    """Return what a number may be, for its type's `Annotated`: hard limits `ge` to `le`, slider range `soft`.

    `shown` is the unit people think of it in, where that is another one: forms show and read it so.
    """
    extra: dict[str, JsonValue] = {"unit": unit, "soft_range": list(soft)}
    if shown is not None:
        extra["shown_unit"] = shown
    return Field(ge=ge, le=le, json_schema_extra=extra)


# In a field's type: it is younger than stored results, and at its default no part of what a result is known by.
ADDED = "added"


@cache
def _texts() -> dict[str, dict[str, dict[str, str]]]:
    """Return what fields.toml says, by part and field; read when somebody asks, which few runs do."""
    return tomllib.loads(Path(__file__).with_suffix(".toml").read_text(encoding="utf-8"))


def field_texts(part: type[BaseModel], name: str) -> Mapping[str, str]:
    """Return the `title` and, where there are any, `description`, `note` and `search_words` of a part's field.

    Args:
        part: The part's class.
        name: The field's name in JSON.
    """
    return _texts().get(part.__name__, {}).get(name, {})


def _with_texts(schema: JsonDict, part: type[BaseModel]) -> None:
    """Add to each field's JSON Schema its texts, the search words one by one; a part's example is none of it."""
    schema["description"] = str(schema.get("description", "")).partition("\n\nExample:")[0]
    properties = schema.get("properties")
    for name, each in properties.items() if isinstance(properties, dict) else ():
        if isinstance(each, dict):
            texts = field_texts(part, name)
            each.update({key: texts[key] for key in ("title", "description", "note") if key in texts})
            if words := [*_words(part, "*"), *_words(part, name)]:
                each["search_words"] = list[JsonValue](words)


def _words(part: type[BaseModel], name: str) -> list[str]:
    single, *phrases = field_texts(part, name).get("search_words", "").split(",")
    return [*single.split(), *map(str.strip, phrases)]


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
        json_schema_extra=_with_texts,
    )

    def identity(self) -> dict[str, Any]:
        """Return what a stored result or run is known by, plain JSON: every member, of those `ADDED` what is set.

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
    """Return names and defaults of the fields that are marked `ADDED`."""
    return tuple((name, info.default) for name, info in part.model_fields.items() if ADDED in info.metadata)


def _not_all_zero(weights: tuple[float, float, float]) -> tuple[float, float, float]:
    if not any(weights):
        raise PydanticCustomError("all_zero_weights", "At least one weight must be greater than 0")
    return weights


WEIGHT: Any = Field(ge=0, le=1000)
Weight = Annotated[float, WEIGHT]
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
