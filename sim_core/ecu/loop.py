"""Plant and ECU in lock-step: converters on both sides, one control step of delay, jitter and lost packets.

The plant is driven in short steps, so that a command may come in the middle of a control step. The ECU measures at the
control instants; its answer to instant k takes effect at instant k + 1, later by the jitter, or never.
"""

from dataclasses import dataclass
from math import ceil

import numpy as np
from numpy.typing import NDArray

from sim_core.arrays import FloatArray
from sim_core.control.cost import KILO
from sim_core.ecu.calibration import Calibration
from sim_core.ecu.channels import convert, full_scales
from sim_core.ecu.interface import Ecu, Frame, Reply
from sim_core.loop.recording import LoopStatistics
from sim_core.scenario import Hil
from sim_core.vehicle.half_car import FORCES, STATES
from sim_core.vehicle.model import VehicleModel

LONGEST_STEP = 1e-3  # the plant's; jitter comes in steps of the plant [s]
_NOISE, _JITTER, _LOSS = 3, 4, 5  # generators of their own beside the road's and the preview's


@dataclass(frozen=True, slots=True, eq=False, kw_only=True)
class LoopInputs:
    """What the loop meets.

    Attributes:
        preview: What the sensors see ahead at each control instant (steps, 3 · preview_length).
        stages: Number of the stage at each control instant (steps,).
        per_control: Short steps in a control step, n.
        step: Short step [s].
    """

    preview: FloatArray
    stages: list[int]
    per_control: int
    step: float


@dataclass(frozen=True, slots=True, kw_only=True)
class Limits:
    """Of the actuators: greatest change of a force [N/s], infinite where there is none, and greatest force [N]."""

    rate: float
    force: float


@dataclass(frozen=True, slots=True, eq=False, kw_only=True)
class HilTrajectory:
    """States (steps · n, plant states), actuator commands (steps · n, 2) [N] at each short step, loop statistics."""

    states: FloatArray
    commands: FloatArray
    statistics: LoopStatistics


def short_steps(sample_time: float) -> int:
    """Short steps in a control step [s]."""
    return ceil(sample_time / LONGEST_STEP - 1e-9)


class HilLoop:
    """One run."""

    def __init__(
        self, *, car: VehicleModel, inputs: LoopInputs, calibration: Calibration, hil: Hil, limits: Limits
    ) -> None:
        self._car = car
        self._inputs = inputs
        self._calibration = calibration
        self._hil = hil
        self._limits = limits
        self._full_scale = full_scales(calibration.preview_length)
        self._control_steps = len(inputs.stages)

    def run(self, ecu: Ecu) -> HilTrajectory:
        """Drive from rest, without a command before the first answer."""
        steps, n, car = self._control_steps, self._inputs.per_control, self._car
        states, commands = np.empty((steps * n, car.size)), np.empty((steps * n, FORCES))
        arrivals, statistics = self._arrivals().tolist(), LoopStatistics()
        newest = [-1] * (steps * n)  # the answer that arrives at a short step, the newest of several
        asked = np.zeros((steps + 1, FORCES))  # by answer [N]; the last row is none, -1
        used = np.zeros(steps + 1, dtype=bool)
        noise, full_scale, bits = self._noise(), self._full_scale, self._calibration.bits
        previewed, statistics.clipped = convert(self._inputs.preview + noise[:, STATES:], full_scale[STATES:], bits)
        state, held, present = np.zeros(car.size), -1, np.zeros(FORCES)
        settled = True  # whether the actuators have what is asked
        for k in range(steps):
            sensed, clipped = convert(state[:STATES] + noise[k, :STATES], full_scale[:STATES], bits)
            statistics.clipped += clipped
            codes = np.concatenate([sensed, previewed[k]])
            reply = ecu.exchange(Frame(step=k, stage=self._inputs.stages[k], codes=codes))
            if reply is not None:
                asked[k] = np.array(reply.commands) * (self._calibration.command_step * KILO)
                _count(statistics, reply)
                if arrivals[k] < steps * n:
                    newest[arrivals[k]] = k
            for i in range(k * n, k * n + n):
                if newest[i] > held:
                    held, settled = newest[i], False
                    used[held] = True
                if not settled:
                    before, present = present, self._moved(present, asked[held])
                    settled = np.array_equal(present, before)
                states[i], commands[i] = state, present
                state = car.advance(i, state, present)
        statistics.held = int(np.count_nonzero(~used[: steps - 1]))  # the last one would take effect after the run
        return HilTrajectory(states=states, commands=commands, statistics=statistics)

    def _noise(self) -> FloatArray:
        """What noise adds to the inputs in each control step (steps, 8 + 3 · preview_length)."""
        shape = (self._control_steps, len(self._full_scale))
        if not self._hil.noise:
            return np.broadcast_to(0.0, shape)
        generator = np.random.default_rng((self._hil.seed, _NOISE))
        return self._hil.noise * self._full_scale * generator.standard_normal(shape)

    def _arrivals(self) -> NDArray[np.intp]:
        """The short step at which each answer arrives; one after the end of the run where it is lost."""
        steps, n, hil = self._control_steps, self._inputs.per_control, self._hil
        latest = round(hil.jitter / self._inputs.step)
        delays = np.random.default_rng((hil.seed, _JITTER)).integers(0, latest, size=steps, endpoint=True)
        lost = np.random.default_rng((hil.seed, _LOSS)).random(steps) < hil.packet_loss
        return np.where(lost, steps * n, (np.arange(steps) + 1) * n + delays)

    def _moved(self, present: FloatArray, wanted: FloatArray) -> FloatArray:
        """The actuators' command a short step later."""
        limits = self._limits
        if np.isfinite(limits.rate):
            most = limits.rate * self._inputs.step
            wanted = present + np.clip(wanted - present, -most, most)
        return wanted if abs(wanted).max() <= limits.force else np.clip(wanted, -limits.force, limits.force)


def _count(statistics: LoopStatistics, reply: Reply) -> None:
    """Take an answer in."""
    statistics.limited += reply.limited
    statistics.unfinished += reply.unfinished
    statistics.iterations = max(statistics.iterations, reply.iterations)
    statistics.slack = max(statistics.slack, reply.slack)
