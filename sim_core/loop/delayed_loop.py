"""A controller whose commands arrive later: the car goes in short steps, so that one may come within a control step.

The controller is asked at the control instants; what it answers takes effect at the short step that `arrivals` says, or
never. The actuators hold the newest command that has arrived, and their limits hold in every short step.
"""

from dataclasses import dataclass

import numpy as np

from sim_core.arrays import FloatArray
from sim_core.control.controller import Controller
from sim_core.control.seen import RunInputs, Seen, Setup
from sim_core.errors import RefusedError
from sim_core.kernel.prepared import DrivenCar, limit_force
from sim_core.loop.closed_loop import Trajectory, checked_force, read_only
from sim_core.vehicle.half_car import FORCES


@dataclass(frozen=True, slots=True, eq=False)
class DelayedLoop:
    """One run's loop; limits of forces as `limit_force` has them, of the change in a short step."""

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
        return Trajectory(loop=loop, requested=requested, limited=limited, held_commands=held_commands)

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
