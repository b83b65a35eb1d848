"""What the loop needs of an ECU, and its program in this process: C (sim_core/ecu/source) in the core's library."""

from abc import ABC, abstractmethod
from collections.abc import Callable
from contextlib import AbstractContextManager, nullcontext
from dataclasses import dataclass

import numpy as np

from sim_core.ecu.calibration import Calibration
from sim_core.ecu.channels import PREVIEW, STAGES, Codes, highest_code
from sim_core.kernel.library import INT, Array, Function, require
from sim_core.vehicle.half_car import FORCES, STATES

_ANSWER = 6  # whole numbers
_REALS = Array(ndim=1, dtype=np.float32)
_TABLES = Array(ndim=3, dtype=np.float32)
_ecu_step = Function(
    "ecu_step",
    *(Array(7, dtype=np.int32), Array(3, dtype=np.float32), Array(115, dtype=np.float32), _REALS),
    *(Array(ndim=1, dtype=np.int8), _TABLES, _TABLES),
    *(Array(FORCES, dtype=np.float32, written=True), Array(ndim=1, dtype=np.int32)),
    *(Array(_ANSWER, dtype=np.int32, written=True), Array(1, dtype=np.float32, written=True), INT),
    result=INT,
)


@dataclass(frozen=True, slots=True, eq=False, kw_only=True)
class Frame:
    """One control step's measurements: codes (8 + 3 · preview_length,), the stage's number in channels.STAGES."""

    step: int
    stage: int
    codes: Codes


@dataclass(frozen=True, slots=True, kw_only=True)
class Reply:
    """The ECU's answer.

    Attributes:
        commands: Codes of both forces.
        limited: Whether a limit shaped them.
        iterations: Of the solver.
        unfinished: The solver stopped before it was done; the forces are clipped.
        slack: Largest predicted deflection beyond the limit [cm].
        operations: Floating-point operations that it took, a multiplication with its addition being one; 0 where they
            are not counted.
            are not counted.
    """

    commands: tuple[int, int]
    limited: bool
    iterations: int
    unfinished: bool
    slack: float
    operations: int = 0


class Ecu(ABC):
    """One run's ECU. Its memory, the last command, starts at zero."""

    @abstractmethod
    def exchange(self, frame: Frame) -> Reply | None:
        """Answer one frame; None where no answer came in time."""


Connect = Callable[[Calibration], AbstractContextManager[Ecu]]


def in_process(calibration: Calibration) -> AbstractContextManager[Ecu]:
    """Return a `Connect` that needs neither process nor compiler."""
    return nullcontext(CompiledEcu(calibration))


class CompiledEcu(Ecu):
    """The program with these tables, in float32 as everywhere it runs: its answers are the same to the bit.

    Raises:
        ValueError: Sizes disagree.
    """

    def __init__(self, tables: Calibration) -> None:
        rows, columns = tables.row_count, STATES + FORCES + len(PREVIEW) * tables.intervals
        effects = np.array([stage.rows for stage in tables.stages], dtype=np.float32)
        gram = np.array([stage.gram for stage in tables.stages], dtype=np.float32)
        fits = effects.shape == (len(STAGES), rows, columns) and gram.shape == (len(STAGES), rows, rows)
        require(fits and len(tables.axles) == rows, "Tables of every stage, with a bound for each row")
        self._codes = np.zeros(STATES + len(PREVIEW) * tables.preview_length, dtype=np.int32)
        self._answer, self._slack = np.zeros(_ANSWER, dtype=np.int32), np.zeros(1, dtype=np.float32)
        sizes = tables.intervals, tables.preview_length, rows, tables.predicts, tables.iterations
        real = tables.command_step, tables.slack_price, tables.inverse_slack_weight
        vehicle = [part.ravel() for part in (tables.input_steps, tables.A, tables.B, tables.E)]
        self._step = _ecu_step.bind(  # kernel/ecu.c says what they hold
            np.array([*sizes, highest_code(tables.bits), tables.most_active], dtype=np.int32),
            np.array(real, dtype=np.float32),
            np.concatenate(vehicle).astype(np.float32),
            tables.bounds.astype(np.float32),
            np.array(tables.axles, dtype=np.int8),
            effects,
            gram,
            np.zeros(FORCES, dtype=np.float32),
            self._codes,
            self._answer,
            self._slack,
        )

    def exchange(self, frame: Frame) -> Reply:
        """Answer at once.

        Raises:
            ValueError: The frame has not as many codes as the tables say, its stage is none, or the program has not the
                memory for the tables.
        """
        require(frame.codes.shape == self._codes.shape, "A frame has as many codes as the tables say")
        self._codes[:] = frame.codes
        require(self._step(frame.stage) == 0, "The ECU's program knows no such tables or stage")
        front, rear, limited, iterations, unfinished, operations = self._answer.tolist()
        return Reply(
            commands=(front, rear),
            limited=bool(limited),
            iterations=iterations,
            unfinished=bool(unfinished),
            slack=float(self._slack[0]),
            operations=operations,
        )
