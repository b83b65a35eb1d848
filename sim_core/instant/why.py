"""One sentence that says why a controller commanded its forces."""

import numpy as np

from sim_core.arrays import FloatArray
from sim_core.control.plan import Limit

_AXLES = "front", "rear"
_NOTICED = 0.5  # a smaller difference rounds to none [N]
_LIMITS = {
    "force": "force limit",
    "deflection": "travel limit",
    "force_change": "force rate limit",
    "actuator_force": "actuator's saturation",
}
_PARTS = {
    "suspension_deflections": "the suspension travel",
    "tyre_deflections": "the tyre deflections",
    "body_motion": "the body's motion",
    "wheel_motion": "the wheels' motion",
    "previous_force": "the force before",
    "road_ahead": "the road ahead",
    "braking": "the braking",
}


def why(
    *,
    actuated: bool,
    asked: FloatArray | None,
    command: FloatArray,
    acting: FloatArray | None,
    limits: tuple[Limit, ...],
    parts: dict[str, FloatArray] | None,
    state: FloatArray,
) -> str:
    """Return the sentence.

    Args:
        actuated: Whether there are actuators.
        asked: Forces that the controller asks for (2,) [N]; None where no command came.
        command: What the actuators are told (2,) [N].
        acting: Of semi-active dampers, what they give (2,) [N]; None of actuators.
        limits: With the forces without each.
        parts: Of a linear law, what each part of its inputs adds (2,) [N]; None of another.
        state: What the controller has for the car's state (8,), as `Seen.state` orders it.
    """
    if not actuated:
        return "There are no actuators, so there is no force."
    forces = f"front {_newtons(command[0])} and rear {_newtons(command[1])}"
    if asked is None:
        return f"No command came from the controller, so the actuators hold {forces}."
    if acting is not None and np.abs(acting - command).max() > _NOTICED:
        axle = int(np.abs(acting - command).argmax())
        return (
            f"A damper takes energy out within its range and can do no more, so the {_AXLES[axle]} one gives "
            f"{_newtons(acting[axle])} of the {_newtons(command[axle])} that the law asks for."
        )
    if held := _holding(limits, command):
        limit, axle = held
        where, _, kind = limit.name.partition("_")
        assert limit.force_without is not None  # noqa: S101 - `_holding` looks at it
        return (
            f"The {where} {_LIMITS[kind]} shapes it: without that limit the {_AXLES[axle]} force would be "
            f"{_newtons(limit.force_without[axle])} and not {_newtons(command[axle])}."
        )
    if parts is None:
        front, rear = 1000 * state[:2]
        return (
            f"No limit holds it back: for deflections of front {front:+z.1f} mm and rear {rear:+z.1f} mm, "
            f"{state[4]:+z.3f} m/s of the body and a pitch rate of {state[5]:+z.3f} rad/s "
            f"the controller asks for {forces}."
        )
    if np.abs(command).max() <= _NOTICED:
        return f"No limit holds it back: {forces} are what the controller asks for."
    axle = int(np.abs(command).argmax())
    largest = sorted(parts, key=lambda name: -abs(float(parts[name][axle])))[:2]
    terms = {_PARTS[name]: float(parts[name][axle]) for name in largest}
    terms["everything else"] = float(command[axle]) - sum(terms.values())
    *others, last = [f"{name} ({_newtons(force)})" for name, force in terms.items() if abs(force) > _NOTICED]
    answered = f"{', '.join(others)} and {last}" if others else last
    return f"No limit holds it back: the {_newtons(command[axle])} at the {_AXLES[axle]} answer {answered}."


def _holding(limits: tuple[Limit, ...], command: FloatArray) -> tuple[Limit, int] | None:
    """Return the limit without which the command would change most, and the axle where; None where none changes it."""
    freed = [(limit, np.abs(limit.force_without - command)) for limit in limits if limit.force_without is not None]
    limit, change = max(freed, key=lambda each: float(each[1].max()), default=(None, np.zeros(1)))
    return None if limit is None or change.max() <= _NOTICED else (limit, int(change.argmax()))


def _newtons(force: float) -> str:
    return f"{force:+z.0f} N"
