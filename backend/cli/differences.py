"""What differs between two runs: figures beyond a tolerance, and the inputs they come from."""

import math
from collections.abc import Mapping
from dataclasses import dataclass
from typing import Any

from backend.client import RunResult
from backend.client.answers import Figure


@dataclass(frozen=True, slots=True, kw_only=True)
class Difference:
    """One figure of one strategy that is not the same; `change` is (b − a)/|a|, infinite where it has no number."""

    strategy: str
    figure: str
    unit: str
    a: Figure | str
    b: Figure | str
    change: float


@dataclass(frozen=True, slots=True, kw_only=True)
class Tolerance:
    """Values are equal when |b − a| ≤ max(absolute, relative·|a|); `absolute` is in the figure's own unit."""

    relative: float
    absolute: float

    def holds(self, a: float, b: float) -> bool:
        """Whether b equals a."""
        return abs(b - a) <= max(self.absolute, self.relative * abs(a))


def differences(a: RunResult, b: RunResult, strategies: list[str], tolerance: Tolerance) -> list[Difference]:
    """Every figure that differs, the largest change first."""
    found = []
    for name in strategies:
        first, second = _all(a, name), _all(b, name)
        for figure in dict.fromkeys([*first, *second]):
            one, other = first.get(figure), second.get(figure)
            if not _same(one, other, tolerance):
                unit = a.units.get(figure, "1")
                change = _change(one, other)
                found.append(Difference(strategy=name, figure=figure, unit=unit, a=one, b=other, change=change))
    return sorted(found, key=lambda item: -abs(item.change))


def inputs(a: Mapping[str, Any], b: Mapping[str, Any]) -> list[tuple[str, Any, Any]]:
    """Fields of two complete scenarios that differ, by dotted name, with both values."""
    first, second = _flat(a, ""), _flat(b, "")
    names = dict.fromkeys([*first, *second])
    return [
        (name, first.get(name), second.get(name)) for name in names if not _equal(first.get(name), second.get(name))
    ]


def _all(run: RunResult, strategy: str) -> dict[str, Figure | str]:
    outcome = run.strategies.get(strategy)
    if outcome is None:
        return {"status": "not run"}
    return {"status": outcome.status, **outcome.figures()}


def _same(a: Figure | str, b: Figure | str, tolerance: Tolerance) -> bool:
    if _is_number(a) and _is_number(b):
        return tolerance.holds(a, b)  # type: ignore[arg-type]  # both are numbers
    return type(a) is type(b) and a == b


def _change(a: Figure | str, b: Figure | str) -> float:
    if _is_number(a) and _is_number(b) and a:
        return (b - a) / abs(a)  # type: ignore[operator,arg-type]  # both are numbers
    return math.inf


def _is_number(value: object) -> bool:
    return isinstance(value, float | int) and not isinstance(value, bool)


def _equal(a: Any, b: Any) -> bool:
    return type(a) is type(b) and a == b if isinstance(a, bool) or isinstance(b, bool) else bool(a == b)


def _flat(part: Mapping[str, Any], prefix: str) -> dict[str, Any]:
    found: dict[str, Any] = {}
    for key, value in part.items():
        if isinstance(value, Mapping):
            found |= _flat(value, f"{prefix}{key}.")
        else:
            found[prefix + key] = value
    return found
