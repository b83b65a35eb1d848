"""What makes a result one that no real car would have, or that says less than it seems, in plain words."""

from collections.abc import Callable, Mapping
from typing import Any

from backend.runs.reports.numbers import NOTHING, amount, told, with_unit
from sim_core.catalogue import EVENTS

Events = Mapping[str, Any]


def doubts(entry: Mapping[str, Any]) -> list[str]:
    """Sentences about one strategy of a run, as `Run` has it; none where nothing is to be doubted."""
    if entry["status"] != "ok":
        return [f"It could not run: {entry['reason']}"]
    return [text for say in _WORDINGS if (text := say(entry)) is not None]


def _above(event: str, say: Callable[[str], str]) -> Callable[[Mapping[str, Any]], str | None]:
    """A sentence about an event above nothing, given the amount with its unit."""

    def wording(entry: Mapping[str, Any]) -> str | None:
        value = entry["events"].get(event)
        if not isinstance(value, int | float) or value <= NOTHING:
            return None
        return say(amount(value, EVENTS[event].unit))

    return wording


def _target(entry: Mapping[str, Any]) -> str | None:
    if entry["events"].get("target_reached") is not False:
        return None
    speed = with_unit(told(entry["arrival_speed_kmh"]), "km/h")
    return f"Target speed not reached: the car meets the bump at {speed}."


def _cut(entry: Mapping[str, Any]) -> str | None:
    if entry["events"].get("bump_complete") is not False:
        return None
    return "The road ends before the rear axle has left the bump: the peaks there are those up to the end."


def _unsolved(entry: Mapping[str, Any]) -> str | None:
    events = entry["events"]
    if not events.get("qp_failures"):
        return None
    return (
        f"Solver failures: {told(events['qp_failures'])} of {told(events.get('qp_solves'))} QPs were not solved; "
        "the last safe force was held there."
    )


def _solved_second(entry: Mapping[str, Any]) -> str | None:
    events = entry["events"]
    if not events.get("qp_fallbacks"):
        return None
    return (
        f"Solver fallbacks: {told(events['qp_fallbacks'])} of {told(events.get('qp_solves'))} QPs were solved by the "
        "other solver, after the first gave no verified solution."
    )


_WORDINGS = (
    _above(
        "airborne_ms",
        lambda shown: (
            f"Airborne: for {shown} a tyre's dynamic load is below minus its static load. The model's linear "
            "tyre then pulls on the road, which a real one cannot."
        ),
    ),
    _above(
        "travel_exceeded_mm",
        lambda shown: f"Over travel: the suspension goes {shown} beyond its travel limit. The model has no bump stops.",
    ),
    _target,
    _cut,
    _unsolved,
    _solved_second,
)
