"""A run that was driven, of which any control step can be looked at again."""

from dataclasses import dataclass

import numpy as np

from sim_core.arrays import FloatArray
from sim_core.caching import cached
from sim_core.control.controller import Controller
from sim_core.control.seen import RunInputs, Seen
from sim_core.errors import RidelabError
from sim_core.loop.closed_loop import read_only
from sim_core.loop.run import Recording, Run
from sim_core.scenario import Scenario
from sim_core.simulate import prepare
from sim_core.vehicle.half_car import FORCES

_NEAR = 1e-9  # of the drive, for rounding


@dataclass(frozen=True, slots=True, eq=False, kw_only=True)
class Drive:
    """A run after its drive.

    Attributes:
        run: With its controller, whose `end` was called.
        recording: What was driven.
        inputs: What `Seen` reported.
    """

    run: Run
    recording: Recording
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
        row, car, trajectory = step * self.run.steps.short, self.recording.car, self.recording.trajectory
        now = read_only(trajectory.loop[row])
        previous = now[car.size :]
        if answered:
            answers = trajectory.requested[:step]
            answers = answers[~np.isnan(answers).any(axis=1)]
            previous = read_only(answers[-1]) if len(answers) else np.zeros(FORCES)
        return Seen(self.inputs, car, step, row, now[: car.size], previous)

    def sample(self, step: int) -> FloatArray:
        """The recorded signals just after that step's command has changed (10,), as kernel/record.h orders them."""
        row, loop = step * self.run.steps.short, self.recording.trajectory.loop
        return np.asarray(self.recording.car.sample(row, row + 1, loop)[:, 0, 0])


def driven(scenario: Scenario, strategy: type[Controller] | Controller) -> Drive:
    """Drive a run."""
    run = prepare(scenario, strategy)
    recording = run.drive()
    forecast = run.forecast(run.preview, run.preview_steps)
    return Drive(run=run, recording=recording, inputs=run.inputs(forecast))


# For classes that a strategy's id stands for: those that are handed over may change, and their objects too.
cached_drive = cached(driven)
