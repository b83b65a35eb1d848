"""Which simulated drive a recording is likest, where, and which of its signals are recorded the other way round."""

from collections.abc import Callable, Mapping, Sequence
from dataclasses import dataclass
from itertools import product

import numpy as np

from sim_core.arrays import FloatArray
from sim_core.catalogue import METRIC_SIGNALS, SIGNALS
from sim_core.errors import RefusedError, TooExpensiveError
from sim_core.recorded.alignment import Placement, Reference, Signs, correlations, evenly, place
from sim_core.recorded.track import Track
from sim_core.recorded.tyre_peaks import on_this_road
from sim_core.result import StrategyResult
from sim_core.scenario import Scenario
from sim_core.strategies import REFERENCE_STRATEGIES, STRATEGIES

PLACED_BY = METRIC_SIGNALS[:6]  # not by the forces, in which laws differ most
OPPOSITE = -0.5  # correlation of a signal whose sign may be the other way round
MOST_SAMPLES = 100_000  # of a simulated drive
# Signals that are recorded the other way round together: z may point down, compression may count positive.
CONVENTIONS = {
    "z points down": ("body_acceleration",),
    "compression counts positive": ("front_deflection", "rear_deflection"),
}
_UNPLACED = (
    "It was not placed: at no one place of this road is it like a simulated drive beyond chance; its distance is taken "
    "as the position"
)


@dataclass(frozen=True, slots=True, kw_only=True)
class Placed:
    """A recording on a road.

    Attributes:
        placement: None where it was not placed.
        position: On the road (m,) [m].
        turned: The signals whose sign is turned.
        notes: All of this in words.
    """

    placement: Placement | None
    position: FloatArray
    turned: tuple[str, ...]
    notes: tuple[str, ...]


def placed(
    scenario: Scenario, drives: Callable[[str], StrategyResult], signals: Mapping[str, FloatArray], track: Track
) -> Placed:
    """Place a recording where it is likest any of our strategies; where it says, if its road heights are this road's.

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
    if references and all(on_this_road(scenario, signals, track.distance)):
        placement = _as_it_says(track.distance, rows, references)
    elif references:
        placement = place(track.distance, rows, references, _signs(keys), smooth=scenario.road.is_smooth)
    if placement is None:
        unplaced = _UNPLACED, *left_out, *_on_its_bump(scenario, track.distance, rows, references, _signs(keys))
        return Placed(placement=None, position=track.distance, turned=(), notes=unplaced)
    position = placement.offset + placement.scale * track.distance
    likest = f"{STRATEGIES[placement.reference].label} (correlation {placement.likeness:.2f})"
    notes = [
        f"It was placed where it is like {likest}: position = {placement.offset:.3f} m + {placement.scale:.5f} of its "
        "distance"
    ]
    turned = tuple(key for key, sign in zip(keys, placement.signs, strict=True) if sign < 0)
    for convention, members in CONVENTIONS.items():
        if which := [SIGNALS[key].label for key in members if key in turned]:
            notes.append(f"{' and '.join(which)}: against the simulated drive, so {convention}; the sign is turned")
    there = correlations(position, np.array(placement.signs)[:, None] * rows, *references[placement.reference])
    notes += [
        f"{SIGNALS[key].label} moves against the simulated one: is its sign the other way round?"
        for key, value in zip(keys, there, strict=True)
        if value < OPPOSITE
    ]
    return Placed(placement=placement, position=position, turned=turned, notes=(*notes, *left_out))


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
    """Say where it lies if it is a drive over another road that has the same bump."""
    if scenario.road.is_smooth or not scenario.road.has_bump or not references:
        return []
    alike = place(distance, rows, references, signs, smooth=True)
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


def _as_it_says(distance: FloatArray, rows: FloatArray, references: Mapping[str, Reference]) -> Placement:
    """The recording at its own distance, with the drive that it is likest."""
    distance, rows = evenly(distance, rows, float(np.ptp(distance)) / MOST_SAMPLES)  # beside the jumps
    likeness = {
        name: float(np.mean(correlations(distance, rows, *reference))) for name, reference in references.items()
    }
    likest = max(likeness, key=likeness.__getitem__)
    signs = (1,) * len(rows)
    return Placement(offset=0.0, scale=1.0, likeness=likeness[likest], reference=likest, signs=signs)


def _signs(keys: Sequence[str]) -> list[Signs]:
    """The signs that signals may have, by convention."""
    there = [members for members in CONVENTIONS.values() if set(members) & set(keys)]
    chosen = [dict(zip(there, signs, strict=True)) for signs in product((1, -1), repeat=len(there))]
    return [tuple(next((s for members, s in each.items() if key in members), 1) for key in keys) for each in chosen]
