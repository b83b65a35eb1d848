"""A damper as its supplier gives it: its force at a few velocities."""

from itertools import pairwise
from typing import Annotated

from pydantic import AfterValidator, Field
from pydantic_core import PydanticCustomError

MOST_POINTS = 20
SOFTEST, HARDEST = 10.0, 500_000.0  # slopes through the origin and anywhere, as of a linear damper [N s/m]

DamperPoint = Annotated[
    tuple[Annotated[float, Field(ge=-20, le=20)], Annotated[float, Field(ge=-1_000_000, le=1_000_000)]],
    Field(strict=False, title="Velocity [m/s] and force [N]"),
]
_Points = tuple[DamperPoint, ...]


def _only_damps(points: _Points) -> _Points:
    for number, (velocity, force) in enumerate(points, 1):
        if number > 1 and velocity <= points[number - 2][0]:
            raise _wrong(f"Point {number}: velocities have to ascend")
        if velocity * force < 0 or (velocity == 0) != (force == 0):
            raise _wrong(
                f"Point {number}: rebound and its force are positive, compression negative; at 0 m/s it is 0 N"
            )
    if not points or points[0][0] >= 0 or points[-1][0] <= 0:
        raise _wrong("It needs points in compression and in rebound")
    whole = with_origin(points)
    for (v0, f0), (v1, f1) in pairwise(whole):
        slope = (f1 - f0) / (v1 - v0)
        least = SOFTEST if 0 in (v0, v1) else 0.0
        if not least <= slope <= HARDEST:
            slopes = f"From {v0:g} to {v1:g} m/s it rises by {slope:.4g} N s/m"
            raise _wrong(f"{slopes}, which has to be from {least:g} to {HARDEST:g}")
    return points


def _wrong(reason: str) -> PydanticCustomError:
    return PydanticCustomError("damper_curve", "{reason}", {"reason": reason})


DamperCurve = Annotated[
    _Points, Field(strict=False, max_length=MOST_POINTS, json_schema_extra={"minItems": 2}), AfterValidator(_only_damps)
]


def with_origin(points: _Points) -> _Points:
    """Return the points with 0 N at 0 m/s among them; between them, and beyond the outer ones, the force is linear."""
    return points if any(velocity == 0 for velocity, _ in points) else tuple(sorted((*points, (0.0, 0.0))))


def slopes_at_rest(points: _Points) -> tuple[float, float]:
    """Return the damping around 0 m/s, in compression and in rebound [N s/m]."""
    whole = with_origin(points)
    at = whole.index((0.0, 0.0))
    (v0, f0), (v1, f1) = whole[at - 1], whole[at + 1]
    return f0 / v0, f1 / v1


def hardest(points: _Points) -> float:
    """Return the greatest slope of a curve [N s/m]."""
    whole = with_origin(points)
    return max((f1 - f0) / (v1 - v0) for (v0, f0), (v1, f1) in pairwise(whole))


def straight(compression: float, rebound: float) -> _Points:
    """Return the curve of a damper that is linear in either direction, by its damping there [N s/m]."""
    return (-1.0, -compression), (1.0, rebound)


def scaled(points: _Points | None, factor: float) -> _Points | None:
    """Return a curve with so many times the force."""
    return points and tuple((velocity, force * factor) for velocity, force in points)
