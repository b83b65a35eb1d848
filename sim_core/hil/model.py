"""The ECU in NumPy and double precision: the same algorithm as the C program, and its reference in the tests.

It is written for clarity where the C is written for a small part: every iteration solves its equations anew.
"""

from collections.abc import Iterator
from contextlib import contextmanager

import numpy as np

from sim_core.half_car import DISTURBANCES, FORCES, STATES
from sim_core.hil.calibration import AXLES, FORCE_ROW, MOST_ACTIVE, Calibration, StageTables
from sim_core.hil.channels import highest_code
from sim_core.hil.ecu import Ecu, Frame, Reply
from sim_core.result import FloatArray

TOLERANCE = 1e-4  # a row may be so far beyond its limit [kN or cm]: 0.1 N, 1 µm
SINGULAR = 1e-6  # below this share of its own size a row depends on those that bind


@contextmanager
def modelled(calibration: Calibration) -> Iterator[Ecu]:
    """A `Connect` that needs no process."""
    yield ModelEcu(calibration)


class ModelEcu(Ecu):
    """Predict, law, checks, dual active-set iterations, converters."""

    def __init__(self, calibration: Calibration) -> None:
        self._known = calibration
        self._previous = np.zeros(FORCES)  # the last command [kN]
        self._steps = np.concatenate(
            [
                calibration.input_steps[:STATES],
                np.repeat(calibration.input_steps[STATES:], calibration.preview_length),
            ]
        )

    def exchange(self, frame: Frame) -> Reply:
        """Answer at once."""
        known = self._known
        values = frame.codes * self._steps
        state = values[:STATES]
        preview = values[STATES:].reshape(DISTURBANCES, known.preview_length)
        if known.predicts:
            state = known.A @ state + known.B @ self._previous + known.E @ preview[:, 0]
            preview = preview[:, 1:]
        rows, iterations, finished, slack = self.optimum(frame.stage, state, preview)
        limited = iterations > 0 or not finished
        force = np.clip(rows[:FORCES], -known.force_limit, known.force_limit)
        highest = highest_code(known.bits)
        codes = np.clip(np.trunc(force / known.command_step + np.copysign(0.5, force)), -highest, highest)
        self._previous = codes * known.command_step
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
        tables = self._known.stages[stage]
        given = np.concatenate([state, self._previous, preview.ravel()])
        return _Dual(self._known, tables, tables.rows @ given).solve()


class _Dual:
    """Goldfarb and Idnani (1983) on the rows alone. Limits: row j at ±bound + slack, and each slack at zero.

    An element is (row, sign), or (-1 - axle, 0) for a slack's own bound. Both of those bind at the start: the
    unconstrained slack is negative, as its linear price says.
    """

    def __init__(self, known: Calibration, tables: StageTables, values: FloatArray) -> None:
        self._known = known
        self._gram = tables.gram
        self._free = values
        self._axles = np.array(known.axles)
        self._active: list[tuple[int, int]] = [(-1 - axle, 0) for axle in range(AXLES)]
        self._multipliers = np.full(AXLES, known.slack_price)

    def solve(self) -> tuple[FloatArray, int, bool, float]:
        iterations = 0
        while True:
            values, slacks = self._primal(self._active, self._multipliers)
            worst, excess = self._worst(values, slacks)
            if excess <= TOLERANCE:
                return values, iterations, True, float(slacks.max())
            added = 0.0
            while True:
                if iterations == self._known.iterations or len(self._active) == MOST_ACTIVE:
                    values, slacks = self._primal([*self._active, worst], np.append(self._multipliers, added))
                    return values, iterations, False, float(slacks.max())
                iterations += 1
                done, added = self._step(worst, added)
                if done:
                    break

    def _step(self, worst: tuple[int, int], added: float) -> tuple[bool, float]:
        """One dual step towards meeting the worst limit; whether it is met now, and its multiplier."""
        active, multipliers = self._active, self._multipliers
        own = self._coupling([worst], [worst])[0, 0]
        to_active = self._coupling(active, [worst])[:, 0]
        direction = np.linalg.solve(self._coupling(active, active), to_active)
        rate = own - to_active @ direction
        values, slacks = self._primal([*active, worst], np.append(multipliers, added))
        excess = self._excess(worst, values, slacks)
        full = excess / rate if rate > SINGULAR * own else np.inf
        falling = direction > 0
        ratios = np.where(falling, multipliers / np.where(falling, direction, 1.0), np.inf)
        blocking = int(ratios.argmin()) if len(ratios) else 0
        step = min(full, ratios[blocking] if len(ratios) else np.inf)
        if not np.isfinite(step):  # no slack would help: cannot be, but must not loop
            return True, added
        self._multipliers = np.maximum(multipliers - step * direction, 0.0)
        added += step
        if step == full:
            self._active = [*active, worst]
            self._multipliers = np.append(self._multipliers, added)
            return True, added
        self._active = [item for i, item in enumerate(active) if i != blocking]
        self._multipliers = np.delete(self._multipliers, blocking)
        return False, added

    def _coupling(self, left: list[tuple[int, int]], right: list[tuple[int, int]]) -> FloatArray:
        """How a multiplier of one element moves another: normal' H⁻¹ normal, of each pair."""
        table = np.zeros((len(left), len(right)))
        for i, (row, sign) in enumerate(left):
            for j, (other, other_sign) in enumerate(right):
                if sign and other_sign:
                    table[i, j] = sign * other_sign * self._gram[row, other]
                if self._axle(row) == self._axle(other) != FORCE_ROW:
                    table[i, j] += self._known.slack_yield
        return table

    def _axle(self, row: int) -> int:
        return -1 - row if row < 0 else int(self._axles[row])

    def _primal(self, active: list[tuple[int, int]], multipliers: FloatArray) -> tuple[FloatArray, FloatArray]:
        """Row values and slacks that belong to multipliers."""
        values = self._free.copy()
        slacks = np.full(AXLES, -self._known.slack_price * self._known.slack_yield)
        for (row, sign), multiplier in zip(active, multipliers, strict=True):
            if sign:
                values -= sign * multiplier * self._gram[:, row]
            if self._axle(row) != FORCE_ROW:
                slacks[self._axle(row)] += multiplier * self._known.slack_yield
        return values, slacks

    def _excess(self, element: tuple[int, int], values: FloatArray, slacks: FloatArray) -> float:
        row, sign = element
        if not sign:
            return float(-slacks[self._axle(row)])
        axle = self._axle(row)
        return float(sign * values[row] - self._known.bounds[row] - (slacks[axle] if axle != FORCE_ROW else 0.0))

    def _worst(self, values: FloatArray, slacks: FloatArray) -> tuple[tuple[int, int], float]:
        """The limit that is broken most, and by how much."""
        soft = np.where(self._axles == FORCE_ROW, 0.0, slacks[np.maximum(self._axles, 0)])
        excess = np.abs(values) - self._known.bounds - soft
        row = int(excess.argmax())
        worst, most = (row, 1 if values[row] > 0 else -1), float(excess[row])
        for axle in range(AXLES):
            if -slacks[axle] > most and (-1 - axle, 0) not in self._active:
                worst, most = (-1 - axle, 0), float(-slacks[axle])
        return worst, most
