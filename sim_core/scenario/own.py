"""The scenario part `own`: options of controllers of one's own, `own.ID.OPTION`.

Which there are is no part of the scenario's schema, because they come from files: a scenario may hold those of a
controller that is there no more, and whoever drives one checks its values.
"""

from math import isfinite
from typing import Annotated, Any, Self

from pydantic import AfterValidator, ConfigDict, Field, WithJsonSchema, model_validator
from pydantic_core import PydanticCustomError

from sim_core.scenario.fields import Part, at

_NAME = r"^[A-Za-z_][A-Za-z0-9_]{0,63}$"
_MOST = 64
_LONGEST = 200


def _plain(value: Any) -> Any:
    finite = isinstance(value, bool | int) or (isinstance(value, float) and isfinite(value))
    if not finite and not (isinstance(value, str) and len(value) <= _LONGEST):
        raise PydanticCustomError("option", "An option is a finite number, true or false, or a short text")
    return value


Value = Annotated[Any, AfterValidator(_plain), WithJsonSchema({"type": ["boolean", "number", "string"]})]


class Own(Part):
    """The options of each custom controller that are not at their defaults."""

    model_config = ConfigDict(extra="allow")

    __pydantic_extra__: dict[str, Annotated[dict[Annotated[str, Field(pattern=_NAME)], Value], Field(max_length=_MOST)]]

    def of(self, controller: str) -> dict[str, Any]:
        """Return the options of a controller by their names."""
        return self.__pydantic_extra__.get(controller, {})

    @property
    def controllers(self) -> dict[str, dict[str, Any]]:
        """Return the options of each controller, by its id."""
        return self.__pydantic_extra__

    @model_validator(mode="after")
    def _few(self) -> Self:
        if len(self.__pydantic_extra__) > _MOST:
            raise at("own", f"Options of at most {_MOST} controllers")
        return self
