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
from sim_core.control.seen import RunInputs, Seen
from sim_core.errors import ForceError, RefusedError
from sim_core.kernel.prepared import ControlLawContext, DrivenCar, FollowLaw, limit_force
from sim_core.loop.preview import Forecast
from sim_core.speed.stages import Segment
from sim_core.vehicle.half_car import FORCES


@dataclass(frozen=True, slots=True, eq=False, kw_only=True)
class Trajectory:
    """What was driven.

    Attributes:
        loop: [p; previous command] before each of the car's steps and after the last (steps + 1, n + 2).
        requested: Forces that the controller gave (steps, 2) [N]; NaN where it was not asked, or no command came.
        limited: Control steps in which a limit bound.
        held_commands: Commands that never took effect, of a delayed controller.
    """

    loop: FloatArray
    requested: FloatArray
    limited: int
    held_commands: int | None = None


@dataclass(frozen=True, slots=True, eq=False)
class ClosedLoop:
    """One run's loop; limits of forces as `limit_force` has them."""

    controller: Controller
    car: DrivenCar
    inputs: RunInputs
    forecast: Forecast
    force_limits: FloatArray

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
            law, k = self.controller.linear_law(segment.stage), segment.first
            if law is None:
                limited += sum(self._step(k, loop, requested) for k in range(segment.first, segment.last))
                continue
            if not isinstance(law, LinearLaw):
                raise RefusedError(f"{self.controller.label}: linear_law gives a LinearLaw or None")
            if law.design.horizon not in (0, self.forecast.disturbances.shape[2]):
                raise RefusedError("A linear law has three columns for each control step that is previewed")
            follow = follow or self.car.follow_law(
                control_law_context(self.forecast, self.force_limits, clips=clips), loop
            )
            qp = self.controller.qp(segment.stage)
            while k < segment.last:
                k, shaped = follow(law.design, qp, k, segment.last)
                limited += shaped
                if k < segment.last:
                    self._step(k, loop, requested)
                    limited, k = limited + 1, k + 1
        return Trajectory(loop=loop, requested=requested, limited=limited)

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


def control_law_context(forecast: Forecast, force_limits: FloatArray, *, clips: bool) -> ControlLawContext:
    """Return what a run's laws share.

    Args:
        forecast: What its controller previews.
        force_limits: As `limit_force` has them.
        clips: Whether a force beyond the limit is clipped, or not decided by the law.
    """
    kind, step, _ = (stride // forecast.disturbances.itemsize for stride in forecast.disturbances.strides)
    return ControlLawContext(
        horizon=forecast.disturbances.shape[2],
        preview=forecast.source,
        strides=(kind, step),
        preview_norms=forecast.preview_norms,
        force_limits=force_limits,
        clips=clips,
    )


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
