"""The car with its actuators, stepped exactly; many fine steps at once as one matrix product."""

from dataclasses import dataclass
from math import pi

import numpy as np

from sim_core.arrays import FloatArray
from sim_core.caching import cached
from sim_core.scenario import Actuator, Vehicle
from sim_core.vehicle.half_car import DISTURBANCES, FORCES, OUTPUTS, STATES, half_car, hold

_LONGEST_RECORD = 4_096  # control steps recorded in one matrix product
_LONGEST_LIFT = 16  # fine steps in one matrix product; more would cost more than they save
_SPEEDS = ("front_deflection_speed", "rear_deflection_speed")
RECORDED = (*_SPEEDS, *(name for name in OUTPUTS if name not in _SPEEDS), "front_force", "rear_force")


@dataclass(frozen=True, slots=True, eq=False, kw_only=True)
class LiftedStep:
    """`fine` steps as one linear map of [plant state; command in N; disturbances (3 · fine)].

    `outputs` (signals · (fine + 1), n + 2 + 3 · fine): one of RECORDED after another, each at the start of every fine
    step and at the end of the last; without the forces of ideal actuators, as they are the commands. `end` (n, …): the
    state after all.
    """

    fine: int
    outputs: FloatArray
    end: FloatArray


@dataclass(frozen=True, slots=True, eq=False, kw_only=True)
class Plant:
    """One control step: p' = A p + B u + disturbances · E, in `lifts` that follow each other.

    p is the half-car's state (8,), with a lagging actuator joined by the two forces [N] (10,).
    """

    A: FloatArray
    B: FloatArray
    E: FloatArray
    lifts: tuple[LiftedStep, ...]

    @property
    def size(self) -> int:
        """Length of the plant's state."""
        return len(self.A)

    def record(self, states: FloatArray, commands: FloatArray, disturbance: FloatArray) -> FloatArray:
        """RECORDED (10, fine + 1, steps) from states (steps, n) and commands (steps, 2).

        A step begins with the value after its command has changed and ends with the value before the next one does.
        """
        table = np.empty((len(RECORDED), disturbance.shape[1] // DISTURBANCES + 1, len(states)))
        signals = len(self.lifts[0].outputs) // (self.lifts[0].fine + 1)
        if signals < len(RECORDED):
            table[signals:] = commands.T[:, np.newaxis]
        for begin in range(0, len(states), _LONGEST_RECORD):  # a product takes about as much memory as it gives
            block = slice(begin, begin + _LONGEST_RECORD)
            first, state = 0, states[block]
            for lift in self.lifts:
                last = first + lift.fine
                met = disturbance[block, DISTURBANCES * first : DISTURBANCES * last]
                causes = np.hstack([state, commands[block], met]).T
                if len(self.lifts) == 1 and len(states) <= _LONGEST_RECORD:
                    np.matmul(lift.outputs, causes, out=table[:signals].reshape(len(lift.outputs), -1))
                    break
                table[:signals, first : last + 1, block] = (lift.outputs @ causes).reshape(signals, lift.fine + 1, -1)
                first, state = last, (lift.end @ causes).T
        return table


@cached
def plant(vehicle: Vehicle, actuator: Actuator, step: float, fine: int) -> Plant:
    """The plant over a control step [s] of `fine` fine steps."""
    model = half_car(vehicle)
    A, inputs = model.A, np.hstack([model.B, model.E])
    rows = [OUTPUTS.index(name) for name in RECORDED[:-FORCES]]
    outputs = np.hstack([model.C, model.D, model.F])[rows]
    if actuator.bandwidth is not None:  # u̇ = 2π f (command - u): the forces become states, the command drives them
        corner = 2 * pi * actuator.bandwidth
        A = np.block([[model.A, model.B], [np.zeros((FORCES, STATES)), -corner * np.eye(FORCES)]])
        command = np.vstack([np.zeros((STATES, FORCES)), corner * np.eye(FORCES)])
        inputs = np.hstack([command, np.vstack([model.E, np.zeros((FORCES, DISTURBANCES))])])
        outputs = np.vstack([outputs, np.eye(FORCES, outputs.shape[1], k=STATES)])
        outputs = np.insert(outputs, [STATES + FORCES] * FORCES, 0.0, axis=1)  # a command is no force yet
    fine_A, fine_inputs = hold(A, inputs, step / fine)
    longest = _lift(fine_A, fine_inputs, outputs, min(fine, _LONGEST_LIFT))
    lifts = [longest] * (fine // longest.fine)
    if fine % longest.fine:
        lifts.append(_lift(fine_A, fine_inputs, outputs, fine % longest.fine))
    whole = _lift(fine_A, fine_inputs, outputs[:0], fine).end
    n = len(A)
    A, B = (np.ascontiguousarray(part) for part in (whole[:, :n], whole[:, n : n + FORCES]))
    return Plant(A=A, B=B, E=whole[:, n + FORCES :].T, lifts=tuple(lifts))


def _lift(A: FloatArray, inputs: FloatArray, outputs: FloatArray, fine: int) -> LiftedStep:
    """Roll `fine` steps of p' = A p + inputs·[command; disturbance] into one map."""
    n = len(A)
    width = n + FORCES + DISTURBANCES * fine
    state, held, rows = np.eye(n, width), np.zeros((FORCES + DISTURBANCES, width)), []
    held[:FORCES, n : n + FORCES] = np.eye(FORCES)
    for j in range(fine):
        first = n + FORCES + DISTURBANCES * j
        held[FORCES:] = np.eye(DISTURBANCES, width, k=first)
        rows.append(outputs[:, :n] @ state + outputs[:, n:] @ held)
        state = A @ state + inputs @ held
    rows.append(outputs[:, :n] @ state + outputs[:, n:] @ held)
    by_output = np.stack(rows, axis=1).reshape(-1, width)
    return LiftedStep(fine=fine, outputs=by_output, end=state)
