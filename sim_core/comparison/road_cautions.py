"""Warnings about road heights outside the usual range, and about roads without a class of ISO 8608."""

from collections.abc import Sequence

from sim_core.comparison.caution import Caution
from sim_core.scenario import Bump, Scenario

LOWEST_IRI, HIGHEST_IRI = 0.1, 30.0
"""Between them is what roads have [m/km]: new motorways about 1, damaged unpaved roads up to 20.

M. W. Sayers and S. M. Karamihas 1998, The Little Book of Profiling, University of Michigan, figure of the IRI scale.
"""

SHORT = 50.0
"""From this length on, the fit's interval is narrow enough for a class where the spectrum is a straight line [m]."""

_IN_WORDS = ((2.0, "smooth"), (4.0, "fairly smooth"), (8.0, "rough"), (HIGHEST_IRI, "very rough"))
"""Upper ends [m/km], chosen after the same figure: its new pavements, older ones, damaged ones, rough unpaved roads."""


def road_cautions(tracks: Sequence[float]) -> tuple[Caution, ...]:
    """Return the warnings of heights with an International Roughness Index below 0.1 or above 30 m/km.

    Args:
        tracks: The index of each wheel track [m/km], as `sim_core.road.iri.iri` gives it.

    Returns:
        At most one, of kind `iri`, at the field `road.profile`.

    Example:
        >>> from sim_core.comparison.road_cautions import road_cautions
        >>> [each.kind for each in road_cautions([2.1, 0.002])]
        ['iri']
    """
    odd = [value for value in tracks if not LOWEST_IRI <= value <= HIGHEST_IRI]
    if not odd:
        return ()
    usual = f"roads have {LOWEST_IRI:g} to {HIGHEST_IRI:g} m/km, new motorways about 1"
    values = " and ".join(f"{value:.3g} m/km" for value in odd)
    text = f"The International Roughness Index of these heights is {values}; {usual}. Is the unit of the heights right?"
    return (Caution(kind="iri", text=text, field="road.profile"),)


def bump_cautions(scenario: Scenario) -> tuple[Caution, ...]:
    """Return the warning that the paper's own bump lies on a measured road: the default that nobody has chosen.

    Returns:
        At most one, of kind `added_bump`, at the field `road.bump.height`.

    Example:
        >>> from sim_core import Scenario
        >>> from sim_core.comparison.road_cautions import bump_cautions
        >>> [each.kind for each in bump_cautions(Scenario.model_validate({"road": {"profile": 22 * "a"}}))]
        ['added_bump']
    """
    bump = scenario.road.bump
    if scenario.road.profile is None or bump != Bump():
        return ()
    added = f"The paper's bump, {100 * bump.height:g} cm high at {bump.start:g} m, is added to the measured road"
    return (Caution(kind="added_bump", text=f"{added}. A height of 0 adds none.", field="road.bump.height"),)


def spectrum_caution(span: float, length: float, index: float) -> Caution:
    """Return the warning of a road to which no class of ISO 8608 is given, as its roughness is too uncertain.

    Args:
        span: The upper end of the interval of its roughness over the lower one [1].
        length: Of the road [m].
        index: Mean International Roughness Index of its tracks [m/km].

    Returns:
        The warning, of kind `spectrum`, at the field `road.profile`.

    Example:
        >>> from sim_core.comparison.road_cautions import spectrum_caution
        >>> spectrum_caution(825.2, 100.0, 10.88).text.partition(". ")[2]
        'By its IRI of 10.9 m/km it is a very rough road.'
    """
    reason = "the road's spectrum is not a straight line"
    if length < SHORT:
        reason = f"the road is short ({length:.3g} m) or its spectrum is not a straight line"
    text = f"No ISO 8608 class: {reason}, so its roughness is uncertain by a factor of {_rounded(span)}."
    rough = next((word for end, word in _IN_WORDS if index <= end), None)
    if rough is not None and index >= LOWEST_IRI:
        text += f" By its IRI of {index:.3g} m/km it is a {rough} road."
    return Caution(kind="spectrum", text=text, field="road.profile")


def _rounded(span: float) -> str:
    """Return two digits of a factor; beyond a million it says no more than that."""
    return f"{float(f'{span:.2g}'):,.0f}" if span < 1e6 else "more than a million"
