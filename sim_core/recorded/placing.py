"""The simulated drive that a recording matches best, its position there, and which signals have the opposite sign."""

from collections.abc import Callable, Mapping, Sequence
from dataclasses import dataclass
from itertools import product

import numpy as np

from sim_core.arrays import FloatArray
from sim_core.catalogue import METRIC_SIGNALS, SIGNALS
from sim_core.errors import RefusedError, TooExpensiveError
from sim_core.recorded.alignment import Placement, Reference, Signs, apply_signs, correlations, evenly, find_placement
from sim_core.recorded.kink_peaks import heights_match
from sim_core.recorded.track import Track
from sim_core.result import StrategyResult
from sim_core.scenario import Scenario
from sim_core.strategies import REFERENCE_STRATEGIES, STRATEGIES

PLACED_BY = METRIC_SIGNALS[:6]  # not by the forces, in which controllers differ most
OPPOSITE = -0.5  # correlation of a signal whose sign may be the other way round
MOST_SAMPLES = 100_000  # of a simulated drive
# Signals that are recorded the other way round together: z may point down, compression may count positive.
CONVENTIONS = {
    "z points down": ("body_acceleration",),
    "compression counts positive": ("front_deflection", "rear_deflection"),
}
_UNPLACED = (
    "The recording could not be placed: no position matches a simulated drive better than chance. Its own distance is "
    "used as the position"
)


@dataclass(frozen=True, slots=True, kw_only=True)
class PlacedRecording:
    """A recording on a road.

    Attributes:
        placement: None where it could not be placed.
        position: On the road (m,) [m].
        inverted: The signals whose sign was inverted.
        notes: What was done, in words.
    """

    placement: Placement | None
    position: FloatArray
    inverted: tuple[str, ...]
    notes: tuple[str, ...]


def place_recording(
    scenario: Scenario, drives: Callable[[str], StrategyResult], signals: Mapping[str, FloatArray], track: Track
) -> PlacedRecording:
    """Place a recording where it matches a strategy's drive best; at its own distance, if it has this road's heights.

    Args:
        scenario: Whose road.
        drives: Simulates a strategy on that road.
        signals: Of the recording, NaN where there is no value.
        track: Its distance.
    """
    keys = [key for key in PLACED_BY if key in signals and _varies(signals[key])]
    rows = np.array([signals[key] for key in keys])
    references, left_out = _references(drives, keys) if keys else ({}, [])
    placement = None
    if references and all(heights_match(scenario, signals, track.distance)):
        placement = _at_recorded_distance(track.distance, rows, references)
    elif references:
        placement = find_placement(track.distance, rows, references, _signs(keys), smooth=scenario.road.is_smooth)
    if placement is None:
        unplaced = _UNPLACED, *left_out, *_on_its_bump(scenario, track.distance, rows, references, _signs(keys))
        return PlacedRecording(placement=None, position=track.distance, inverted=(), notes=unplaced)
    position = placement.offset + placement.scale * track.distance
    best_match = f"{STRATEGIES[placement.reference].label} (correlation {placement.likeness:.2f})"
    offset = round(placement.offset, 3)
    sign = "−" if offset < 0 else "+"
    notes = [
        f"It was placed where it is like {best_match}: position = {placement.scale:.5f} × distance {sign} "
        f"{abs(offset):.3f} m"
    ]
    inverted = tuple(key for key, sign in zip(keys, placement.signs, strict=True) if sign < 0)
    for convention, members in CONVENTIONS.items():
        if which := [SIGNALS[key].label for key in members if key in inverted]:
            has, its = ("has", "its") if len(which) == 1 else ("have", "their")
            notes.append(
                f"{' and '.join(which)} {has} the opposite sign of the simulated drive ({convention}); "
                f"{its} sign was inverted"
            )
    there = correlations(position, apply_signs(rows, placement.signs), *references[placement.reference])
    notes += [
        f"{SIGNALS[key].label} has the opposite sign of the simulated one: is it inverted?"
        for key, value in zip(keys, there, strict=True)
        if value < OPPOSITE
    ]
    return PlacedRecording(placement=placement, position=position, inverted=inverted, notes=(*notes, *left_out))


def _varies(values: FloatArray) -> bool:
    """Check whether a signal has two different values."""
    finite = values[np.isfinite(values)]
    return len(finite) > 0 and float(np.ptp(finite)) > 0


def _on_its_bump(
    scenario: Scenario,
    distance: FloatArray,
    rows: FloatArray,
    references: Mapping[str, Reference],
    signs: Sequence[Signs],
) -> list[str]:
    """Return a note on where the recording would lie if it was driven over another road with the same bump."""
    if scenario.road.is_smooth or not scenario.road.has_bump or not references:
        return []
    alike = find_placement(distance, rows, references, signs, smooth=True)
    if alike is None or not alike.offset + alike.scale * distance[0] < scenario.road.bump.start:
        return []
    start = scenario.road.bump.start
    shift = start - (start - alike.offset) / alike.scale
    return [
        f"Its bump alone is like the simulated one (correlation {alike.likeness:.2f}): to compare it there, add "
        f"{shift:.1f} m to its distance, or set the road's roughness to 0"
    ]


def _references(drives: Callable[[str], StrategyResult], keys: Sequence[str]) -> tuple[dict[str, Reference], list[str]]:
    """Return position and those signals of each strategy's drive, and which were left out as too expensive."""
    references, left_out = {}, []
    for name in REFERENCE_STRATEGIES:
        try:
            series = drives(name).series
        except TooExpensiveError:
            left_out.append(STRATEGIES[name].label)
            continue
        except RefusedError:  # of a car that this controller cannot hold
            continue
        count = len(series["time"]) + len(series.jumps)
        every = slice(None, None, 1 + count // MOST_SAMPLES)
        position, *rows = (series.with_jumps(key, 0, count)[every] for key in ("position", *keys))
        references[name] = position, np.array(rows)
    names = ", ".join(left_out)
    return references, [f"Not compared with {names}: simulating that on this road costs too much"] if names else []


def _at_recorded_distance(distance: FloatArray, rows: FloatArray, references: Mapping[str, Reference]) -> Placement:
    """Return the recording's own distance as its placement, with the drive that it matches best."""
    distance, rows = evenly(distance, rows, float(np.ptp(distance)) / MOST_SAMPLES)  # beside the jumps
    likeness = {
        name: float(np.mean(correlations(distance, rows, *reference))) for name, reference in references.items()
    }
    best_match = max(likeness, key=likeness.__getitem__)
    signs = (1,) * len(rows)
    return Placement(offset=0.0, scale=1.0, likeness=likeness[best_match], reference=best_match, signs=signs)


def _signs(keys: Sequence[str]) -> list[Signs]:
    """Return the signs that signals may have, by convention."""
    there = [members for members in CONVENTIONS.values() if set(members) & set(keys)]
    choices = [dict(zip(there, signs, strict=True)) for signs in product((1, -1), repeat=len(there))]
    return [tuple(next((s for members, s in each.items() if key in members), 1) for key in keys) for each in choices]
