"""Which of a sweep's runs are alike, in words: repeated points, fields a strategy does not read, unreached speeds."""

from collections.abc import Collection, Iterator, Mapping, Sequence

from backend.job_run import JobRun
from backend.json_types import JsonObject
from sim_core.scenario import dotted
from sim_core.strategies import reads, resolve_speed_plan, strategy_named
from sim_core.strategies.effects import conditional_reads

POLICY = "speed.policy"
INITIAL, TARGET = "speed.initial_speed_kmh", "speed.target_speed_kmh"


def notes(
    base: JsonObject, points: Sequence[JsonObject], axes: Mapping[str, Sequence[str]], runs: Sequence[JobRun]
) -> list[str]:
    """Sentences about a sweep; none where every run is one of its own.

    Args:
        base: The plain scenario it starts from.
        points: What each point changes.
        axes: Swept field -> fields that take the same value.
        runs: A point's strategies side by side.
    """
    policies = {point.get(POLICY, dotted.value(base, POLICY)) for point in points}
    names = list(dict.fromkeys(run.strategy for run in runs))
    swept = [name for axis, linked in axes.items() for name in (axis, *linked)]
    return [
        *_repeated(points),
        *_unread(names, policies, axes, runs),
        *_without_effect(base, points, swept, names, policies),
        *_overruled(base, swept),
        *_clamped(base, points, names, policies),
    ]


def _repeated(points: Sequence[JsonObject]) -> Iterator[str]:
    again = len(points) - len(set(map(repr, points)))
    if again:
        yield f"{again} of {len(points)} points {'repeats' if again == 1 else 'repeat'} an earlier one"


def _unread(
    names: Sequence[str], policies: Collection[str], axes: Mapping[str, Sequence[str]], runs: Sequence[JobRun]
) -> list[str]:
    said = []
    for name in names:
        read = [field for policy in policies for field in reads(strategy_named(name), policy)]
        unread = [axis for axis, linked in axes.items() if not any(_reads(read, each) for each in (axis, *linked))]
        keys = [run.key for run in runs if run.strategy == name and run.key]
        if unread and len(set(keys)) < len(keys):
            fields = _listed([_inside(dotted.field(axis).title) for axis in unread])
            results = len(set(keys))
            counted = f"its {len(keys)} runs give {results} result{'s' if results > 1 else ''}"
            said.append(f"{strategy_named(name).label} does not use {fields}: {counted}")
    return said


def _without_effect(
    base: JsonObject,
    points: Sequence[JsonObject],
    swept: Sequence[str],
    names: Sequence[str],
    policies: Collection[str],
) -> Iterator[str]:
    """Fields that the strategies use only with other values, such as a filter's, which no point has."""
    for field in swept:
        using = [name for name in names if any(_reads(reads(strategy_named(name), each), field) for each in policies)]
        groups = [group for name in using for group in conditional_reads(strategy_named(name))]
        needed = [group.conditions for group in groups if _reads(group.fields, field)]
        if needed and not any(all(each.is_met(base, point) for each in need) for need in needed for point in points):
            fewest = min(needed, key=len)
            conditions = " and ".join(map(str, fewest))
            yield f"{dotted.field(field).title} is used only with {conditions}, which no point has"


def _overruled(base: JsonObject, swept: Sequence[str]) -> list[str]:
    """The car is driven with a damper's curve, not with its coefficient."""
    return [
        f"The {axle} damper has a curve, which the car is driven with: {axle} damping is what controllers believe alone"
        for axle in ("front", "rear")
        if f"vehicle.{axle}_damping" in swept and dotted.value(base, f"vehicle.{axle}_damper_curve") is not None
    ]


def _reads(read: Sequence[str], field: str) -> bool:
    """Whether the field, a part of it, or the part it lies in is read."""
    return any(dotted.is_within(field, each) or dotted.is_within(each, field) for each in read)


def _clamped(
    base: JsonObject, points: Sequence[JsonObject], names: Sequence[str], policies: Collection[str]
) -> list[str]:
    """A speed plan only slows down: a target above the initial speed is the initial speed."""
    planned = [
        strategy_named(name).label
        for name in names
        if any(resolve_speed_plan(strategy_named(name), policy) == "planned" for policy in policies)
    ]
    if not planned or not any(TARGET in point or INITIAL in point for point in points[:1]):
        return []
    initial, target = (dotted.value(base, name) for name in (INITIAL, TARGET))
    above = sum(point.get(TARGET, target) > point.get(INITIAL, initial) for point in points)
    if above == 0:
        return []
    return [
        f"At {above} of {len(points)} points the target speed is above the initial speed, which "
        f"{_listed(planned)} then {'keep' if len(planned) > 1 else 'keeps'}"
    ]


def _inside(title: str) -> str:
    """A title within a sentence; abbreviations stay."""
    return title if title[1:2].isupper() else title[:1].lower() + title[1:]


def _listed(words: Sequence[str]) -> str:
    return " and ".join(filter(None, [", ".join(words[:-1]), words[-1]]))
