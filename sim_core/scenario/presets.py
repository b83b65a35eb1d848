"""Named scenarios; the paper's first."""

from dataclasses import dataclass

from sim_core.errors import UnknownNameError
from sim_core.scenario import Brake, Bump, Mpc, Road, Scenario, Speed, StageWeights, Vehicle


@dataclass(frozen=True, slots=True, kw_only=True)
class Preset:
    """A scenario with a name and a sentence on what it is."""

    id: str
    label: str
    description: str
    scenario: Scenario


# Trial 79 of the 150 of `make robust` (benchmarks/robust.py), which says what it is worth.
_ROBUST = Mpc(
    expected_offset=0.43,
    expected_noise=0.0041,
    sample_time=0.005,
    prediction_horizon=50,
    deflection_weight=11,
    stage_weights=StageWeights(cruise=(1, 1.2, 2.2), brake=(1, 1.2, 2.2), bump=(0.87, 4.1, 5.1)),
)

# docs/explanation/nearest.md has why. The limits are beyond what any strategy of the paper reaches.
_NEAREST = Scenario(
    road=Road(roughness=256e-6, rear_axle="together"),
    speed=Speed(target_speed_kmh=25),
    mpc=Mpc(force_limit=100_000, deflection_limit=1),
)

_HALF = Vehicle().model_copy(
    update={"body_mass": 635.0, "pitch_inertia": 768.35, "front_wheel_mass": 33.15, "rear_wheel_mass": 33.15}
)

PRESETS: dict[str, Preset] = {
    preset.id: preset
    for preset in (
        Preset(
            id="paper",
            label="Paper",
            description="Meng et al. 2025 as printed: 50 km/h, class B road, 0.1 m × 4 m cosine bump at 100 m.",
            scenario=Scenario(),
        ),
        Preset(
            id="half_car_consistent",
            label="Half car, consistent",
            description="One track's share of the paper's masses and inertia on the same wheels: Table 2 gives a whole "
            "car's masses with one wheel's stiffnesses.",
            scenario=Scenario(vehicle=_HALF, brake=Brake(drag_area=0.325)),
        ),
        Preset(
            id="paper_nearest",
            label="Paper, nearest",
            description="What comes nearest to the paper's printed values without control: both axles meet the road "
            "together, class C, 25 km/h on the bump, no limits of force or travel. Tyre loads are not doubled: "
            "the paper's printed tyre loads are about twice these. Not known to be what they did.",
            scenario=_NEAREST,
        ),
        Preset(
            id="robust",
            label="Robust LV",
            description="The paper's car and road with weights and a preview for LV that keep its lead over LQR where "
            "car, sensors and actuators are not what it believes.",
            scenario=Scenario(mpc=_ROBUST),
        ),
        Preset(
            id="bump_only",
            label="Bump on a smooth road",
            description="The paper's car and bump without roughness: the response to the bump alone.",
            scenario=Scenario(road=Road(roughness=0)),
        ),
        Preset(
            id="watts_hump",
            label="Watts hump, class C road",
            description="A circular hump of 75 mm × 3.7 m on a worse road, seen 60 m ahead.",
            scenario=Scenario(
                road=Road(roughness=256e-6, bump=Bump(shape="circular", height=0.075, width=3.7)),
                speed=Speed(detection_distance=60),
            ),
        ),
        Preset(
            id="pothole",
            label="Pothole",
            description="A 60 mm deep, 1 m long hollow with steep edges.",
            scenario=Scenario(road=Road(bump=Bump(shape="trapezoid", height=-0.06, width=1))),
        ),
        Preset(
            id="three_humps",
            label="Three Watts humps",
            description="Three circular humps of 75 mm × 3.7 m, 20 m apart, in a street.",
            scenario=Scenario(
                road=Road(bump=Bump(shape="circular", height=0.075, width=3.7, start=80, count=3, spacing=20))
            ),
        ),
        Preset(
            id="washboard",
            label="Washboard",
            description="30 m of corrugation, 30 mm from trough to crest every 0.6 m, on a class C road.",
            scenario=Scenario(
                road=Road(roughness=256e-6, bump=Bump(height=0.03, width=0.6, start=80, count=50, spacing=0.6))
            ),
        ),
        Preset(
            id="kerb",
            label="Kerb",
            description="Up a kerb of 100 mm at walking pace, as a wheel of 0.3 m radius climbs it: within 0.22 m.",
            scenario=Scenario(
                road=Road(bump=Bump(shape="kerb", height=0.1, width=0.22)),
                speed=Speed(initial_speed_kmh=30, target_speed_kmh=8),
            ),
        ),
    )
}


def preset(name: str) -> Scenario:
    """The scenario of that name.

    Raises:
        UnknownNameError: There is none; the message lists the names.
    """
    try:
        return PRESETS[name].scenario
    except KeyError:
        raise UnknownNameError(f"Unknown preset; there are {', '.join(PRESETS)}") from None
