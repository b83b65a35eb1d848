"""The car with its actuators, stepped exactly; many fine steps at once as one matrix product."""

from dataclasses import dataclass
from functools import lru_cache
from math import pi

import numpy as np

from sim_core.car.half_car import DISTURBANCES, FORCES, OUTPUTS, STATES, half_car, hold
from sim_core.result import FloatArray
from sim_core.scenario import Actuator, Vehicle

_LONGEST_LIFT = 16  # fine steps in one matrix product; more would cost more than they save
RECORDED = len(OUTPUTS) + FORCES  # what is recorded: half_car.OUTPUTS, then the actuators' forces [N]


@dataclass(frozen=True, slots=True, eq=False, kw_only=True)
class Lift:
    """`fine` steps as one linear map of [plant state; command in N; disturbances (3 · fine)].

    `outputs` (n + 2 + 3 · fine, outputs · (fine + 1)): output after output, each at the start of every fine step and at
    the end of the last. `end` (…, n): the state after all.
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
    lifts: tuple[Lift, ...]

    @property
    def size(self) -> int:
        """Length of the plant's state."""
        return len(self.A)

    def record(self, states: FloatArray, commands: FloatArray, disturbance: FloatArray) -> FloatArray:
        """Outputs (RECORDED, steps, fine + 1) from states (steps, n) and commands (steps, 2).

        A row begins with the value after its command has changed and ends with the value before the next one does.
        """
        steps, used = len(states), 0
        table = np.empty((RECORDED, steps, sum(lift.fine for lift in self.lifts) + 1))
        table[len(OUTPUTS) :] = commands.T[:, :, None]  # of an ideal actuator; a lagging one's forces come out below
        for lift in self.lifts:
            width = DISTURBANCES * lift.fine
            given = np.hstack([states, commands, disturbance[:, used * DISTURBANCES : used * DISTURBANCES + width]])
            rows = (given @ lift.outputs).reshape(steps, -1, lift.fine + 1)
            table[: rows.shape[1], :, used : used + lift.fine + 1] = rows.transpose(1, 0, 2)
            used += lift.fine
            if used + 1 < table.shape[2]:
                states = given @ lift.end
        return table


@lru_cache(maxsize=64)
def plant(vehicle: Vehicle, actuator: Actuator, step: float, fine: int) -> Plant:
    """The plant over a control step [s] of `fine` fine steps."""
    model = half_car(vehicle)
    A, inputs = model.A, np.hstack([model.B, model.E])
    outputs = np.hstack([model.C, model.D, model.F])
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
    whole = _lift(fine_A, fine_inputs, outputs[:0], fine).end.T
    n = len(A)
    return Plant(A=whole[:, :n], B=whole[:, n : n + FORCES], E=whole[:, n + FORCES :].T, lifts=tuple(lifts))


def _lift(A: FloatArray, inputs: FloatArray, outputs: FloatArray, fine: int) -> Lift:
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
    return Lift(fine=fine, outputs=np.ascontiguousarray(by_output.T), end=np.ascontiguousarray(state.T))
