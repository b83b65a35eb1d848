"""The scenario: the one source of fields, units, defaults, hard limits, soft ranges and help.

Its JSON Schema makes the browser's form, the command line's options and the API's documentation.
SI units, except speeds a person types, which end in `_kmh`. Defaults are the paper's (Table 2, 3, 6
and section 3) unless the description says "ours"; docs/explanation/model.md gives each one's source.
"""

from collections.abc import Iterable
from typing import Annotated, Literal, Self

from pydantic import PrivateAttr, model_validator

from sim_core.errors import RefusedError
from sim_core.scenario.fields import ADDED, Part, Weights, at, quantity
from sim_core.scenario.fuzzy import Fuzzy
from sim_core.scenario.imperfections import Actuator, Estimation, HeightNoise, Hil, Mismatch
from sim_core.scenario.measured import MeasuredRoad
from sim_core.scenario.own import Own
from sim_core.scenario.recorded import RecordedDrive
from sim_core.scenario.road import Road
from sim_core.scenario.vehicle import Vehicle

SCHEMA_VERSION = 2
KMH = 1 / 3.6  # one km/h [m/s]


Horizon = Annotated[int, quantity("1", soft=(5, 60), ge=1, le=200)]
TravelWeight = Annotated[float, quantity("1", soft=(0, 10), ge=0, le=1000)]
HookDamping = Annotated[float, quantity("N·s/m", soft=(0, 10_000), ge=0, le=500_000)]


class Speed(Part):
    """Speeds and when braking begins (section 3.1)."""

    initial_speed_kmh: Annotated[float, quantity("km/h", soft=(20, 90), ge=5, le=200)] = 50
    target_speed_kmh: Annotated[float, quantity("km/h", soft=(10, 50), ge=5, le=200)] = 22.5
    detection_distance: Annotated[float, quantity("m", soft=(20, 100), ge=1, le=1000)] = 80
    controller: Literal["guarded", "fuzzy"] = "guarded"
    policy: Annotated[Literal["by_strategy", "planned", "constant"], ADDED] = "by_strategy"

    @property
    def initial(self) -> float:
        """Return the initial speed [m/s]."""
        return self.initial_speed_kmh * KMH

    @property
    def target(self) -> float:
        """Return the target speed [m/s]."""
        return self.target_speed_kmh * KMH


class Brake(Part):
    """Brake chain and driving resistances (Eq. 4-6); the paper gives no values: typical ones, ours."""

    friction_coefficient: Annotated[float, quantity("1", soft=(0.2, 0.6), ge=0.05, le=1)] = 0.38
    effective_radius: Annotated[float, quantity("m", soft=(0.08, 0.2), ge=0.02, le=1)] = 0.13
    piston_area: Annotated[float, quantity("m^2", soft=(0.001, 0.006), ge=1e-4, le=0.1)] = 0.0025
    brakes: Annotated[int, quantity("1", soft=(1, 4), ge=1, le=8)] = 2
    threshold_speed: Annotated[float, quantity("m/s", soft=(0.01, 0.5), ge=0.001, le=5)] = 0.1
    pressure_lag: Annotated[float, quantity("s", soft=(0, 0.4), ge=0, le=2)] = 0.1
    wheel_radius: Annotated[float, quantity("m", soft=(0.25, 0.4), ge=0.1, le=2)] = 0.3
    maximum_deceleration: Annotated[float, quantity("m/s^2", soft=(1, 8), ge=0.2, le=10)] = 4
    rolling_resistance: Annotated[float, quantity("1", soft=(0, 0.03), ge=0, le=0.2)] = 0.012
    drag_area: Annotated[float, quantity("m^2", soft=(0, 1.5), ge=0, le=20)] = 0.65


class StageWeights(Part):
    """LV control's weights per driving stage (Table 6)."""

    cruise: Weights = (8, 1, 1)
    brake: Weights = (2, 6, 1)
    bump: Weights = (1, 1, 6)

    def of(self, stage: str) -> Weights:
        """Return those of a driving stage."""
        weights: Weights = getattr(self, stage)
        return weights


class RoadWeights(Part):
    """Single suspension control's weights per road (Table 3)."""

    rough: Weights = (8, 1, 1)
    bump: Weights = (3, 1, 6)


Preview = Literal["none", "wheelbase", "lookahead", "obstacle"]


class Mpc(Part):
    """Model predictive suspension control (Eq. 8-15, section 3.2.2)."""

    sample_time: Annotated[float, quantity("s", soft=(0.005, 0.02), ge=0.002, le=0.05)] = 0.01
    prediction_horizon: Horizon = 30
    control_horizon: Annotated[int, quantity("1", soft=(1, 40), ge=1, le=100)] = 20
    preview: Preview = "lookahead"
    expected_offset: Annotated[float, quantity("m", soft=(0, 0.5), ge=0, le=10), ADDED] = 0
    expected_noise: Annotated[HeightNoise, ADDED] = 0
    deflection_limit: Annotated[float, quantity("m", soft=(0.03, 0.15), ge=0.005, le=1, shown="mm")] = 0.08
    force_limit: Annotated[float, quantity("N", soft=(500, 10_000), ge=1, le=1_000_000)] = 5000
    deflection_weight: TravelWeight = 3
    force_weight: Annotated[float, quantity("1/N^2", soft=(1e-10, 1e-7), ge=1e-12, le=1e-3)] = 1e-9
    force_change_weight: Annotated[float, quantity("1/N^2", soft=(0, 1e-8), ge=0, le=1e-3)] = 1e-10
    solver: Literal["daqp", "osqp"] = "daqp"
    stage_weights: StageWeights = StageWeights()
    road_weights: RoadWeights = RoadWeights()


class Lqr(Part):
    """Linear quadratic regulator (section 4.2.2: equal weights)."""

    weights: Weights = (1, 1, 1)
    deflection_weight: TravelWeight = 3
    preview: Preview = "none"
    preview_horizon: Horizon = 30


class Hook(Part):
    """Skyhook, groundhook and hybrid: dampers against sky and ground, beside the car's own."""

    skyhook_damping: Annotated[HookDamping, ADDED] = 4000
    groundhook_damping: Annotated[HookDamping, ADDED] = 2000
    alpha: Annotated[float, quantity("1", soft=(0, 1), ge=0, le=1), ADDED] = 0.5
    semi_active: Annotated[bool, ADDED] = False
    min_damping: Annotated[float, quantity("N·s/m", soft=(0, 2000), ge=0, le=500_000), ADDED] = 0
    max_damping: Annotated[float | None, quantity("N·s/m", soft=(5000, 20_000), ge=10, le=500_000), ADDED] = None


_BUMP_BEYOND = "The bump must end before the road does: position and width together at most the road's length"


class Scenario(Part):
    """Everything a run depends on; an omitted part or field takes the paper's default.

    Example:
        >>> from sim_core import Scenario
        >>> scenario = Scenario.model_validate({"road": {"roughness": "C", "bump": {"height": 0.12}}})
        >>> scenario.road.roughness, scenario.road.bump.height, scenario.road.bump.width
        (0.000256, 0.12, 4.0)
    """

    vehicle: Vehicle = Vehicle()
    road: Road = Road()
    speed: Speed = Speed()
    fuzzy: Annotated[Fuzzy, ADDED] = Fuzzy()
    brake: Brake = Brake()
    actuator: Actuator = Actuator()
    mismatch: Mismatch = Mismatch()
    estimation: Annotated[Estimation, ADDED] = Estimation()
    mpc: Mpc = Mpc()
    lqr: Lqr = Lqr()
    hook: Annotated[Hook, ADDED] = Hook()
    hil: Hil = Hil()
    own: Annotated[Own, ADDED] = Own()

    _recordings: dict[str, RecordedDrive] = PrivateAttr(default_factory=dict)

    def on(self, measured: MeasuredRoad) -> "Scenario":
        """Return the scenario with the heights of the measured road that `road.profile` names, which a drive needs.

        Where it was given no `road.length`, it has the profile's from here on. A bump of height 0 that was given no
        place has none.

        Raises:
            RidelabError: It is another road, or the bump is not on a road of that length.
        """
        if measured.id != self.road.profile:
            names = f"road {self.road.profile}" if self.road.profile else "none"
            message = f"These are the heights of the measured road {measured.id}; the scenario names {names}"
            raise RefusedError(message, field="road.profile")
        road = self.road.model_copy(update={"length": measured.length} if self.road.ends_with_profile else None)
        road._measured = measured
        if not road.bump.height and "start" not in road.bump.model_fields_set:
            road = road.model_copy(update={"bump": road.bump.model_copy(update={"start": road.length})})
        if road.bump.height and not road.has_bump:
            lengths = f"the bump ends at {road.bump.end:g} m, the measured road at {road.length:g} m"
            raise RefusedError(f"{_BUMP_BEYOND}; {lengths}", field="road.bump.start")
        return self.model_copy(update={"road": road})

    def with_recordings(self, recordings: Iterable[RecordedDrive]) -> "Scenario":
        """Return the scenario with what the strategies `recording:ID` of a run stand for."""
        copy = self.model_copy()
        copy._recordings = {each.id: each for each in recordings}
        return copy

    def recording(self, recording: str) -> RecordedDrive:
        """Return the recording of that id.

        Raises:
            KeyError: Nobody handed it over.
        """
        return self._recordings[recording]

    @property
    def real_vehicle(self) -> Vehicle:
        """Return the car that is driven; `vehicle` is the one the controllers believe in."""
        return self.mismatch.real(self.vehicle)

    @property
    def is_random(self) -> bool:
        """Check whether a result varies at random: with the roughness, noise, jitter and losses of this seed."""
        noise = (self.mismatch.preview_noise, self.hil.noise, self.hil.jitter, self.hil.packet_loss)
        return not self.road.is_smooth or self.estimation.kind != "exact" or any(noise)

    @property
    def bump_start(self) -> float:
        """Return where the front axle meets the bump [m]: the road's end where there is none."""
        return self.road.bump.start if self.road.has_bump else self.road.length

    @property
    def braking_start(self) -> float:
        """Return where the front axle is when braking for the bump begins [m]: the road's end without a bump."""
        return max(0.0, self.bump_start - self.speed.detection_distance) if self.road.has_bump else self.road.length

    @property
    def rear_axle_offset(self) -> float:
        """Return how far behind the front axle the rear one meets the road [m]: 0 where both do so together."""
        return 0.0 if self.road.rear_axle == "together" else self.vehicle.wheelbase

    @property
    def bump_left(self) -> float:
        """Return where the front axle is when both axles have left the bump [m]."""
        return (self.road.bump.end if self.road.has_bump else self.road.length) + self.rear_axle_offset

    @model_validator(mode="after")
    def _consistent(self) -> Self:
        if self.mpc.control_horizon > self.mpc.prediction_horizon:
            raise at("mpc.control_horizon", "Control horizon must not exceed the prediction horizon")
        if self.road.bump.height:
            self._check_bump()
        if self.hook.max_damping is not None and self.hook.max_damping < self.hook.min_damping:
            raise at("hook.max_damping", "The greatest damping must not be below the least")
        return self

    def _check_bump(self) -> None:
        bump = self.road.bump
        if not self.road.has_bump and not self.road.ends_with_profile:
            between = ", with the spacing of all in between" if bump.count > 1 else ""
            raise at("road.bump.start", _BUMP_BEYOND + between)
        if bump.count > 1 and bump.spacing < bump.width:
            raise at("road.bump.spacing", "Bumps must not overlap: the spacing is at least their width")
        if bump.shape == "circular" and abs(bump.height) > bump.width / 2:
            raise at("road.bump.height", "A circular bump's height must not exceed half its width")
