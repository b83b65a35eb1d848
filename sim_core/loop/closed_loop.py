"""Controller and car over a run's control steps: many at once while a linear law holds, else one after another.

A block of control steps is driven by the law as if no limit did bind and accepted up to the first step at which one
would; that step and those after it are decided by the controller until none binds any more, and so on
(docs/decisions/0002-speculative-blocks.md). A controller without such a law decides every step.
"""

from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np

from sim_core.arrays import BoolArray, FloatArray
from sim_core.control.controller import Controller
from sim_core.control.seen import RunInputs, Seen
from sim_core.errors import RidelabError
from sim_core.loop.limits import LawLimits
from sim_core.loop.preview import Forecast, flattened
from sim_core.speed.stages import Segment
from sim_core.vehicle.half_car import FORCES, STATES
from sim_core.vehicle.model import LinearLaw, VehicleModel

_LONGEST_BLOCK, _BLOCK_AFTER_LIMIT = 1024, 16  # control steps
_SAME_FORCE = 1e-6  # [N]: rounding
_NO_FEED = np.zeros(FORCES)


@dataclass(frozen=True, slots=True, kw_only=True)
class ForceLimits:
    """Of a run's forces; each may be infinite.

    Attributes:
        control: Greatest force that the controller may ask for [N].
        change: Greatest change of the actuators' force in a step [N].
        actuator: Greatest force of the actuators [N].
    """

    control: float
    change: float
    actuator: float

    def of_actuator(self, wanted: FloatArray, previous: FloatArray) -> FloatArray:
        """What the actuators are told after the previous command (2,) [N]: or `wanted` itself."""
        if self.change == self.actuator == np.inf:
            return wanted
        change = np.clip(wanted - previous, -self.change, self.change)
        reached = np.where(change == wanted - previous, wanted, previous + change)
        command = np.clip(reached, -self.actuator, self.actuator)
        return wanted if np.array_equal(command, wanted) else command


@dataclass(frozen=True, slots=True, eq=False, kw_only=True)
class Trajectory:
    """What was driven.

    Attributes:
        states: Of the car at the beginning of each of its steps (steps, n).
        commands: Held in each (steps, 2) [N].
        limited: Control steps in which a limit bound.
        held_commands: Commands that never took effect, of a delayed controller.
    """

    states: FloatArray
    commands: FloatArray
    limited: int
    held_commands: int | None = None


class ClosedLoop:
    """One run's loop."""

    def __init__(
        self, controller: Controller, car: VehicleModel, inputs: RunInputs, forecast: Forecast, limits: ForceLimits
    ) -> None:
        self._controller = controller
        self._car = car
        self._inputs = inputs
        self._forecast = forecast
        self._limits = limits

    def run(self, segments: Sequence[Segment]) -> Trajectory:
        """Drive the driving stages from rest, without a command before the first step."""
        n = self._car.size
        loop = np.zeros((segments[-1].last + 1, n + FORCES))  # [car; previous command] at every control instant
        limited = 0
        for segment in segments:
            law = self._controller.linear_law(segment.stage)
            if law is None:
                limited += sum(self._step(k, loop) for k in range(segment.first, segment.last))
            else:
                limited += self._by_law(law, segment, loop)
        return Trajectory(states=loop[:-1, :n], commands=loop[1:, n:], limited=limited)

    def _by_law(self, law: LinearLaw, segment: Segment, loop: FloatArray) -> int:
        """Drive one stage by its law where it holds; in how many steps a limit bound."""
        n, first, last = self._car.size, segment.first, segment.last
        holding = LawLimits(law=law, force_limit=self._limits.control, forecast=self._forecast)
        feed = np.zeros((last - first, FORCES))
        if law.preview_gain is not None:
            previewed = flattened(self._forecast.windows[:, first:last])
            if previewed.shape[1] != law.preview_gain.shape[1]:
                raise RidelabError(f"{self._controller.label}: preview_gain has three columns for each step previewed")
            feed = np.asarray(previewed @ law.preview_gain.T)
        clips = law.limits is None and self._car.clips
        force_limit = self._limits.control if clips else np.inf
        k, block, limited = first, _LONGEST_BLOCK, 0
        while k < last:
            stop = min(k + block, last)
            z = self._car.free_run(law, force_limit, k, loop[k], feed[k - first : stop - first])
            free = self._free(holding, z, k, clips=clips)
            count = len(free) if free.all() else int(free.argmin())
            loop[k : k + count + 1] = z[: count + 1]
            k += count
            block, limit_binds = min(2 * block, _LONGEST_BLOCK), k < stop
            while limit_binds and k < last:
                limit_binds = self._step(k, loop, holding, feed[k - first])
                limited, k, block = limited + limit_binds, k + 1, _BLOCK_AFTER_LIMIT
        if not clips:
            return limited
        wanted = (
            loop[first:last, :STATES] @ law.gain[:, :STATES].T + loop[first:last, n:] @ law.gain[:, STATES:].T + feed
        )
        return int((np.abs(loop[first + 1 : last + 1, n:] - wanted) > _SAME_FORCE).any(axis=1).sum())

    def _step(self, k: int, loop: FloatArray, holding: LawLimits | None = None, feed: FloatArray = _NO_FEED) -> bool:
        """Drive one control step by the controller, or by its law if that holds; whether a limit bound."""
        n = self._car.size
        state, previous = loop[k, :n], loop[k, n:]
        limited = False
        if holding is not None:
            gain = holding.law.gain
            wanted = gain[:, :STATES] @ state[:STATES] + gain[:, STATES:] @ previous + feed
            measured = np.concatenate([state[:STATES], previous])
            limited = not holding.hold(k, measured[None], wanted[None])[0]
        if holding is None or limited:
            asked = self._asked(k, state, previous)
            wanted = asked.clip(-self._limits.control, self._limits.control)
            limited = limited or not np.array_equal(asked, wanted)
        command = self._limits.of_actuator(wanted, previous)
        loop[k + 1, :n] = self._car.advance(k, state, command)
        loop[k + 1, n:] = command
        return limited or command is not wanted

    def _asked(self, k: int, state: FloatArray, previous: FloatArray) -> FloatArray:
        """The controller's forces (2,) [N]; it may keep what it is shown, but not change it."""
        seen = Seen(self._inputs, self._car, k, read_only(state), read_only(previous))
        return checked_force(self._controller, self._controller.force(seen))

    def _free(self, holding: LawLimits, z: FloatArray, k: int, *, clips: bool) -> BoolArray:
        """In which steps of a block driven from step k on no limit binds (n,); the car meets the force limit itself."""
        n, limits = self._car.size, self._limits
        now, commands = z[:-1], z[1:, n:]
        if clips:
            free = np.asarray(np.isfinite(commands).all(axis=1))
        else:
            free = holding.hold(k, np.hstack([now[:, :STATES], now[:, n:]]), commands)
        if limits.change < np.inf:
            free &= (np.abs(commands - now[:, n:]) <= limits.change).all(axis=1)
        if limits.actuator < np.inf:
            free &= (np.abs(commands) <= limits.actuator).all(axis=1)
        return free


def checked_force(controller: Controller, force: object) -> FloatArray:
    """A controller's forces (2,) [N].

    Raises:
        RidelabError: They are not two finite numbers.
    """
    try:
        asked = np.asarray(force, dtype=np.float64)
    except (TypeError, ValueError):
        asked = np.empty(0)
    if asked.shape != (FORCES,):
        raise RidelabError(f"{controller.label}: force gives two numbers, front and rear")
    if not np.isfinite(asked).all():
        raise RidelabError(f"{controller.label}: force gave a value that is not finite")
    return asked


def read_only(array: FloatArray) -> FloatArray:
    """A view of it that nobody can write through."""
    view = array.view()
    view.flags.writeable = False
    return view
