"""Where the paper is silent or misprinted and a reader may choose: each reading is a few fields of the scenario.

docs/errata.md has those that are no choice. The first choice of each is Ridelab's.
"""

from collections.abc import Mapping
from dataclasses import dataclass
from typing import Any

from sim_core.errors import UnknownNameError
from sim_core.scenario import Scenario
from sim_core.scenario.presets import PRESETS


@dataclass(frozen=True, slots=True, kw_only=True)
class Choice:
    """One way to read it: the fields it changes, by dotted name."""

    id: str
    label: str
    changes: Mapping[str, Any]


@dataclass(frozen=True, slots=True, kw_only=True)
class Reading:
    """One question the paper leaves open."""

    id: str
    title: str
    description: str
    choices: tuple[Choice, ...]

    @property
    def default(self) -> str:
        """Ridelab's choice."""
        return self.choices[0].id

    def choice(self, name: str) -> Choice:
        """The choice of that id.

        Raises:
            UnknownNameError: There is none; the message lists them.
        """
        for each in self.choices:
            if each.id == name:
                return each
        raise UnknownNameError(f"Unknown choice; there are {', '.join(each.id for each in self.choices)}")


def _half_car() -> dict[str, Any]:
    """The fields in which the half-car preset differs from the paper's."""
    half, paper = (
        scenario.model_dump(mode="json") for scenario in (PRESETS["half_car_consistent"].scenario, Scenario())
    )
    return {
        f"{part}.{name}": value
        for part in ("vehicle", "brake")
        for name, value in half[part].items()
        if value != paper[part][name]
    }


READINGS: dict[str, Reading] = {
    reading.id: reading
    for reading in (
        Reading(
            id="preview",
            title="Road preview",
            description="Eq. 9 predicts without the road; section 3.1 lets sensors see the bump. What the MPC knows of "
            "the road ahead decides most of the paper's claims.",
            choices=(
                Choice(id="lookahead", label="Road ahead", changes={"mpc.preview": "lookahead"}),
                Choice(id="wheelbase", label="Front axle's", changes={"mpc.preview": "wheelbase"}),
                Choice(id="none", label="None", changes={"mpc.preview": "none"}),
            ),
        ),
        Reading(
            id="lqr_preview",
            title="Preview for LQR too",
            description="The paper's LQR has none. With the same preview it is the fairer opponent.",
            choices=(
                Choice(id="none", label="None", changes={"lqr.preview": "none"}),
                Choice(id="wheelbase", label="Front axle's", changes={"lqr.preview": "wheelbase"}),
                Choice(id="lookahead", label="Road ahead", changes={"lqr.preview": "lookahead"}),
            ),
        ),
        Reading(
            id="travel_weight",
            title="Travel weight q4",
            description="Eq. 16 and the LQR's cost name three weights; a fourth, on travel, is ours. Without it an "
            "LQR uses far more travel than a car has.",
            choices=(
                Choice(id="3", label="3", changes={"mpc.deflection_weight": 3, "lqr.deflection_weight": 3}),
                Choice(id="0", label="0, literal", changes={"mpc.deflection_weight": 0, "lqr.deflection_weight": 0}),
            ),
        ),
        Reading(
            id="braking_moment",
            title="Braking pitches the body",
            description="Eq. 7 has no such term, though the brake stage exists to hold the pitch it causes.",
            choices=(
                Choice(id="on", label="Yes", changes={"vehicle.cg_height": Scenario().vehicle.cg_height}),
                Choice(id="off", label="No, literal", changes={"vehicle.cg_height": 0}),
            ),
        ),
        Reading(
            id="vehicle",
            title="Table 2's car",
            description="Its masses look like a whole car's, its stiffnesses like one wheel's.",
            choices=(
                Choice(id="printed", label="As printed", changes={}),
                Choice(id="half", label="Half the masses", changes=_half_car()),
            ),
        ),
        Reading(
            id="road_end",
            title="End of the road",
            description="Eq. 3 ends the road at 110 m; ours goes on to 150 m so that the car settles.",
            choices=(
                Choice(id="150", label="150 m", changes={"road.length": 150}),
                Choice(id="110", label="110 m, literal", changes={"road.length": 110}),
            ),
        ),
        Reading(
            id="sample_time",
            title="Control interval",
            description="The paper does not give it.",
            choices=(
                Choice(id="10", label="10 ms", changes={"mpc.sample_time": 0.01}),
                Choice(id="5", label="5 ms", changes={"mpc.sample_time": 0.005}),
                Choice(id="20", label="20 ms", changes={"mpc.sample_time": 0.02}),
            ),
        ),
        Reading(
            id="force_limit",
            title="Actuator force limit",
            description="The paper gives none.",
            choices=(
                Choice(id="5", label="5 kN", changes={"mpc.force_limit": 5000}),
                Choice(id="2.5", label="2.5 kN", changes={"mpc.force_limit": 2500}),
                Choice(id="10", label="10 kN", changes={"mpc.force_limit": 10_000}),
            ),
        ),
    )
}


def reading(name: str) -> Reading:
    """The reading of that id.

    Raises:
        UnknownNameError: There is none; the message lists the ids.
    """
    try:
        return READINGS[name]
    except KeyError:
        raise UnknownNameError(f"Unknown reading; there are {', '.join(READINGS)}") from None


def changes_of(chosen: Mapping[str, str]) -> dict[str, Any]:
    """The scenario's fields under these choices, by dotted name; readings not named take Ridelab's.

    Raises:
        UnknownNameError: No such reading or choice.
    """
    changes: dict[str, Any] = {}
    for name, choice in chosen.items():
        changes |= reading(name).choice(choice).changes
    return changes
