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
_SENTENCES = {
    "sag": f"The body's weight compresses the suspension by {{}}; usual is less than {1000 * LARGEST_SAG:.0f} mm.",
    "body_frequency": "The body's natural frequency is {{}}; usual is {:g} to {:g} Hz.".format(*BODY_FREQUENCIES),
}


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
    return tuple(
        _sag_caution(vehicle, values)
        if kind == "sag"
        else Caution(kind=kind, text=f"{_sentence(kind, values)} {_ONE_TRACK}", field=_field(values))
        for kind, values in _unusual(vehicle, vehicle).items()
    )


def _sag_caution(vehicle: Vehicle, sags: Mapping[str, str]) -> Caution:
    """Return the warning of a vehicle's sag, with the frequencies that it leads to."""
    deciding = ("body_mass", "cg_to_front", "cg_to_rear", *(f"{axle}_spring" for axle in sags))
    is_papers = all(getattr(vehicle, name) == getattr(_PAPERS, name) for name in deciding)
    kind, origin = (PAPER_SAG, _PRINTED) if is_papers else ("sag", _ONE_TRACK)
    notes = {axle: f" ({_hertz(vehicle, axle)} Hz)" for axle in sags}
    return Caution(kind=kind, text=f"{_sentence('sag', sags, notes)} {origin}", field=_field(sags))


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
    of_believed = _unusual(believed, believed)
    for kind, values in _unusual(believed, real).items():
        if values != of_believed.get(kind):
            factors = (name for name in ("body_mass", "springs", "tyres") if getattr(scenario.mismatch, name) != 1)
            yield Caution(kind=kind, text=f"{_sentence(kind, values)} {_REAL}", field=f"mismatch.{next(factors)}")
    pressed = {axle: min(pair) for axle, pair in zip(_AXLES, zip(*real.stop_clearances, strict=True), strict=True)}
    if resting := {axle: f"{-1000 * each:.0f} mm" for axle, each in pressed.items() if round(each, 3) < 0}:
        text = f"At rest the driven car presses its stops by {_at_axles(resting)}: it has no travel left that way."
        yield Caution(kind="rests_on_stops", text=text, field="vehicle.bump_stop_clearance")


def _unusual(believed: Vehicle, driven: Vehicle) -> dict[str, dict[str, str]]:
    """Return by kind what a driven vehicle has outside the usual range, as it is written, by axle."""
    sags, (low, high) = characteristics(believed).static_sag, BODY_FREQUENCIES
    unusual: dict[str, dict[str, str]] = {"sag": {}, "body_frequency": {}}
    for axle, lowered in zip(_AXLES, driven.lowered, strict=True):
        sag, frequency = getattr(sags, axle) + lowered, _hertz(driven, axle)
        if round(sag, 3) > LARGEST_SAG:
            unusual["sag"][axle] = f"{1000 * sag:.0f} mm"
        if not low <= float(frequency) <= high:
            unusual["body_frequency"][axle] = f"{frequency} Hz"
    return {kind: values for kind, values in unusual.items() if values}


def _hertz(vehicle: Vehicle, axle: str) -> str:
    """Return the body's natural frequency above an axle [Hz] as it is written, by which it is judged."""
    return f"{getattr(characteristics(vehicle).natural_frequencies, f'{axle}_body'):.2g}"


def _sentence(kind: str, values: Mapping[str, str], notes: Mapping[str, str] | None = None) -> str:
    return _SENTENCES[kind].format(_at_axles(values, notes))


def _at_axles(values: Mapping[str, str], notes: Mapping[str, str] | None = None) -> str:
    """Return each axle's value, and behind it its note."""
    return " and ".join(f"{value} at the {axle} axle{(notes or {}).get(axle, '')}" for axle, value in values.items())


def _field(axles: Mapping[str, str]) -> str:
    """Return the field to look at for what these axles have."""
    return "vehicle.body_mass" if len(axles) == len(_AXLES) else f"vehicle.{next(iter(axles))}_spring"
