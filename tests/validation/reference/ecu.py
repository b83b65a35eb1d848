"""The ECU in NumPy and double precision: the same algorithm as the C program, written apart from it.

It is written for clarity where the C is written for a small part: every iteration solves its equations anew.
"""

from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from sim_core.arrays import FloatArray
from sim_core.control.qp import AXLES
from sim_core.ecu.calibration import FORCE_ROW, MOST_ACTIVE, Calibration, StageTables
from sim_core.ecu.channels import highest_code
from sim_core.ecu.interface import Ecu, Frame, Reply
from sim_core.vehicle.half_car import DISTURBANCES, FORCES, STATES

TOLERANCE = 1e-4  # a row may be so far beyond its limit [kN or cm]: 0.1 N, 1 µm
SINGULAR = 1e-6  # below this share of its own size a row depends on those that bind


class ModelEcu(Ecu):
    """Predict, law, checks, dual active-set iterations, converters; `previous` is the last command [kN]."""

    def __init__(self, calibration: Calibration, previous: FloatArray | None = None) -> None:
        self._calibration = calibration
        self._previous = np.zeros(FORCES) if previous is None else previous
        self._steps = np.concatenate(
            [
                calibration.input_steps[:STATES],
                np.repeat(calibration.input_steps[STATES:], calibration.preview_length),
            ]
        )

    def exchange(self, frame: Frame) -> Reply:
        """Answer at once."""
        calibration = self._calibration
        values = frame.codes * self._steps
        state = values[:STATES]
        preview = values[STATES:].reshape(DISTURBANCES, calibration.preview_length)
        if calibration.predicts:
            state = calibration.A @ state + calibration.B @ self._previous + calibration.E @ preview[:, 0]
            preview = preview[:, 1:]
        rows, iterations, finished, slack = self.optimum(frame.stage, state, preview)
        limited = iterations > 0 or not finished
        force, highest = rows[:FORCES], highest_code(calibration.bits)
        codes = np.clip(np.trunc(force / calibration.command_step + np.copysign(0.5, force)), -highest, highest)
        self._previous = codes * calibration.command_step
        commands = (int(codes[0]), int(codes[1]))
        return Reply(
            commands=commands, limited=limited, iterations=iterations, unfinished=not finished, slack=max(0.0, slack)
        )

    def optimum(self, stage: int, state: FloatArray, preview: FloatArray) -> tuple[FloatArray, int, bool, float]:
        """Row values (m,) at the constrained optimum, iterations, whether it is one, the largest slack [cm].

        Args:
            stage: Its number.
            state: When the command takes effect (8,).
            preview: From then on (3, Np).
        """
        tables = self._calibration.stages[stage]
        inputs = np.concatenate([state, self._previous, preview.ravel()])
        return _Dual(self._calibration, tables, tables.rows @ inputs).solve()


@dataclass(frozen=True, slots=True, eq=False)
class _Limits:
    """Some limits: row `rows[i]` at the side `signs[i]`; rows m and m + 1 are the slacks' own limits, at zero.

    `multipliers` are theirs, never negative.
    """

    rows: NDArray[np.intp]
    signs: FloatArray
    multipliers: FloatArray

    def with_one(self, row: int, sign: float, multiplier: float) -> "_Limits":
        return _Limits(np.append(self.rows, row), np.append(self.signs, sign), np.append(self.multipliers, multiplier))

    def without(self, place: int) -> "_Limits":
        return _Limits(np.delete(self.rows, place), np.delete(self.signs, place), np.delete(self.multipliers, place))


class _Dual:
    """Goldfarb and Idnani (1983) on the rows alone: |row| <= bound + slack of its axle, and no slack below zero.

    The slacks' own limits bind at the start: unconstrained they would be negative, as their linear price says.
    """

    def __init__(self, calibration: Calibration, tables: StageTables, values: FloatArray) -> None:
        m = len(values)
        self._calibration = calibration
        self._gram = np.zeros((m + AXLES, m + AXLES))
        self._gram[:m, :m] = tables.gram
        self._free = values
        self._axles = np.concatenate([calibration.axles, range(AXLES)]).astype(np.intp)
        self._active = _Limits(np.arange(m, m + AXLES), np.zeros(AXLES), np.full(AXLES, calibration.slack_price))

    def solve(self) -> tuple[FloatArray, int, bool, float]:
        iterations = 0
        while True:
            values, slacks = self._primal(self._active)
            row, sign, excess = self._worst(values, slacks)
            if excess <= TOLERANCE:
                return values, iterations, True, float(slacks.max())
            met, added = False, 0.0
            while not met:
                if iterations == self._calibration.iterations or len(self._active.rows) == MOST_ACTIVE:
                    values, slacks = self._primal(self._active.with_one(row, sign, added))
                    return values, iterations, False, float(slacks.max())
                iterations += 1
                met, added = self._step(row, sign, added)

    def _step(self, row: int, sign: float, added: float) -> tuple[bool, float]:
        """One dual step towards meeting that limit: whether it is met now, and its multiplier."""
        active = self._active
        larger = active.with_one(row, sign, added)
        coupling = self._coupling(larger)
        direction = np.linalg.solve(coupling[:-1, :-1], coupling[:-1, -1])
        rate = float(coupling[-1, -1] - coupling[-1, :-1] @ direction)
        values, slacks = self._primal(larger)
        full = self._excess(row, sign, values, slacks) / rate if rate > SINGULAR * coupling[-1, -1] else np.inf
        ratios = np.full(len(direction), np.inf)
        np.divide(active.multipliers, direction, out=ratios, where=direction > 0)
        blocking = int(ratios.argmin()) if len(ratios) else -1
        step = min(full, ratios[blocking] if len(ratios) else np.inf)
        if not np.isfinite(step):  # nothing would help: cannot be, for the slacks always do
            return True, added
        left = np.maximum(active.multipliers - step * direction, 0.0)
        moved = _Limits(active.rows, active.signs, left)
        if full <= step:
            self._active = moved.with_one(row, sign, added + step)
            return True, added + step
        self._active = moved.without(blocking)
        return False, added + step

    def _coupling(self, limits: _Limits) -> FloatArray:
        """How a multiplier of one limit moves another: normal' H⁻¹ normal, of each pair."""
        rows, axles = limits.rows, self._axles[limits.rows]
        same = (axles[:, None] == axles) & (axles != FORCE_ROW)
        signs = limits.signs[:, None] * limits.signs
        return np.asarray(signs * self._gram[np.ix_(rows, rows)] + self._calibration.slack_yield * same)

    def _primal(self, limits: _Limits) -> tuple[FloatArray, FloatArray]:
        """Row values (m,) and slacks (2,) that belong to these limits' multipliers."""
        m = len(self._free)
        values = self._free - self._gram[:m, limits.rows] @ (limits.signs * limits.multipliers)
        axles = self._axles[limits.rows]
        paid = np.array([limits.multipliers[axles == axle].sum() for axle in range(AXLES)])
        return values, self._calibration.slack_yield * (paid - self._calibration.slack_price)

    def _excess(self, row: int, sign: float, values: FloatArray, slacks: FloatArray) -> float:
        axle = self._axles[row]
        slack = 0.0 if axle == FORCE_ROW else float(slacks[axle])
        return float(sign * values[row] - self._calibration.bounds[row]) - slack if row < len(values) else -slack

    def _worst(self, values: FloatArray, slacks: FloatArray) -> tuple[int, float, float]:
        """Row and side of the limit that is broken most, and by how much."""
        m = len(values)
        axles = self._axles[:m]
        excess = (
            np.abs(values) - self._calibration.bounds - np.where(axles == FORCE_ROW, 0.0, slacks[np.maximum(axles, 0)])
        )
        row = int(excess.argmax())
        worst = row, float(np.sign(values[row])), float(excess[row])
        for axle in range(AXLES):
            if -slacks[axle] > worst[2] and m + axle not in self._active.rows:
                worst = m + axle, 0.0, float(-slacks[axle])
        return worst
