"""The scenario: the one source of fields, units, defaults, hard limits, soft ranges and help.

Its JSON Schema makes the browser's form, the command line's options and the API's documentation.
SI units, except speeds a person types, which end in `_kmh`. Defaults are the paper's (Table 2, 3, 6
and section 3) unless the description says "ours"; docs/physics.md gives each one's source.
"""

from typing import ClassVar, Literal, Self

from pydantic import ConfigDict, Field, model_validator
from pydantic.config import JsonDict

from sim_core.errors import RidelabError
from sim_core.scenario.fields import Part, Weights, at, count, quantity, weights
from sim_core.scenario.fuzzy import Fuzzy
from sim_core.scenario.imperfections import Actuator, Estimation, Hil, Mismatch
from sim_core.scenario.measured import MeasuredRoad
from sim_core.scenario.road import Road
from sim_core.scenario.vehicle import Vehicle

SCHEMA_VERSION = 2


class Speed(Part):
    """Speeds and when braking begins (section 3.1)."""

    ADDED: ClassVar = frozenset({"policy"})

    initial_speed_kmh: float = quantity(
        50, "km/h", "Initial speed", "Held until the bump is detected.", soft=(20, 90), ge=5, le=200
    )
    target_speed_kmh: float = quantity(
        22.5, "km/h", "Target speed", "Aimed at for the bump; the paper's 20 to 25 km/h.", soft=(10, 50), ge=5, le=200
    )
    detection_distance: float = quantity(
        80,
        "m",
        "Detection distance",
        "How far ahead the bump is seen and braking begins.",
        soft=(20, 100),
        ge=1,
        le=1000,
    )
    controller: Literal["guarded", "fuzzy"] = Field(
        "guarded",
        title="Speed controller",
        description="fuzzy is Table 1 alone; guarded (ours) brakes at least as hard as the distance left needs, which "
        "changes nothing on the paper's scenario.",
    )
    policy: Literal["by_strategy", "planned", "constant"] = Field(
        "by_strategy",
        title="Who slows down",
        description="by_strategy: those that have a speed control, as in the paper. At equal speed what is left of a "
        "gain is the suspension's: planned slows all of them down for the bump, constant none.",
    )


class Brake(Part):
    """Brake chain and driving resistances (Eq. 4-6); the paper gives no values: typical ones, ours."""

    friction_coefficient: float = quantity(
        0.38, "1", "Pad friction", "Coefficient µ; brake factor k = 2 µ.", soft=(0.2, 0.6), ge=0.05, le=1
    )
    effective_radius: float = quantity(
        0.13, "m", "Effective disc radius", "Friction radius r_b.", soft=(0.08, 0.2), ge=0.02, le=1
    )
    piston_area: float = quantity(
        0.0025, "m^2", "Piston area", "Contact area A of one brake.", soft=(0.001, 0.006), ge=1e-4, le=0.1
    )
    brakes: int = count(
        2, "Brakes", "How many share the torque; one per axle of the half-car.", soft=(1, 4), ge=1, le=8
    )
    threshold_speed: float = quantity(
        0.1, "m/s", "Threshold speed", "Sliding speed v_d of the smoothed friction.", soft=(0.01, 0.5), ge=0.001, le=5
    )
    pressure_lag: float = quantity(
        0.1, "s", "Pressure lag", "Time constant of the line pressure.", soft=(0, 0.4), ge=0, le=2
    )
    wheel_radius: float = quantity(0.3, "m", "Wheel radius", "Rolling radius.", soft=(0.25, 0.4), ge=0.1, le=2)
    maximum_deceleration: float = quantity(
        4,
        "m/s^2",
        "Greatest deceleration",
        "Top of the fuzzy controller's torque universe.",
        soft=(1, 8),
        ge=0.2,
        le=10,
    )
    rolling_resistance: float = quantity(
        0.012, "1", "Rolling resistance", "Coefficient f_r.", soft=(0, 0.03), ge=0, le=0.2
    )
    drag_area: float = quantity(
        0.65, "m^2", "Drag area", "Air drag coefficient times frontal area, c_d A.", soft=(0, 1.5), ge=0, le=20
    )


class StageWeights(Part):
    """LV control's weights per driving stage (Table 6)."""

    cruise: Weights = weights((8, 1, 1), "Cruise", "Uniform speed: comfort first.")
    brake: Weights = weights((2, 6, 1), "Brake", "Braking: pitch first.")
    bump: Weights = weights((1, 1, 6), "Bump", "On the bump: tyre load first.")


class RoadWeights(Part):
    """Single suspension control's weights per road (Table 3)."""

    rough: Weights = weights((8, 1, 1), "Rough road", "Class B pavement.")
    bump: Weights = weights((3, 1, 6), "Bump", "Bumpy pavement.")


Preview = Literal["none", "wheelbase", "lookahead", "obstacle"]


class Mpc(Part):
    """Model predictive suspension control (Eq. 8-15, section 3.2.2)."""

    ADDED: ClassVar = frozenset({"expected_offset", "expected_noise"})

    sample_time: float = quantity(
        0.01, "s", "Sample time", "Control interval Ts (ours).", soft=(0.005, 0.02), ge=0.002, le=0.05
    )
    prediction_horizon: int = count(30, "Prediction horizon", "Np, in steps.", soft=(5, 60), ge=1, le=200)
    control_horizon: int = count(20, "Control horizon", "Nc, moves; at most Np.", soft=(1, 40), ge=1, le=100)
    preview: Preview = Field(
        "lookahead",
        title="Preview",
        description="What is known of the road ahead: nothing, what the front axle has passed (wheelbase), what the "
        "sensors see (lookahead), or the bump alone (obstacle).",
    )
    expected_offset: float = quantity(
        0,
        "m",
        "Expected preview offset",
        "Standard deviation of the offset that the controllers, LQR too, expect of the sensors: the more, the less "
        "of the roughness seen they trust (lookahead).",
        soft=(0, 0.5),
        ge=0,
        le=10,
    )
    expected_noise: float = quantity(
        0,
        "m",
        "Expected preview noise",
        "Standard deviation of the noise that the controllers, LQR too, expect of each height (lookahead).",
        soft=(0, 0.005),
        ge=0,
        le=0.1,
        shown="mm",
    )
    deflection_limit: float = quantity(
        0.08,
        "m",
        "Travel limit",
        "Suspension deflection limit, soft (ours).",
        soft=(0.03, 0.15),
        ge=0.005,
        le=1,
        shown="mm",
    )
    force_limit: float = quantity(
        5000, "N", "Force limit", "Actuator limit, hard (ours); LQR has it too.", soft=(500, 10_000), ge=1, le=1_000_000
    )
    deflection_weight: float = quantity(
        3, "1", "Travel weight", "q4 (ours); 0 as in Eq. 16, which has none.", soft=(0, 10), ge=0, le=1000
    )
    force_weight: float = quantity(
        1e-9,
        "1/N^2",
        "Force weight",
        "R, keeps the cost strictly convex (ours).",
        soft=(1e-10, 1e-7),
        ge=1e-12,
        le=1e-3,
    )
    force_change_weight: float = quantity(
        1e-10, "1/N^2", "Force change weight", "On the moves of the force (ours).", soft=(0, 1e-8), ge=0, le=1e-3
    )
    solver: Literal["daqp", "osqp"] = Field(
        "daqp", title="QP solver", description="Used where a limit binds; the other is the fallback."
    )
    stage_weights: StageWeights = Field(StageWeights(), title="LV weights per driving stage")
    road_weights: RoadWeights = Field(RoadWeights(), title="Single suspension control's weights per road")


class Lqr(Part):
    """Linear quadratic regulator (section 4.2.2: equal weights)."""

    weights: Weights = weights((1, 1, 1), "Weights", "Equal, as in the paper.")
    deflection_weight: float = quantity(
        3, "1", "Travel weight", "q4 (ours); 0 as in Eq. 16, which has none.", soft=(0, 10), ge=0, le=1000
    )
    preview: Preview = Field(
        "none",
        title="Preview",
        description="As the MPC's, by a feedforward that is optimal without limits; none is the paper's LQR.",
    )
    preview_horizon: int = count(
        30, "Preview horizon", "In steps; nothing is known beyond.", soft=(5, 60), ge=1, le=200
    )


class Hook(Part):
    """Skyhook, groundhook and hybrid: dampers against sky and ground, beside the car's own (docs/physics.md)."""

    ADDED: ClassVar = frozenset(
        {"skyhook_damping", "groundhook_damping", "alpha", "semi_active", "min_damping", "max_damping"}
    )

    skyhook_damping: float = quantity(
        4000, "N·s/m", "Skyhook damping", "Of the body over each axle (ours).", soft=(0, 10_000), ge=0, le=500_000
    )
    groundhook_damping: float = quantity(
        2000, "N·s/m", "Groundhook damping", "Of each wheel (ours).", soft=(0, 10_000), ge=0, le=500_000
    )
    alpha: float = quantity(
        0.5, "1", "Share of skyhook", "Of hybrid; the rest is groundhook (ours).", soft=(0, 1), ge=0, le=1
    )
    semi_active: bool = Field(
        False,
        title="Semi-active",
        description="Damper and control are one controlled damper, which only takes energy out: where the law asks for "
        "a force that it cannot give, it gives the nearest that it can.",
    )
    min_damping: float = quantity(
        0,
        "N·s/m",
        "Least damping",
        "Softest setting of a semi-active damper as a whole, the passive one included.",
        soft=(0, 2000),
        ge=0,
        le=500_000,
    )
    max_damping: float | None = quantity(
        None,
        "N·s/m",
        "Greatest damping",
        "Hardest setting of a semi-active damper as a whole, the passive one included; none is no limit.",
        soft=(5000, 20_000),
        ge=10,
        le=500_000,
    )


_BUMP_BEYOND = "The bump must end before the road does: position and width together at most the road's length"


def _without_example(schema: JsonDict) -> None:
    schema["description"] = str(schema["description"]).partition("\n")[0]


class Scenario(Part):
    """Everything a run depends on; an omitted part or field takes the paper's default.

    Example:
        >>> from sim_core import Scenario
        >>> scenario = Scenario.model_validate({"road": {"roughness": "C", "bump": {"height": 0.12}}})
        >>> scenario.road.roughness, scenario.road.bump.height, scenario.road.bump.width
        (0.000256, 0.12, 4.0)
    """

    model_config = ConfigDict(json_schema_extra=_without_example)
    ADDED: ClassVar = frozenset({"hook", "estimation", "fuzzy"})

    vehicle: Vehicle = Field(Vehicle(), title="Vehicle")
    road: Road = Field(Road(), title="Road")
    speed: Speed = Field(Speed(), title="Speed")
    fuzzy: Fuzzy = Field(Fuzzy(), title="Fuzzy speed control")
    brake: Brake = Field(Brake(), title="Brake")
    actuator: Actuator = Field(Actuator(), title="Actuator")
    mismatch: Mismatch = Field(Mismatch(), title="Model mismatch")
    estimation: Estimation = Field(Estimation(), title="State estimation")
    mpc: Mpc = Field(Mpc(), title="MPC")
    lqr: Lqr = Field(Lqr(), title="LQR")
    hook: Hook = Field(Hook(), title="Skyhook and groundhook")
    hil: Hil = Field(Hil(), title="Hardware in the loop")

    def on(self, measured: MeasuredRoad) -> "Scenario":
        """The scenario with the heights of its `road.profile`: no name of a road holds any, and the core reads none.

        Where it was given no `road.length`, it has the profile's from here on.

        Raises:
            RidelabError: The bump is not on a road of that length.
        """
        road = self.road.model_copy(update={"length": measured.length} if self.road.ends_with_profile else None)
        road._measured = measured
        if road.bump.end > road.length:
            lengths = f"the bump ends at {road.bump.end:g} m, the measured road at {road.length:g} m"
            raise RidelabError(f"{_BUMP_BEYOND}; {lengths}", field="road.bump.start")
        return self.model_copy(update={"road": road})

    @property
    def real_vehicle(self) -> Vehicle:
        """The car that is driven; `vehicle` is the one the controllers believe in."""
        return self.mismatch.real(self.vehicle)

    @model_validator(mode="after")
    def _consistent(self) -> Self:
        if self.mpc.control_horizon > self.mpc.prediction_horizon:
            raise at("mpc.control_horizon", "Control horizon must not exceed the prediction horizon")
        bump = self.road.bump
        if bump.end > self.road.length and not self.road.ends_with_profile:
            raise at(
                "road.bump.start",
                _BUMP_BEYOND + (", with the spacing of all in between" if bump.count > 1 else ""),
            )
        if bump.count > 1 and bump.spacing < bump.width:
            raise at("road.bump.spacing", "Bumps must not overlap: the spacing is at least their width")
        if bump.shape == "circular" and abs(bump.height) > bump.width / 2:
            raise at("road.bump.height", "A circular bump's height must not exceed half its width")
        if self.hook.max_damping is not None and self.hook.max_damping < self.hook.min_damping:
            raise at("hook.max_damping", "The greatest damping must not be below the least")
        return self
