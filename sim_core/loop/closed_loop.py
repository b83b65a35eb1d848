"""Controller and car over a run's control steps: by C as long as a linear law holds, else one after another.

C drives the car by the law up to the first step in which one of the law's limits binds; the controller decides that
step, and C goes on (docs/decisions/0002-laws-are-followed-in-c.md). A controller without a law decides every step.
"""

from collections.abc import Sequence
from dataclasses import dataclass
from math import isfinite

import numpy as np

from sim_core.arrays import FloatArray
from sim_core.control.controller import Controller
from sim_core.control.law import LinearLaw
from sim_core.control.seen import RunInputs, Seen, Setup
from sim_core.errors import ForceError, RefusedError
from sim_core.kernel.prepared import DrivenCar, FollowLaw, limit_force
from sim_core.loop.preview import Forecast
from sim_core.speed.stages import Segment
from sim_core.vehicle.half_car import FORCES


@dataclass(frozen=True, slots=True, eq=False, kw_only=True)
class Trajectory:
    """What was driven.

    Attributes:
        car: What was driven.
        loop: [p; previous command] before each of the car's steps and after the last (steps + 1, n + 2).
        requested: Forces that the controller gave (steps, 2) [N]; NaN where it was not asked, or no command came.
        limited: Control steps in which a limit bound.
        held_commands: Commands that never took effect, of a delayed controller.
    """

    car: DrivenCar
    loop: FloatArray
    requested: FloatArray
    limited: int
    held_commands: int | None = None

    def sample(self, first: int, last: int) -> FloatArray:
        """Return the signals of the car's steps from `first` to before `last`, as in record.h (10, n, fine + 1).

        A row has those of a held command, from the value after the command has changed to that before it does again.
        """
        return self.car.sample(first, last, self.loop)


@dataclass(frozen=True, slots=True, eq=False)
class ClosedLoop:
    """One run's loop; limits of forces as `limit_force` has them, `follows_law` as `Run` has it."""

    controller: Controller
    car: DrivenCar
    inputs: RunInputs
    forecast: Forecast
    force_limits: FloatArray
    follows_law: bool

    def run(self, segments: Sequence[Segment]) -> Trajectory:
        """Drive the driving stages from rest, without a command before the first step."""
        n = self.car.size
        loop = np.empty((segments[-1].last + 1, n + FORCES))  # [car; previous command] at every control instant
        loop[0] = 0
        requested = np.full((segments[-1].last, FORCES), np.nan)
        limited = 0
        follow: FollowLaw | None = None
        clips = type(self.controller).force is Controller.force
        for segment in segments:
            law, k = self.controller.linear_law(segment.stage) if self.follows_law else None, segment.first
            if law is None:
                limited += sum(self._step(k, loop, requested) for k in range(segment.first, segment.last))
                continue
            if not isinstance(law, LinearLaw):
                raise RefusedError(f"{self.controller.label}: linear_law gives a LinearLaw or None")
            if law.design.horizon not in (0, self.forecast.disturbances.shape[2]):
                raise RefusedError("A linear law has three columns for each control step that is previewed")
            seen = self.forecast.disturbances, self.forecast.source, self.forecast.preview_norms
            follow = follow or self.car.follow_law(loop, *seen, self.force_limits, clips=clips)
            qp = self.controller.qp(segment.stage)
            while k < segment.last:
                k, shaped = follow(law.design, qp, k, segment.last)
                limited += shaped
                if k < segment.last:
                    self._step(k, loop, requested)
                    limited, k = limited + 1, k + 1
        return Trajectory(car=self.car, loop=loop, requested=requested, limited=limited)

    def _step(self, k: int, loop: FloatArray, requested: FloatArray) -> bool:
        """Drive one control step by the controller; whether a limit of forces or actuators shaped its command."""
        n = self.car.size
        state, previous = loop[k, :n], loop[k, n:]
        seen = Seen(self.inputs, self.car, k, k, read_only(state), read_only(previous))
        counted = self.controller.report.limited_steps
        requested[k] = checked_force(self.controller, self.controller.force(seen), seen)
        limited = limit_force(self.force_limits, requested[k], previous, loop[k + 1, n:])
        self.car.advance(k, loop)
        return limited or self.controller.report.limited_steps > counted


@dataclass(frozen=True, slots=True, eq=False)
class DelayedLoop:
    """The loop of a controller whose commands arrive later: the car goes in short steps, each of which one may begin.

    The controller is asked at the control instants; what it answers takes effect at the short step that `arrivals`
    says, or never. The actuators hold the newest command that has arrived. Limits of forces are as `limit_force` has
    them, of the change in a short step.
    """

    controller: Controller
    car: DrivenCar
    inputs: RunInputs
    setup: Setup
    force_limits: FloatArray

    def run(self) -> Trajectory:
        """Drive from rest, without a command before the first arrives; a row of the trajectory is a short step."""
        car, steps, n = self.car, self.setup.steps, self.setup.short_steps
        loop = np.zeros((steps * n + 1, car.size + FORCES))  # [car; previous command] before every short step
        arrivals = self._arrivals()
        newest = [-1] * (steps * n)  # the command that arrives at a short step, the newest of several
        requested = np.full((steps, FORCES), np.nan)  # by command [N]
        used = np.zeros(steps, dtype=bool)
        held, present, limited = -1, np.zeros(FORCES), 0  # -1: no command yet
        settled, bound = True, False  # whether the actuators change no more, and whether their limits hold them back
        for k in range(steps):
            counted = self.controller.report.limited_steps
            seen = Seen(self.inputs, car, k, k * n, read_only(loop[k * n, : car.size]), read_only(present))
            force = self.controller.force(seen)
            shaped = self.controller.report.limited_steps > counted
            if force is not None:
                requested[k] = checked_force(self.controller, force, seen)
                if arrivals[k] < steps * n:
                    newest[arrivals[k]] = k
            for i in range(k * n, k * n + n):
                command = loop[i + 1, car.size :]
                if newest[i] > held:
                    held, settled = newest[i], False
                    used[held] = True
                if settled:
                    command[:] = present
                else:
                    bound = limit_force(self.force_limits, requested[held], present, command)
                    settled, present = np.array_equal(command, present), command
                shaped |= bound
                car.advance(i, loop)
            limited += shaped
        held_commands = int(np.count_nonzero(~used[: steps - 1]))  # the last one would take effect after the run
        return Trajectory(car=car, loop=loop, requested=requested, limited=limited, held_commands=held_commands)

    def _arrivals(self) -> list[int]:
        """Return the controller's, if each command arrives after it was asked for.

        Raises:
            RidelabError: They are no such numbers.
        """
        steps, n = self.setup.steps, self.setup.short_steps
        arrivals = np.asarray(self.controller.arrivals(self.setup))
        if arrivals.shape != (steps,) or arrivals.dtype.kind not in "iu" or (arrivals < np.arange(steps) * n).any():
            message = "arrivals gives one whole number for each control step, none before its own step"
            raise RefusedError(f"{self.controller.label}: {message}")
        short_steps: list[int] = arrivals.tolist()
        return short_steps


def checked_force(controller: Controller, force: object, seen: Seen) -> FloatArray:
    """Return a controller's forces (2,) [N] for what it saw.

    Raises:
        ForceError: They are not two finite numbers.
    """
    try:
        forces = np.asarray(force)
    except ValueError:  # rows of different lengths
        forces = np.asarray(None)
    numbers = forces.dtype.kind in "biuf"
    if numbers and forces.shape == (FORCES,):
        if not all(map(isfinite, forces.tolist())):
            where = f"in control step {seen.step}, at {seen.position:.1f} m"
            raise _force_error(controller, f"gave a value that is not finite {where}")
        return forces.astype(np.float64)
    if force is None:
        came = "None"
    elif numbers:
        came = f"an array of the shape {forces.shape}"
    else:
        came = f"an object of type {type(force).__name__} that does not hold real numbers"
    raise _force_error(controller, f"gives two numbers, front and rear; in step {seen.step} it gave {came}")


def _force_error(controller: Controller, said: str) -> ForceError:
    code = getattr(controller.force, "__code__", None)
    return ForceError(f"{controller.label}: force {said}", line=None if code is None else code.co_firstlineno)


def read_only(array: FloatArray) -> FloatArray:
    """Return a view of it that nobody can write through."""
    view = array.view()
    view.flags.writeable = False
    return view
