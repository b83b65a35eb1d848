"""Strategy id -> what it does and which parts of the scenario it reads. Adding a strategy is adding a row here."""

from dataclasses import dataclass, replace
from enum import StrEnum
from typing import Any

from sim_core.errors import UnknownNameError
from sim_core.scenario import Scenario


class SpeedPolicy(StrEnum):
    """How the car is driven along the road."""

    CONSTANT = "constant"
    PLANNED = "planned"


class SuspensionPolicy(StrEnum):
    """What commands the actuators."""

    PASSIVE = "passive"
    LQR = "lqr"
    MPC_BY_ROAD = "mpc_by_road"
    MPC_BY_STAGE = "mpc_by_stage"
    ECU = "ecu"
    SKYHOOK = "skyhook"
    GROUNDHOOK = "groundhook"
    HYBRID = "hybrid"

    @property
    def predictive(self) -> bool:
        """Whether it is a model predictive control, in the simulation or as an ECU's program."""
        return self in (SuspensionPolicy.MPC_BY_ROAD, SuspensionPolicy.MPC_BY_STAGE, SuspensionPolicy.ECU)


@dataclass(frozen=True, slots=True, kw_only=True)
class Strategy:
    """One row of the table; `reads` are dotted names of scenario parts or fields, a result depends on nothing else.

    Both `speed` and `reads` are those under its own speed; `driven` has them under the scenario's `speed.policy`.
    """

    id: str
    label: str
    description: str
    speed: SpeedPolicy
    suspension: SuspensionPolicy
    reads: tuple[str, ...]


_POLICY = "speed.policy"
_ROAD = (
    "vehicle",
    "road",
    "speed.initial_speed_kmh",
    _POLICY,
    "mpc.deflection_limit",
    "mismatch.body_mass",
    "mismatch.springs",
    "mismatch.damping",
    "mismatch.tyres",
    "mismatch.rebound_ratio",
)
_PREVIEW = (
    "mismatch.preview_offset",
    "mismatch.preview_gain",
    "mismatch.preview_noise",
    "mismatch.preview_resolution",
    "mismatch.preview_delay",
    "mpc.expected_offset",
    "mpc.expected_noise",
)
_SPEED = ("speed.target_speed_kmh", "speed.detection_distance", "speed.controller", "fuzzy", "brake")
_MPC = (
    *_PREVIEW,
    "actuator",
    "estimation",
    "mpc.sample_time",
    "mpc.prediction_horizon",
    "mpc.control_horizon",
    "mpc.preview",
    "mpc.force_limit",
    "mpc.deflection_weight",
    "mpc.force_weight",
    "mpc.force_change_weight",
    "mpc.solver",
)
_LQR = (*_PREVIEW, "actuator", "estimation", "lqr", "mpc.sample_time", "mpc.force_limit", "mpc.force_weight")

_FILTER = tuple(f"estimation.{name}" for name in ("kind", "acceleration_noise", "deflection_noise", "pitch_rate_noise"))
_HOOK = (
    "actuator",
    *_FILTER,  # without preview
    "mpc.sample_time",
    "mpc.force_limit",
    "hook.semi_active",
    "hook.min_damping",
    "hook.max_damping",
)

STRATEGIES: dict[str, Strategy] = {
    strategy.id: strategy
    for strategy in (
        Strategy(
            id="lv",
            label="LV control",
            description="Fuzzy speed control and MPC suspension, weights switched by driving stage (Table 6).",
            speed=SpeedPolicy.PLANNED,
            suspension=SuspensionPolicy.MPC_BY_STAGE,
            reads=(*_ROAD, *_SPEED, *_MPC, "mpc.stage_weights"),
        ),
        Strategy(
            id="lv_hil",
            label="LV as ECU code",
            description="LV's suspension control as C code of its own, behind converters, a step of delay and losses.",
            speed=SpeedPolicy.PLANNED,
            suspension=SuspensionPolicy.ECU,
            reads=(*_ROAD, *_SPEED, *(name for name in _MPC if name != "mpc.solver"), "mpc.stage_weights", "hil"),
        ),
        Strategy(
            id="lqr",
            label="LQR",
            description="Linear quadratic regulator with fixed weights on the same speed plan as LV.",
            speed=SpeedPolicy.PLANNED,
            suspension=SuspensionPolicy.LQR,
            reads=(*_ROAD, *_SPEED, *_LQR),
        ),
        Strategy(
            id="skyhook",
            label="Skyhook",
            description="Damps the body against the sky, on the same speed plan as LV.",
            speed=SpeedPolicy.PLANNED,
            suspension=SuspensionPolicy.SKYHOOK,
            reads=(*_ROAD, *_SPEED, *_HOOK, "hook.skyhook_damping"),
        ),
        Strategy(
            id="groundhook",
            label="Groundhook",
            description="Damps the wheels against the ground, on the same speed plan as LV.",
            speed=SpeedPolicy.PLANNED,
            suspension=SuspensionPolicy.GROUNDHOOK,
            reads=(*_ROAD, *_SPEED, *_HOOK, "hook.groundhook_damping"),
        ),
        Strategy(
            id="hybrid",
            label="Hybrid hook",
            description="A share of skyhook and the rest of groundhook, on the same speed plan as LV.",
            speed=SpeedPolicy.PLANNED,
            suspension=SuspensionPolicy.HYBRID,
            reads=(*_ROAD, *_SPEED, *_HOOK, "hook.skyhook_damping", "hook.groundhook_damping", "hook.alpha"),
        ),
        Strategy(
            id="suspension_only",
            label="Single suspension control",
            description="MPC suspension at constant speed, weights switched by road (Table 3).",
            speed=SpeedPolicy.CONSTANT,
            suspension=SuspensionPolicy.MPC_BY_ROAD,
            reads=(*_ROAD, *_MPC, "mpc.road_weights"),
        ),
        Strategy(
            id="speed_only",
            label="Single speed control",
            description="Fuzzy speed control, passive suspension.",
            speed=SpeedPolicy.PLANNED,
            suspension=SuspensionPolicy.PASSIVE,
            reads=(*_ROAD, *_SPEED),
        ),
        Strategy(
            id="passive",
            label="Passive",
            description="No control: passive suspension at constant speed.",
            speed=SpeedPolicy.CONSTANT,
            suspension=SuspensionPolicy.PASSIVE,
            reads=_ROAD,
        ),
    )
}


def strategy_named(name: str) -> Strategy:
    """The strategy with that id.

    Raises:
        UnknownNameError: There is none; the message lists the ids.
    """
    try:
        return STRATEGIES[name]
    except KeyError:
        raise UnknownNameError(f"Unknown strategy; there are {', '.join(STRATEGIES)}") from None


def driven(strategy: Strategy, policy: str) -> Strategy:
    """The strategy at the speed that `speed.policy` asks for, with what it reads there."""
    if policy in ("by_strategy", strategy.speed):
        return strategy
    suspension = tuple(name for name in strategy.reads if name not in _SPEED)
    speed = SpeedPolicy(policy)
    return replace(strategy, speed=speed, reads=suspension + (_SPEED if speed is SpeedPolicy.PLANNED else ()))


def part_read(scenario: Scenario, name: str) -> dict[str, Any]:
    """The part of the scenario that strategy reads (`Part.identity`): dotted name -> plain JSON value, by name.

    The speed policy is told by what is read under it: at the speed that is its own anyway it has the key it always had.
    """
    identity = scenario.identity()
    values: dict[str, Any] = {}
    for path in sorted(set(driven(strategy_named(name), scenario.speed.policy).reads) - {_POLICY}):
        *parts, last = path.split(".")
        part = identity
        for key in parts:
            part = part.get(key, {})
        if last in part:
            values[path] = part[last]
    return values
