"""Record which fields of a scenario are looked at, for a check; a scenario that is only driven records nothing."""

from collections.abc import Callable, Mapping
from contextvars import ContextVar
from functools import cache
from typing import Any, Self, TypeVar

from sim_core.scenario import Scenario
from sim_core.scenario.fields import Part
from sim_core.scenario.own import Own

T = TypeVar("T")
_accessed: ContextVar[set[str] | None] = ContextVar("accessed", default=None)


def record_accesses(scenario: Scenario, function: Callable[[Scenario], T]) -> tuple[T, set[str]]:
    """Return `function(scenario)`, and the dotted names of the scenario's fields that were looked at meanwhile.

    It is called with a copy whose parts no cache knows, so that nothing that was computed for the scenario before takes
    the place of looking at them.
    """
    names: set[str] = set()
    token = _accessed.set(names)
    try:
        return function(_tracking_copy(scenario, "")), names
    finally:
        _accessed.reset(token)


def _tracking_copy(part: Part, prefix: str) -> Any:
    """Return a copy of a part, and of the parts in it, that records which of its fields are looked at."""
    parts = {name: value for name, value in vars(part).items() if isinstance(value, Part)}
    copied = part.model_copy(update={name: _tracking_copy(each, f"{prefix}{name}.") for name, each in parts.items()})
    object.__setattr__(copied, "__class__", _recording_class(type(part), prefix))
    return copied


@cache
def _recording_class(kind: type[Part], prefix: str) -> type[Part]:
    fields = frozenset(kind.model_fields)

    class Recording(kind):  # type: ignore[valid-type, misc]  # one for each part
        __hash__ = object.__hash__

        def __eq__(self, other: object) -> bool:
            return self is other or (isinstance(other, kind) and vars(self) == vars(other))

        def __getattribute__(self, name: str) -> Any:
            value = super().__getattribute__(name)
            if name in fields and not isinstance(value, Part):
                _record(f"{prefix}{name}")
            elif name == "__dict__":  # as `vars` and `model_dump` do
                for each, inner in value.items():
                    if not isinstance(inner, Part):
                        _record(f"{prefix}{each}")
            return value

        def model_copy(self, *, update: Mapping[str, Any] | None = None, deep: bool = False) -> Self:
            token = _accessed.set(None)  # to copy is not to look at
            try:
                copied: Self = super().model_copy(update=update, deep=deep)
                return copied
            finally:
                _accessed.reset(token)

        def of(self, controller: str) -> dict[str, Any]:
            options: dict[str, Any] = super().of(controller)
            if options:
                _record(f"{prefix}{controller}")
            return options

    if not issubclass(kind, Own):
        del Recording.of
    return Recording


def _record(name: str) -> None:
    names = _accessed.get()
    if names is not None:
        names.add(name)
