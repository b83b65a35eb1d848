"""Warnings about vehicle parameters outside the usual range."""

from collections.abc import Iterator, Mapping
from dataclasses import asdict
from typing import Any

from sim_core.comparison.caution import Caution
from sim_core.comparison.road_cautions import bump_cautions
from sim_core.scenario import Scenario
from sim_core.scenario.characteristics import characteristics
from sim_core.scenario.vehicle import Vehicle

LARGEST_SAG = 0.2  # [m]
BODY_FREQUENCIES = 0.5, 3.0  # [Hz]
PAPER_SAG = "paper_sag"
"""The kind of a sag that the values of the paper's Table 2 lead to: it says nothing about what a user has entered."""

_AXLES = "front", "rear"
_ONE_TRACK = "Masses, springs and dampers are those of one track, half of the car."
_PRINTED = "These are the paper's own values (Table 2)."
_REAL = "This is the car that is driven, with the factors of the model mismatch."
_PAPERS = Vehicle()


def vehicle_cautions(vehicle: Vehicle) -> tuple[Caution, ...]:
    """Return the warnings of a vehicle with more than 200 mm of static sag or a body's frequency outside 0.5 to 3 Hz.

    Args:
        vehicle: The half-car.

    Returns:
        At most one of each kind, `sag` and `body_frequency`, at the field to look at: the body mass where both axles
        have it, else the axle's spring. The kind of a sag is `paper_sag` where all that decides is the paper's.

    Example:
        >>> from sim_core import Scenario
        >>> from sim_core.comparison.vehicle_cautions import vehicle_cautions
        >>> heavy = Scenario.model_validate({"vehicle": {"body_mass": 2400}}).vehicle
        >>> [(each.kind, each.field) for each in vehicle_cautions(heavy)]
        [('sag', 'vehicle.body_mass')]
    """
    cautions = []
    if sags := _deep_sags(vehicle):
        is_papers = _is_papers(vehicle, sags)
        kind, origin = (PAPER_SAG, _PRINTED) if is_papers else ("sag", _ONE_TRACK)
        text = f"{_sag_text(sags, _frequencies(vehicle))} {origin}"
        cautions.append(Caution(kind=kind, text=text, field=_field(sags)))
    if frequencies := _odd_frequencies(vehicle):
        text = f"{_frequency_text(frequencies)} {_ONE_TRACK}"
        cautions.append(Caution(kind="body_frequency", text=text, field=_field(frequencies)))
    return tuple(cautions)


def vehicle_facts(vehicle: Vehicle) -> dict[str, Any]:
    """Return a vehicle's `characteristics` and `cautions` as plain values.

    Example:
        >>> from sim_core import Scenario
        >>> from sim_core.comparison.vehicle_cautions import vehicle_facts
        >>> list(vehicle_facts(Scenario().vehicle))
        ['characteristics', 'cautions']
    """
    return {
        "characteristics": asdict(characteristics(vehicle)),
        "cautions": [asdict(caution) for caution in vehicle_cautions(vehicle)],
    }


def scenario_cautions(scenario: Scenario) -> tuple[Caution, ...]:
    """Return the warnings of a scenario: of its vehicles, the believed and the driven one, and of its road.

    Args:
        scenario: What is driven.

    Returns:
        `vehicle_cautions` of the believed vehicle; of the driven one `sag` and `body_frequency` where they differ from
        the believed one's, at the factor that leads to them, and `rests_on_stops` where its weight is borne by a
        stop, too; and `bump_cautions`.

    Example:
        >>> from sim_core import Scenario
        >>> from sim_core.comparison.vehicle_cautions import scenario_cautions
        >>> loaded = Scenario.model_validate(
        ...     {"vehicle": {"front_spring": 45000, "rear_spring": 45000}, "mismatch": {"body_mass": 2}}
        ... )
        >>> [(each.kind, each.field) for each in scenario_cautions(loaded)]
        [('sag', 'mismatch.body_mass')]
    """
    believed = vehicle_cautions(scenario.vehicle)
    real = () if scenario.real_vehicle is scenario.vehicle else _real_cautions(scenario)
    return (*believed, *real, *bump_cautions(scenario))


def _real_cautions(scenario: Scenario) -> Iterator[Caution]:
    """Return the warnings of the driven vehicle that are not those of the believed one."""
    believed, real = scenario.vehicle, scenario.real_vehicle
    if (sags := _deep_sags(believed, real.lowered)) and _sag_text(sags) != _sag_text(_deep_sags(believed)):
        yield Caution(kind="sag", text=f"{_sag_text(sags)} {_REAL}", field=_changed(scenario))
    frequencies, others = _odd_frequencies(real), _odd_frequencies(believed)
    if frequencies and _frequency_text(frequencies) != _frequency_text(others):
        yield Caution(kind="body_frequency", text=f"{_frequency_text(frequencies)} {_REAL}", field=_changed(scenario))
    pressed = {axle: min(pair) for axle, pair in zip(_AXLES, zip(*real.stop_clearances, strict=True), strict=True)}
    if resting := {axle: f"{-1000 * each:.0f} mm" for axle, each in pressed.items() if round(each, 3) < 0}:
        text = f"At rest the driven car presses its stops by {_at_axles(resting)}: it has no travel left that way."
        yield Caution(kind="rests_on_stops", text=text, field="vehicle.bump_stop_clearance")


def _changed(scenario: Scenario) -> str:
    """Return the first factor that changes the body's sag or its natural frequency."""
    names = ("body_mass", "springs", "tyres")
    return next(f"mismatch.{name}" for name in names if getattr(scenario.mismatch, name) != 1)


def _deep_sags(vehicle: Vehicle, lowered: tuple[float, float] = (0.0, 0.0)) -> dict[str, float]:
    """Return the static sag [m] of each axle that has more than usual; `lowered` comes on top of it, front and rear."""
    sags = characteristics(vehicle).static_sag
    sums = {axle: getattr(sags, axle) + more for axle, more in zip(_AXLES, lowered, strict=True)}
    return {axle: sag for axle, sag in sums.items() if round(sag, 3) > LARGEST_SAG}


def _odd_frequencies(vehicle: Vehicle) -> dict[str, float]:
    """Return the body's natural frequency [Hz] above each axle where it is outside the usual range."""
    low, high = BODY_FREQUENCIES
    return {axle: value for axle, value in _frequencies(vehicle).items() if not low <= float(_hertz(value)) <= high}


def _frequencies(vehicle: Vehicle) -> dict[str, float]:
    """Return the body's natural frequency [Hz] above each axle."""
    values = characteristics(vehicle).natural_frequencies
    return {axle: getattr(values, f"{axle}_body") for axle in _AXLES}


def _hertz(value: float) -> str:
    """Return a frequency [Hz] as it is written; what is written decides whether it is usual, too."""
    return f"{value:.2g}"


def _sag_text(sags: Mapping[str, float], frequencies: Mapping[str, float] | None = None) -> str:
    by_axle = _at_axles({axle: f"{1000 * sag:.0f} mm" for axle, sag in sags.items()}, frequencies)
    return f"The body's weight compresses the suspension by {by_axle}; usual is less than {1000 * LARGEST_SAG:.0f} mm."


def _frequency_text(frequencies: Mapping[str, float]) -> str:
    low, high = BODY_FREQUENCIES
    by_axle = _at_axles({axle: f"{_hertz(value)} Hz" for axle, value in frequencies.items()})
    return f"The body's natural frequency is {by_axle}; usual is {low:g} to {high:g} Hz."


def _at_axles(by_axle: Mapping[str, str], frequencies: Mapping[str, float] | None = None) -> str:
    """Return each axle's value; behind it, where they are given, the body's natural frequency [Hz] above the axle."""
    notes = {axle: f" ({_hertz(value)} Hz)" for axle, value in (frequencies or {}).items()}
    return " and ".join(f"{value} at the {axle} axle{notes.get(axle, '')}" for axle, value in by_axle.items())


def _is_papers(vehicle: Vehicle, axles: Mapping[str, float]) -> bool:
    """Check whether everything that decides about the sag of these axles is as in the paper's Table 2."""
    deciding = ("body_mass", "cg_to_front", "cg_to_rear", *(f"{axle}_spring" for axle in axles))
    return all(getattr(vehicle, name) == getattr(_PAPERS, name) for name in deciding)


def _field(axles: Mapping[str, float]) -> str:
    """Return the field to look at for what these axles have."""
    return "vehicle.body_mass" if len(axles) == len(_AXLES) else f"vehicle.{next(iter(axles))}_spring"
