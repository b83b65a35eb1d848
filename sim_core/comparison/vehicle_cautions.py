"""What a vehicle's parameters come to that a car's hardly do: most often a whole car's mass on one track's springs."""

from collections.abc import Mapping, Sequence

from sim_core.comparison.caution import Caution
from sim_core.scenario.characteristics import characteristics
from sim_core.scenario.vehicle import Vehicle

LARGEST_SAG = 0.2  # [m]
BODY_FREQUENCIES = 0.5, 3.0  # [Hz]
PAPER_SAG = "paper_sag"
"""The kind of a sag that the values of the paper's Table 2 lead to: it says nothing about what a user has entered."""

_AXLES = "front", "rear"
_ONE_TRACK = "Masses, springs and dampers are of one track, half of the car: "
_TOO_HEAVY = f"{_ONE_TRACK}is the body mass a whole car's?"
_TOO_STIFF = f"{_ONE_TRACK}are the springs a whole axle's?"
_PRINTED = "These are the paper's own values (Table 2)."
_PAPERS = Vehicle()


def vehicle_cautions(vehicle: Vehicle) -> tuple[Caution, ...]:
    """Name what a vehicle has that cars hardly have: more than 200 mm of static sag, a body outside 0.5 to 3 Hz.

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
    values, (low, high) = characteristics(vehicle), BODY_FREQUENCIES
    sags = {axle: getattr(values.static_sag, axle) for axle in _AXLES}
    frequencies = {axle: getattr(values.natural_frequencies, f"{axle}_body") for axle in _AXLES}
    deep = {axle: f"{1000 * sag:.0f} mm" for axle, sag in sags.items() if sag > LARGEST_SAG}
    odd = {axle: f"{value:.2g} Hz" for axle, value in frequencies.items() if not low <= value <= high}
    cautions = []
    if deep:
        usual = f"usual is less than {1000 * LARGEST_SAG:.0f} mm"
        text = f"The body's weight compresses the suspension by {_listed(deep)}; {usual}."
        cautions.append(_caution("sag", text, _TOO_HEAVY, list(deep), vehicle))
    if odd:
        text = f"The body's natural frequency is {_listed(odd)}; usual is {low:g} to {high:g} Hz."
        is_low = min(frequencies.values()) < low
        cautions.append(_caution("body_frequency", text, _TOO_HEAVY if is_low else _TOO_STIFF, list(odd), vehicle))
    return tuple(cautions)


def _listed(by_axle: Mapping[str, str]) -> str:
    return " and ".join(f"{value} at the {axle} axle" for axle, value in by_axle.items())


def _caution(kind: str, text: str, question: str, axles: Sequence[str], vehicle: Vehicle) -> Caution:
    deciding = ("body_mass", "cg_to_front", "cg_to_rear", *(f"{axle}_spring" for axle in axles))
    is_printed = kind == "sag" and all(getattr(vehicle, name) == getattr(_PAPERS, name) for name in deciding)
    return Caution(
        kind=PAPER_SAG if is_printed else kind,
        text=f"{text} {_PRINTED if is_printed else question}",
        field="vehicle.body_mass" if len(axles) == len(_AXLES) else f"vehicle.{axles[0]}_spring",
    )
