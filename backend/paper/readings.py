"""Where the paper is silent or misprinted and a reader may choose: each reading is a few fields of the scenario.

docs/reference/errata.md has those that are no choice. The first choice of each is Ridelab's. Each choice says which
sentence or equation of the paper has it, or that it is ours. Three sets of choices have a name: the paper as Ridelab
reads it, as most of its printed changes are reached, and as its printed absolutes come out nearest.
"""

from collections.abc import Mapping
from dataclasses import dataclass, field
from typing import Any

from sim_core.errors import UnknownNameError
from sim_core.scenario import Scenario
from sim_core.scenario.presets import PRESETS
from sim_core.scenario.road import CLASS_MEANS

OURS = "ours"
TYRE_LOADS = "tyre_loads"  # the reading that changes no run, only how tyre loads are shown

_LOADS = ("front_tyre_load", "rear_tyre_load")

# First and last position of the front axle [m].
Intervals = tuple[tuple[float, float], ...]


@dataclass(frozen=True, slots=True, kw_only=True)
class Choice:
    """One way to read it.

    Attributes:
        id: Stable name.
        label: Short, for a switch.
        source: The sentence or equation of the paper that has it, or `OURS`.
        changes: The fields it changes, by dotted name.
        intervals: Where the RMS on the rough road are taken, of a choice of the reading `window`; None is the run's own
            window, 0 to the bump.
        load_factor: By which tyre loads are multiplied where they are shown, of a choice of the reading `tyre_loads`.
    """

    id: str
    label: str
    source: str
    changes: Mapping[str, Any] = field(default_factory=dict)
    intervals: Intervals | None = None
    load_factor: float = 1.0


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


def _by_value(field: str, unit: str, values: Mapping[str, float], source: str = OURS) -> tuple[Choice, ...]:
    """Return choices of a field's values, each value by its number in a unit."""
    return tuple(
        Choice(id=number, label=f"{number} {unit}", source=source, changes={field: value})
        for number, value in values.items()
    )


READINGS: dict[str, Reading] = {
    reading.id: reading
    for reading in (
        Reading(
            id="preview",
            title="Road preview",
            description="Eq. 9 predicts without the road; section 3.1 lets sensors see the bump. What the MPC knows of "
            "the road ahead decides most of the paper's claims.",
            choices=(
                Choice(
                    id="lookahead",
                    label="Road ahead",
                    source="Section 3.1: sensors identify the bump and its distance; that they see all of the road "
                    "ahead is ours",
                    changes={"mpc.preview": "lookahead"},
                ),
                Choice(
                    id="obstacle",
                    label="Bump",
                    source="Section 3.1: sensors identify the bump and its distance",
                    changes={"mpc.preview": "obstacle"},
                ),
                Choice(id="wheelbase", label="Front axle's", source=OURS, changes={"mpc.preview": "wheelbase"}),
                Choice(
                    id="none",
                    label="None",
                    source="Eq. 9 has no road input",
                    changes={"mpc.preview": "none"},
                ),
            ),
        ),
        Reading(
            id="lqr_preview",
            title="Preview for LQR too",
            description="The paper's LQR has none. With the same preview it is the fairer opponent.",
            choices=(
                Choice(
                    id="none",
                    label="None",
                    source="Section 4.2.2 names its objective and no preview",
                    changes={"lqr.preview": "none"},
                ),
                Choice(id="obstacle", label="Bump", source=OURS, changes={"lqr.preview": "obstacle"}),
                Choice(id="wheelbase", label="Front axle's", source=OURS, changes={"lqr.preview": "wheelbase"}),
                Choice(id="lookahead", label="Road ahead", source=OURS, changes={"lqr.preview": "lookahead"}),
            ),
        ),
        Reading(
            id="window",
            title="Where the RMS are taken",
            description="Section 4.1.1 takes the RMS on the graded road surface, section 4.2.2 over the full course.",
            choices=(
                Choice(
                    id="to_bump",
                    label="0 to 100 m",
                    source="Section 4.1.1: driving on a graded road surface; that it ends at the bump is ours",
                ),
                Choice(
                    id="class_b",
                    label="Class B parts",
                    source="Eq. 3: class B from 0 to 100 m and from 104 to 110 m",
                    intervals=((0, 100), (104, 110)),
                ),
                Choice(
                    id="full_course",
                    label="0 to 110 m",
                    source="Section 4.2.2: RMS for the full course, which by Eq. 3 ends at 110 m",
                    intervals=((0, 110),),
                ),
            ),
        ),
        Reading(
            id="travel_weight",
            title="Travel weight q4",
            description="A weight on suspension travel is ours. Without it an LQR uses far more travel than a car has.",
            choices=(
                Choice(
                    id="3",
                    label="3",
                    source=OURS,
                    changes={"mpc.deflection_weight": 3, "lqr.deflection_weight": 3},
                ),
                Choice(
                    id="0",
                    label="0",
                    source="Eq. 16 and section 4.2.2 name three weights",
                    changes={"mpc.deflection_weight": 0, "lqr.deflection_weight": 0},
                ),
            ),
        ),
        Reading(
            id="braking_moment",
            title="Braking pitches the body",
            description="Eq. 7 has no such term, though the brake stage exists to hold the pitch it causes.",
            choices=(
                Choice(
                    id="on",
                    label="Yes",
                    source="Section 3.3: braking changes the body's attitude; the term is ours",
                    changes={"vehicle.cg_height": Scenario().vehicle.cg_height},
                ),
                Choice(id="off", label="No", source="Eq. 7 as printed", changes={"vehicle.cg_height": 0}),
            ),
        ),
        Reading(
            id="vehicle",
            title="Table 2's car",
            description="Its masses look like a whole car's, its stiffnesses like one wheel's.",
            choices=(
                Choice(id="printed", label="As printed", source="Table 2"),
                Choice(id="half", label="Half the masses", source=OURS, changes=_half_car()),
            ),
        ),
        Reading(
            id="road_end",
            title="End of the road",
            description="Eq. 3 ends the road at 110 m; ours goes on to 150 m so that the car settles.",
            choices=(
                Choice(id="150", label="150 m", source=OURS, changes={"road.length": 150}),
                Choice(id="110", label="110 m", source="Eq. 3", changes={"road.length": 110}),
            ),
        ),
        Reading(
            id="sample_time",
            title="Control interval",
            description="The paper does not give it.",
            choices=_by_value("mpc.sample_time", "ms", {"10": 0.01, "5": 0.005, "20": 0.02}),
        ),
        Reading(
            id="force_limit",
            title="Actuator force limit",
            description="The paper gives none.",
            choices=(
                *_by_value("mpc.force_limit", "kN", {"5": 5000, "2.5": 2500, "10": 10_000, "20": 20_000}),
                Choice(
                    id="none",
                    label="None",
                    source="Eq. 12-15 limit the deflection alone; 100 kN stands for none",
                    changes={"mpc.force_limit": 100_000},
                ),
            ),
        ),
        Reading(
            id="travel_limit",
            title="Travel limit",
            description="Eq. 14 names a limit of the deflection, f_dmax; the paper gives no value. None is 1 m here; "
            "the travel weight is divided by its square.",
            choices=(
                *_by_value("mpc.deflection_limit", "mm", {"80": 0.08, "100": 0.1}),
                Choice(id="none", label="None", source=OURS, changes={"mpc.deflection_limit": 1}),
            ),
        ),
        Reading(
            id="rear_axle",
            title="Rear axle",
            description="No equation delays the road under the rear axle. A car's meets it later, by the wheelbase.",
            choices=(
                Choice(id="in_turn", label="A wheelbase later", source=OURS, changes={"road.rear_axle": "in_turn"}),
                Choice(
                    id="together",
                    label="With the front",
                    source="Eq. 7 has a road under each axle and no delay between them",
                    changes={"road.rear_axle": "together"},
                ),
            ),
        ),
        Reading(
            id="roughness",
            title="Road class",
            description="Twice as high a road, class C, gives the printed RMS without control.",
            choices=(
                Choice(
                    id="B",
                    label="B",
                    source="Section 2.1.1: 64e-6 m³, class B",
                    changes={"road.roughness": CLASS_MEANS["B"]},
                ),
                Choice(id="C", label="C", source=OURS, changes={"road.roughness": CLASS_MEANS["C"]}),
            ),
        ),
        Reading(
            id="bump_speed",
            title="Speed over the bump",
            description="Of those that slow down. The paper names a range.",
            choices=_by_value(
                "speed.target_speed_kmh", "km/h", {"22.5": 22.5, "20": 20, "25": 25}, "Section 3.1: 20 to 25 km/h"
            ),
        ),
        Reading(
            id=TYRE_LOADS,
            title="Tyre loads, as shown",
            description="No damping gives the printed tyre loads beside the printed body acceleration. A factor "
            "changes no run and cancels in every change.",
            choices=(
                Choice(id="computed", label="As computed", source="Eq. 7: tyre stiffness times deflection"),
                Choice(id="doubled", label="× 2", source=OURS, load_factor=2.0),
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


def load_factor(choices: Mapping[str, str], signal: str) -> float:
    """Return by what a signal's absolutes are multiplied where they are shown: 2 for doubled tyre loads, else 1.

    Raises:
        UnknownNameError: There is no such choice.
    """
    chosen = reading(TYRE_LOADS)
    return chosen.choice(choices.get(TYRE_LOADS, chosen.default)).load_factor if signal in _LOADS else 1.0


def changes_of(choices: Mapping[str, str]) -> dict[str, Any]:
    """The scenario's fields under these choices, by dotted name; readings not named take Ridelab's.

    Raises:
        UnknownNameError: No such reading or choice.
    """
    changes: dict[str, Any] = {}
    for name, choice in choices.items():
        changes |= reading(name).choice(choice).changes
    return changes


@dataclass(frozen=True, slots=True, kw_only=True)
class Interpretation:
    """A named set of choices; `otherwise` has those that are not the default, by reading."""

    id: str
    title: str
    description: str
    otherwise: Mapping[str, str]

    @property
    def choices(self) -> dict[str, str]:
        """Reading -> choice, all of them."""
        return {each.id: self.otherwise.get(each.id, each.default) for each in READINGS.values()}


DEFAULT = Interpretation(
    id="default",
    title="Default",
    description="Every switch as Ridelab reads the paper.",
    otherwise={},
)
FAVOURABLE = Interpretation(
    id="favourable",
    title="Favourable",
    description="No braking moment (Eq. 7 as printed) and RMS over the full course (section 4.2.2); a control interval "
    "and limits, all ours, that leave the controllers room.",
    otherwise={
        "window": "full_course",
        "braking_moment": "off",
        "sample_time": "5",
        "force_limit": "20",
        "travel_limit": "100",
    },
)
NEAREST = Interpretation(
    id="nearest",
    title="Nearest",
    description="What comes nearest to the printed values without control: both axles meet the road together, class C, "
    "25 km/h on the bump, no limits of force or travel, and tyre loads doubled, which has no explanation.",
    otherwise={
        "force_limit": "none",
        "travel_limit": "none",
        "rear_axle": "together",
        "roughness": "C",
        "bump_speed": "25",
        TYRE_LOADS: "doubled",
    },
)
INTERPRETATIONS = {each.id: each for each in (DEFAULT, FAVOURABLE, NEAREST)}


def interpretation_of(choices: Mapping[str, str]) -> str | None:
    """The id of the set that makes just these choices (reading -> choice, all of them), if one does."""
    return next((each.id for each in INTERPRETATIONS.values() if each.choices == choices), None)
