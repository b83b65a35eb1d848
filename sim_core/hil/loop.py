"""Plant and ECU in lock-step: converters on both sides, one control step of delay, jitter and lost packets.

The plant is driven in short steps, so that a command may come in the middle of a control step. The ECU measures at the
control instants; its answer to instant k takes effect at instant k + 1, later by the jitter, or never.
"""

from dataclasses import dataclass
from math import ceil

import numpy as np
from numpy.typing import NDArray

from sim_core.cost import KILO
from sim_core.half_car import FORCES, STATES
from sim_core.hil.calibration import Calibration
from sim_core.hil.channels import convert, reaches
from sim_core.hil.ecu import Ecu, Frame, Reply
from sim_core.plant import Plant
from sim_core.result import FloatArray
from sim_core.scenario import Hil

LONGEST_STEP = 1e-3  # the plant's, and the grain of the jitter [s]
_NOISE, _JITTER, _LOSS = 3, 4, 5  # generators of their own beside the road's and the preview's


@dataclass(frozen=True, slots=True, eq=False, kw_only=True)
class Way:
    """What the loop meets.

    Attributes:
        forcing: What the road and the braking do to the plant in each short step (steps · n, plant states).
        preview: What the sensors see ahead at each control instant (steps, 3 · preview_length).
        stages: Number of the stage at each control instant (steps,).
        per_control: Short steps in a control step, n.
        step: Short step [s].
    """

    forcing: FloatArray
    preview: FloatArray
    stages: list[int]
    per_control: int
    step: float


@dataclass(frozen=True, slots=True, kw_only=True)
class Limits:
    """Of the actuators: greatest change of a force [N/s], infinite where there is none, and greatest force [N]."""

    rate: float
    force: float


@dataclass(slots=True)
class Tally:
    """What happened between plant and ECU in a run.

    Attributes:
        limited: Control steps in which a limit shaped the commands.
        unfinished: Of those, how many the solver did not finish.
        iterations: The solver's most in one step.
        slack: Largest predicted deflection beyond the limit [cm].
        clipped: Measured values beyond their range.
        held: Commands that never took effect: lost, late, or overtaken by a later one.
    """

    limited: int = 0
    unfinished: int = 0
    iterations: int = 0
    slack: float = 0.0
    clipped: int = 0
    held: int = 0

    def count(self, reply: Reply) -> None:
        """Take an answer in."""
        self.limited += reply.limited
        self.unfinished += reply.unfinished
        self.iterations = max(self.iterations, reply.iterations)
        self.slack = max(self.slack, reply.slack)


@dataclass(frozen=True, slots=True, eq=False, kw_only=True)
class HilCourse:
    """States (steps · n, plant states) and actuator commands (steps · n, 2) [N] at each short step, and the tally."""

    states: FloatArray
    commands: FloatArray
    tally: Tally


def short_steps(sample_time: float) -> int:
    """Short steps in a control step [s]."""
    return ceil(sample_time / LONGEST_STEP - 1e-9)


class HilLoop:
    """One run."""

    def __init__(self, *, plant: Plant, way: Way, calibration: Calibration, hil: Hil, limits: Limits) -> None:
        self._plant = plant
        self._way = way
        self._known = calibration
        self._hil = hil
        self._limits = limits
        self._reach = reaches(calibration.preview_length)
        self._control_steps = len(way.forcing) // way.per_control

    def run(self, ecu: Ecu) -> HilCourse:
        """Drive from rest, without a command before the first answer."""
        steps, n, plant, forcing = self._control_steps, self._way.per_control, self._plant, self._way.forcing
        states, commands = np.empty((steps * n, plant.size)), np.empty((steps * n, FORCES))
        arrivals, tally = self._arrivals().tolist(), Tally()
        newest = [-1] * (steps * n)  # the answer that arrives at a short step, the newest of several
        asked = np.zeros((steps + 1, FORCES))  # by answer [N]; the last row is none, -1
        used = np.zeros(steps + 1, dtype=bool)
        noise = self._noise()
        ahead, tally.clipped = convert(self._way.preview + noise[:, STATES:], self._reach[STATES:], self._known.bits)
        state, held, present = np.zeros(plant.size), -1, np.zeros(FORCES)
        settled, driven = True, np.zeros(plant.size)  # whether the actuators have what is asked; what they do
        for k in range(steps):
            sensed, clipped = convert(state[:STATES] + noise[k, :STATES], self._reach[:STATES], self._known.bits)
            tally.clipped += clipped
            codes = np.concatenate([sensed, ahead[k]])
            reply = ecu.exchange(Frame(step=k, stage=self._way.stages[k], codes=codes))
            if reply is not None:
                asked[k] = np.array(reply.commands) * (self._known.command_step * KILO)
                tally.count(reply)
                if arrivals[k] < steps * n:
                    newest[arrivals[k]] = k
            for i in range(k * n, k * n + n):
                if newest[i] > held:
                    held, settled = newest[i], False
                    used[held] = True
                if not settled:
                    before, present = present, self._moved(present, asked[held])
                    settled = np.array_equal(present, before)
                    driven = plant.B @ present
                states[i], commands[i] = state, present
                state = plant.A @ state + driven + forcing[i]
        tally.held = int(np.count_nonzero(~used[: steps - 1]))  # the last one would take effect after the run
        return HilCourse(states=states, commands=commands, tally=tally)

    def _noise(self) -> FloatArray:
        """What noise adds to the inputs in each control step (steps, 8 + 3 · preview_length)."""
        shape = (self._control_steps, len(self._reach))
        if not self._hil.noise:
            return np.broadcast_to(0.0, shape)
        generator = np.random.default_rng((self._hil.seed, _NOISE))
        return self._hil.noise * self._reach * generator.standard_normal(shape)

    def _arrivals(self) -> NDArray[np.intp]:
        """The short step at which each answer arrives; one after the end of the run where it is lost."""
        steps, n, hil = self._control_steps, self._way.per_control, self._hil
        latest = round(hil.jitter / self._way.step)
        delays = np.random.default_rng((hil.seed, _JITTER)).integers(0, latest, size=steps, endpoint=True)
        lost = np.random.default_rng((hil.seed, _LOSS)).random(steps) < hil.packet_loss
        return np.where(lost, steps * n, (np.arange(steps) + 1) * n + delays)

    def _moved(self, present: FloatArray, wanted: FloatArray) -> FloatArray:
        """The actuators' command a short step later."""
        limits = self._limits
        if np.isfinite(limits.rate):
            most = limits.rate * self._way.step
            wanted = present + np.clip(wanted - present, -most, most)
        return wanted if abs(wanted).max() <= limits.force else np.clip(wanted, -limits.force, limits.force)
