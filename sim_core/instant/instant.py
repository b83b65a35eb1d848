"""What a controller saw and decided at one control step."""

from dataclasses import dataclass
from math import inf

import numpy as np

from sim_core.arrays import FloatArray
from sim_core.blas import single_threaded
from sim_core.caching import cached
from sim_core.control.controller import Controller, linear_force
from sim_core.control.law import LinearLaw
from sim_core.control.plan import Limit, Plan
from sim_core.control.seen import RunInputs, Seen
from sim_core.errors import RidelabError
from sim_core.instant.why import why
from sim_core.kernel.prepared import limit_force
from sim_core.loop.closed_loop import Trajectory, read_only
from sim_core.loop.run import Run
from sim_core.scenario import Preview, Scenario
from sim_core.simulate import prepare
from sim_core.strategies import controller_for, strategy_named
from sim_core.vehicle.half_car import DISTURBANCES, FORCES, STATES

_NEAR = 1e-9  # of the drive, for rounding
_ACTING = slice(8, 10)  # forces among the recorded signals
# What a linear law multiplies, and where among [state; previous force; road velocities and deceleration ahead].
_STATE_PARTS = {
    "suspension_deflections": slice(0, 2),
    "tyre_deflections": slice(2, 4),
    "body_motion": slice(4, 6),
    "wheel_motion": slice(6, 8),
    "previous_force": slice(8, 10),
}


@dataclass(frozen=True, slots=True, eq=False, kw_only=True)
class Drive:
    """A run after its drive.

    Attributes:
        run: With its controller, whose `end` was called.
        trajectory: What was driven.
        inputs: What `Seen` reported.
    """

    run: Run
    trajectory: Trajectory
    inputs: RunInputs

    def step_at(self, position: float | None, time: float | None) -> int:
        """Return the control step in which the front axle is at a position [m], or at a time [s].

        Raises:
            RidelabError: It is outside the road, or not one of both is given.
        """
        grid, stages = self.run.excitation.grid, self.run.stages
        if (position is None) == (time is None):
            raise RidelabError("An instant is at a position or at a time")
        asked, starts = (position, grid.position) if time is None else (time, grid.time[:-1])
        end = stages[-1].end_position if time is None else stages[-1].end_time
        assert asked is not None  # noqa: S101 - one of both is given
        if not 0 <= asked <= end:
            unit = "m" if time is None else "s"
            raise RidelabError(f"The drive goes from 0 to {end:.4g} {unit}")
        return max(int(starts.searchsorted(asked + _NEAR * end, side="right")) - 1, 0)

    def seen(self, step: int, *, answered: bool = False) -> Seen:
        """What the controller saw in that step; `answered`: its previous force is its last answer, arrived or not."""
        row, car, trajectory = step * self.run.steps.short, self.trajectory.car, self.trajectory
        now = read_only(trajectory.loop[row])
        previous = now[car.size :]
        if answered:
            answers = trajectory.requested[:step]
            answers = answers[~np.isnan(answers).any(axis=1)]
            previous = read_only(answers[-1]) if len(answers) else np.zeros(FORCES)
        return Seen(self.inputs, car, step, row, now[: car.size], previous)


def _driven(scenario: Scenario, strategy: type[Controller] | Controller) -> Drive:
    """Drive a run."""
    run = prepare(scenario, strategy)
    trajectory, forecast = run.drive(), run.forecast(run.preview, run.preview_steps)
    return Drive(run=run, trajectory=trajectory, inputs=run.inputs(forecast))


# For classes that a strategy's id stands for: those that are handed over may change, and their objects too.
_cached_drive = cached(_driven)


@dataclass(frozen=True, slots=True, eq=False, kw_only=True)
class PreviewedRoad:
    """The road ahead as the controller's sensors gave it, beside the real one.

    Attributes:
        mode: What is previewed (`mpc.preview` in docs/reference/scenario.md).
        time: At the end of each coming control step (n,) [s].
        position: Of the front axle then (n,) [m].
        seen: Heights under the front and the rear axle, as `Seen.preview` (n, 2) [m].
        real: Those of the road there (n, 2) [m].
    """

    mode: Preview
    time: FloatArray
    position: FloatArray
    seen: FloatArray
    real: FloatArray


@dataclass(frozen=True, slots=True, eq=False, kw_only=True)
class Instant:
    """One control step of a run.

    Attributes:
        step: Its number, as `Seen.step`.
        sample_time: Its length [s].
        time: When it begins [s].
        position: Of the front axle then [m].
        speed: Of the car [m/s].
        stage: Driving stage.
        state: Of the real car (8,), as `Seen.state` orders it.
        estimated_state: What the controller has in its place (8,); None where it has the state itself.
        measurement: As `Seen.measurement` (4,).
        preview: None where nothing is previewed.
        asked: Forces that the controller asks for (2,) [N]; None where no command came.
        command: What the actuators are told in that step (2,) [N].
        previous: What they were told before (2,) [N].
        acting: What acts on the car just after the change (2,) [N].
        parts: Of a linear law, what each part of its inputs adds to its forces while no limit binds (2,) [N]; None of
            another.
        limits: Those of the plan, then the actuators'.
        plan: Of a controller that has one; None of another.
        why: One sentence.
    """

    step: int
    sample_time: float
    time: float
    position: float
    speed: float
    stage: str
    state: FloatArray
    estimated_state: FloatArray | None
    measurement: FloatArray
    preview: PreviewedRoad | None
    asked: FloatArray | None
    command: FloatArray
    previous: FloatArray
    acting: FloatArray
    parts: dict[str, FloatArray] | None
    limits: tuple[Limit, ...]
    plan: Plan | None
    why: str


@single_threaded
def instant(
    scenario: Scenario,
    strategy: str | type[Controller] | Controller,
    *,
    position: float | None = None,
    time: float | None = None,
) -> Instant:
    """Return what a controller saw and decided in the control step of its run at a position or at a time.

    The run of a strategy that is named by its id is driven once, and cached while other instants of it are asked for.
    That of a class or an object is driven in each call, because either may have changed.

    Args:
        scenario: What is driven.
        strategy: As `sim_core.simulate` takes it.
        position: Of the front axle [m].
        time: In its place [s].

    Raises:
        UnknownNameError: No such strategy.
        RidelabError: The position or time is outside the drive, or the run fails, as in `simulate`.

    Example:
        >>> from sim_core import Scenario
        >>> from sim_core.instant import instant
        >>> at_bump = instant(Scenario(), "lv", position=Scenario().road.bump.start)
        >>> at_bump.stage, at_bump.plan.forces.shape
        ('bump', (30, 2))
        >>> [limit.name for limit in at_bump.limits]
        ['front_force', 'rear_force', 'front_deflection', 'rear_deflection']
    """
    if isinstance(strategy, str):
        strategy = strategy_named(strategy)
        drive = _cached_drive(scenario, strategy)
    else:
        drive = _driven(scenario, strategy)
    seen = drive.seen(drive.step_at(position, time))
    controller = controller_for(strategy, scenario)
    try:
        controller.start(drive.run.setup())
        law = None if controller.delayed else controller.linear_law(seen.stage)
        plan = controller.plan(drive.seen(seen.step, answered=True) if controller.delayed else seen)
    finally:
        controller.end()
    return _instant(drive, seen, law, plan)


def _instant(drive: Drive, seen: Seen, law: LinearLaw | None, plan: Plan | None) -> Instant:
    run, trajectory, step = drive.run, drive.trajectory, seen.step
    row, size = step * run.steps.short, trajectory.car.size
    asked: FloatArray | None = trajectory.requested[step]
    if np.isnan(trajectory.requested[step]).any():
        asked = None if law is None else linear_force(law, seen)
        asked = asked if plan is None else plan.forces[0]
    lagging = size % STATES
    real = trajectory.loop[row, size - lagging - STATES : size - lagging]
    command = trajectory.loop[row + 1, size:]
    planned = () if plan is None else plan.limits
    limits = (*planned, *_actuator_limits(drive, asked, seen.previous_force, planned=bool(planned)))
    parts, acting = None if law is None else _parts(law, seen), trajectory.sample(row, row + 1)[_ACTING, 0, 0]
    return Instant(
        step=step,
        sample_time=drive.inputs.sample_time,
        time=seen.time,
        position=seen.position,
        speed=seen.speed,
        stage=seen.stage,
        state=real,
        estimated_state=None if size - lagging == STATES else seen.state,
        measurement=seen.measurement,
        preview=_preview(drive, seen),
        asked=asked,
        command=command,
        previous=seen.previous_force,
        acting=acting,
        parts=parts,
        limits=limits,
        plan=plan,
        why=why(
            actuated=run.controller.actuated,
            asked=asked,
            command=plan.forces[0] if run.controller.delayed and plan is not None else command,
            acting=None if run.controller.dampers() is None else acting,
            limits=planned if run.controller.delayed else limits,
            parts=parts,
            state=seen.state,
        ),
    )


def _preview(drive: Drive, seen: Seen) -> PreviewedRoad | None:
    mode, horizon = drive.run.preview, drive.run.preview_steps
    if mode == "none":
        return None
    time = seen.time + drive.inputs.sample_time * np.arange(1, horizon + 1, dtype=np.float64)
    position = drive.run.speed_profile.at(time)[0]
    axles = np.stack([position, position - drive.run.scenario.rear_axle_offset], axis=1)
    real = drive.run.excitation.surface.height(axles)
    return PreviewedRoad(mode=mode, time=time, position=position, seen=seen.preview, real=real)


def _parts(law: LinearLaw, seen: Seen) -> dict[str, FloatArray]:
    now = np.concatenate([seen.state, seen.previous_force])
    parts = {name: law.gain[:, columns] @ now[columns] for name, columns in _STATE_PARTS.items()}
    preview_forces = np.zeros((FORCES, DISTURBANCES))
    if law.preview_gain is not None:
        preview_forces = np.einsum("udi,di->ud", law.preview_gain.reshape(FORCES, DISTURBANCES, -1), seen.disturbances)
    return parts | {"road_ahead": preview_forces[:, :2].sum(axis=1), "braking": preview_forces[:, 2]}


def _actuator_limits(drive: Drive, asked: FloatArray | None, previous: FloatArray, *, planned: bool) -> list[Limit]:
    """Return the limits of the requested force, unless a plan keeps it, of its change, and of the actuators' force."""
    if asked is None or not drive.run.controller.actuated:
        return []
    bounds = drive.run.force_limits()
    if drive.run.controller.delayed:
        bounds[1:] = inf  # these act when its commands arrive
    command, without = np.empty(FORCES), np.empty(FORCES)
    limit_force(bounds, asked, previous, command)
    limits = []
    for which, name in enumerate(("force", "force_change", "actuator_force")):
        if (planned and which == 0) or not np.isfinite(bounds[which]):
            continue
        freed = bounds.copy()
        freed[which] = inf
        limit_force(freed, asked, previous, without)
        limited = (asked, asked - previous, asked)[which]
        for axle, where in enumerate(("front", "rear")):
            force = command.copy()
            force[axle] = without[axle]
            limits.append(
                Limit(
                    name=f"{where}_{name}",
                    unit="N",
                    bound=float(bounds[which]),
                    values=limited[axle : axle + 1],
                    multipliers=None,
                    force_without=force,
                )
            )
    return limits
