"""The best of many trials: one objective's smallest, the Pareto front of several, its knee, how much it dominates."""

import math
from collections.abc import Sequence

from backend.store.trials import StoredTrial

Point = Sequence[float]


def best(trials: Sequence[StoredTrial], objective: int) -> StoredTrial | None:
    """Return the feasible trial with the objective's smallest value; the first of equal ones."""
    return min(_feasible(trials), key=lambda trial: (_values(trial)[objective], trial.number), default=None)


def front(trials: Sequence[StoredTrial]) -> list[StoredTrial]:
    """Return the feasible trials that none dominates (is better in one objective, worse in none); equal ones once."""
    members: list[StoredTrial] = []
    # In this order nothing that comes later can dominate what is there.
    for trial in sorted(_feasible(trials), key=lambda trial: (*_values(trial), trial.number)):
        if not any(all(a <= b for a, b in zip(_values(each), _values(trial), strict=True)) for each in members):
            members.append(trial)
    return members


def knee(members: Sequence[StoredTrial]) -> StoredTrial | None:
    """Return the member of a front nearest to its ideal corner, each of several objectives scaled to its range."""
    if not members or len(_values(members[0])) < 2:
        return None
    columns = list(zip(*map(_values, members), strict=True))
    spans = [(min(column), (max(column) - min(column)) or 1.0) for column in columns]

    def distance(trial: StoredTrial) -> float:
        return math.hypot(*((value - low) / span for value, (low, span) in zip(_values(trial), spans, strict=True)))

    return min(members, key=lambda trial: (distance(trial), trial.number))


def dominated_share(members: Sequence[StoredTrial], reference: Point | None) -> float | None:
    """Return the share of the box between zero and `reference` that the members dominate; None without such a box."""
    if reference is None or not all(value > 0 for value in reference):
        return None
    scaled = [
        [max(value, 0.0) / most for value, most in zip(_values(trial), reference, strict=True)] for trial in members
    ]
    return _hypervolume([point for point in scaled if all(value < 1 for value in point)])


def _hypervolume(points: list[list[float]]) -> float:
    """Return the volume of the unit box that the points dominate, slab by slab of the last coordinate."""
    if not points:
        return 0.0
    if len(points[0]) == 1:
        return 1.0 - min(point[0] for point in points)
    ordered = sorted(points, key=lambda point: point[-1])
    ends = [point[-1] for point in ordered[1:]] + [1.0]
    return sum(
        (end - point[-1]) * _hypervolume([each[:-1] for each in ordered[: index + 1]])
        for index, (point, end) in enumerate(zip(ordered, ends, strict=True))
        if end > point[-1]
    )


def _feasible(trials: Sequence[StoredTrial]) -> list[StoredTrial]:
    return [trial for trial in trials if trial.feasible and trial.values is not None]


def _values(trial: StoredTrial) -> list[float]:
    assert trial.values is not None  # noqa: S101  # of feasible ones only
    return trial.values
