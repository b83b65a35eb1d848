"""The car with its actuators, stepped exactly; many fine steps at once as one matrix product."""

from dataclasses import dataclass
from functools import lru_cache
from math import pi

import numpy as np

from sim_core.half_car import DISTURBANCES, FORCES, OUTPUTS, STATES, half_car, hold
from sim_core.result import FloatArray
from sim_core.scenario import Actuator, Vehicle

_LONGEST_LIFT = 16  # fine steps in one matrix product; more would cost more than they save
RECORDED = len(OUTPUTS) + FORCES  # outputs of each fine step: half_car.OUTPUTS, then the actuators' forces [N]


@dataclass(frozen=True, slots=True, eq=False, kw_only=True)
class Lift:
    """`fine` steps as one linear map of [plant state; command in N; disturbances (3 · fine)].

    `outputs` (n + 2 + 3 · fine, RECORDED · fine): at the start of each fine step. `end` (…, n): the state after all.
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
        """Outputs on the fine grid (RECORDED, steps · fine) from states (steps, n) and commands (steps, 2)."""
        rows, used = [], 0
        for lift in self.lifts:
            width = DISTURBANCES * lift.fine
            given = np.hstack([states, commands, disturbance[:, used : used + width]])
            rows.append((given @ lift.outputs).reshape(len(states), lift.fine, RECORDED))
            if lift is not self.lifts[-1]:
                states = given @ lift.end
            used += width
        table = rows[0] if len(rows) == 1 else np.concatenate(rows, axis=1)
        return np.ascontiguousarray(table.reshape(-1, RECORDED).T)


@lru_cache(maxsize=64)
def plant(vehicle: Vehicle, actuator: Actuator, step: float, fine: int) -> Plant:
    """The plant over a control step [s] of `fine` fine steps."""
    model = half_car(vehicle)
    A, inputs = model.A, np.hstack([model.B, model.E])
    outputs = np.vstack([np.hstack([model.C, model.D, model.F]), np.eye(FORCES, STATES + FORCES + 3, k=STATES)])
    if actuator.bandwidth is not None:  # u̇ = 2π f (command - u): the forces become states, the command drives them
        corner = 2 * pi * actuator.bandwidth
        A = np.block([[model.A, model.B], [np.zeros((FORCES, STATES)), -corner * np.eye(FORCES)]])
        command = np.vstack([np.zeros((STATES, FORCES)), corner * np.eye(FORCES)])
        inputs = np.hstack([command, np.vstack([model.E, np.zeros((FORCES, DISTURBANCES))])])
        force, disturbed = outputs[:, STATES : STATES + FORCES], outputs[:, STATES + FORCES :]
        outputs = np.hstack([outputs[:, :STATES], force, np.zeros_like(force), disturbed])
    fine_A, fine_inputs = hold(A, inputs, step / fine)
    lifts, left = [], fine
    while left:
        lifts.append(_lift(fine_A, fine_inputs, outputs, min(left, _LONGEST_LIFT)))
        left -= lifts[-1].fine
    whole = _lift(fine_A, fine_inputs, outputs[:0], fine).end.T
    n = len(A)
    return Plant(A=whole[:, :n], B=whole[:, n : n + FORCES], E=whole[:, n + FORCES :].T, lifts=tuple(lifts))


def _lift(A: FloatArray, inputs: FloatArray, outputs: FloatArray, fine: int) -> Lift:
    """Roll `fine` steps of p' = A p + inputs·[command; disturbance] into one map."""
    n = len(A)
    width = n + FORCES + DISTURBANCES * fine
    state, rows = np.eye(n, width), []
    for j in range(fine):
        held = np.zeros((FORCES + DISTURBANCES, width))
        held[:FORCES, n : n + FORCES] = np.eye(FORCES)
        first = n + FORCES + DISTURBANCES * j
        held[FORCES:, first : first + DISTURBANCES] = np.eye(DISTURBANCES)
        rows.append(outputs[:, :n] @ state + outputs[:, n:] @ held)
        state = A @ state + inputs @ held
    return Lift(fine=fine, outputs=np.ascontiguousarray(np.vstack(rows).T), end=np.ascontiguousarray(state.T))
