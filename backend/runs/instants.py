"""`GET /runs/{id}/instant`: what a controller saw and decided at one control step of a stored run."""

from dataclasses import fields

import numpy as np
from pydantic import AliasChoices, Field

from backend.cost.estimate import check_affordable
from backend.custom_controllers.registry import run_in_sandbox_process
from backend.models import Answer, Matrix, Vector
from sim_core.instant import Instant, instant
from sim_core.scenario import Scenario


class RoadAhead(Answer):
    """The road ahead as the sensors gave it, beside the real one, at the end of each coming control step."""

    mode: str = Field(description="What is previewed: wheelbase, lookahead or obstacle")
    time: Vector = Field(description="[s]")
    position: Vector = Field(description="Of the front axle then [m]")
    seen: Matrix = Field(description="Heights under front and rear axle, as the sensors gave them [m]")
    real: Matrix = Field(description="Those of the road there [m]")


class InstantForces(Answer):
    """Forces front and rear [N], up on the body."""

    asked: Vector | None = Field(description="By the controller; null where no command came")
    command: Vector = Field(description="What the actuators are told in this step, within all limits")
    previous: Vector = Field(description="What they were told before")
    acting: Vector = Field(description="What acts on the car just after the change")


class ControllerLimit(Answer):
    """A limit on the magnitude of one quantity."""

    name: str = Field(description="The quantity, such as front_force, rear_force_change or front_deflection")
    unit: str
    limit: float = Field(validation_alias=AliasChoices("bound", "limit"), description="Its largest magnitude [unit]")
    distance: float = Field(description="From the value nearest to the limit; negative beyond it [unit]")
    multiplier: float | None = Field(
        description="By how much the cost falls where the limit is raised [1/unit]; null where nothing is minimised"
    )
    values: Vector = Field(description="What it limits: now, or in every interval of the horizon [unit]")
    multipliers: Vector | None = Field(description="Of each value; negative at the lower limit [1/unit]")
    force_without: Vector | None = Field(description="Forces that would be commanded without this limit [N]")


class InstantAnswer(Answer):
    """One control step; what the controller has not is null."""

    strategy: str
    step: int = Field(description="Its number; the first ones are before x = 0")
    time: float = Field(description="[s]")
    position: float = Field(description="Of the front axle [m]")
    speed: float = Field(description="[m/s]")
    stage: str = Field(description="cruise, brake or bump")
    state: Vector = Field(
        description="Of the car: suspension and tyre deflections [m], body velocity [m/s], pitch rate [rad/s], wheel "
        "velocities [m/s]; front before rear"
    )
    estimated_state: Vector | None = Field(description="What the controller has in its place")
    measurement: Vector = Field(
        description="By its sensors: suspension deflections [m], body acceleration [m/s^2], pitch rate [rad/s]"
    )
    preview: RoadAhead | None
    forces: InstantForces
    parts: dict[str, Vector] | None = Field(description="Of a linear law, what each part of its inputs adds [N]")
    limits: list[ControllerLimit]
    predicted_time: Vector | None = Field(description="Now and at the end of each step of the horizon [s]")
    predicted_states: Matrix | None = Field(description="Then, in the order of state")
    predicted_forces: Matrix | None = Field(description="In each of its steps [N]")
    cost: dict[str, float] | None = Field(description="What is minimised, by its terms [1]")
    why: str = Field(description="One sentence that says why these forces")


def instant_answer(scenario: Scenario, strategy: str, position: float | None, time: float | None) -> InstantAnswer:
    """The answer, computed in a worker, which keeps the drive for the next one."""
    check_affordable(scenario, strategy)
    return run_in_sandbox_process(strategy, _instant_answer, scenario, strategy, position, time)


def _instant_answer(scenario: Scenario, strategy: str, position: float | None, time: float | None) -> InstantAnswer:
    return as_answer(strategy, instant(scenario, strategy, position=position, time=time))


def as_answer(strategy: str, seen: Instant) -> InstantAnswer:
    """Return an instant as it is sent."""
    plan = seen.plan
    return InstantAnswer.model_validate(
        {
            **{each.name: getattr(seen, each.name) for each in fields(seen)},
            "strategy": strategy,
            "forces": seen,
            "predicted_time": plan and seen.time + (plan.begins + np.arange(len(plan.states))) * seen.sample_time,
            "predicted_states": plan and plan.states,
            "predicted_forces": plan and plan.forces,
            "cost": plan and plan.cost,
        }
    )
