"""Caveats: sentences on a result that no real car would have, or that says less than it seems."""

from backend.json_types import JsonObject
from sim_core.catalogue import EVENTS
from sim_core.comparison.numbers import amount, in_words, with_unit


def caveats(entry: JsonObject, vehicle: JsonObject) -> list[str]:
    """Sentences about one strategy of a run, as `Run` has it, of that scenario's car; empty where there is none."""
    if entry["status"] != "ok":
        return [f"It could not run: {entry['reason']}"]
    events, sentences = entry["events"], [f"{note}." for note in (entry.get("recording") or {}).get("notes", ())]
    if airborne := _notable(events, "airborne_ms"):
        sentences.append(
            f"Airborne: a tyre is off the road for {airborne}."
            if vehicle["tyre_lift_off"]
            else f"Airborne: for {airborne} a tyre's dynamic load is below minus its static load. The model's linear "
            "tyre then pulls on the road, which a real one cannot."
        )
    if on_stops := _notable(events, "stop_contact_ms"):
        sentences.append(f"Bump stop: a suspension is on its bump stops for {on_stops}.")
    if exceeded := _notable(events, "travel_exceeded_mm"):
        stops = " The model has no bump stops." if vehicle["bump_stop_clearance"] is None else ""
        sentences.append(f"Over travel: the suspension goes {exceeded} beyond its travel limit.{stops}")
    if events.get("target_reached") is False:
        speed = with_unit(in_words(entry["arrival_speed_kmh"]), "km/h")
        sentences.append(f"Target speed not reached: the car meets the bump at {speed}.")
    if events.get("bump_complete") is False:
        sentences.append(
            "The road ends before the rear axle has left the bump: the peaks there are those up to the end."
        )
    solves = f"of {in_words(events.get('qp_solves'))} QPs were"
    if events.get("qp_failures"):
        failures = f"{in_words(events['qp_failures'])} {solves} not solved"
        sentences.append(f"Solver failures: {failures}; the last safe force was held there.")
    if events.get("qp_fallbacks"):
        fallbacks = f"{in_words(events['qp_fallbacks'])} {solves} solved by the other solver"
        sentences.append(f"Solver fallbacks: {fallbacks}, after the first gave no verified solution.")
    return sentences


def _notable(events: JsonObject, event: str) -> str | None:
    """An event's amount with its unit, where it is worth a warning."""
    value = events.get(event)
    if not isinstance(value, int | float) or value < EVENTS[event].notable:
        return None
    return amount(value, EVENTS[event].unit)
