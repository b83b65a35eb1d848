"""The ECU's program in this process: its C (sim_core/ecu/source), compiled into the core's library."""

from contextlib import AbstractContextManager, nullcontext

import numpy as np

from sim_core.ecu.calibration import Calibration
from sim_core.ecu.channels import PREVIEW, highest_code
from sim_core.ecu.interface import Ecu, Frame, Reply
from sim_core.kernel import prepared
from sim_core.vehicle.half_car import FORCES, STATES


def in_process(calibration: Calibration) -> AbstractContextManager[Ecu]:
    """A `Connect` that needs neither process nor compiler."""
    return nullcontext(CompiledEcu(calibration))


class CompiledEcu(Ecu):
    """The program with these tables, in float32 as everywhere it runs: its answers are the same to the bit."""

    def __init__(self, tables: Calibration) -> None:
        self._codes = np.zeros(STATES + len(PREVIEW) * tables.preview_length, dtype=np.int32)
        self._answer, self._slack = np.zeros(prepared.ECU_ANSWER, dtype=np.int32), np.zeros(1, dtype=np.float32)
        sizes = tables.intervals, tables.preview_length, tables.row_count, tables.predicts, tables.iterations
        real = tables.command_step, tables.force_limit, tables.slack_price, tables.slack_yield
        vehicle = [part.ravel() for part in (tables.input_steps, tables.A, tables.B, tables.E)]
        self._step = prepared.ecu_step(
            sizes=np.array([*sizes, highest_code(tables.bits)], dtype=np.int32),
            real=np.array(real, dtype=np.float32),
            vehicle=np.concatenate(vehicle).astype(np.float32),
            bounds=tables.bounds.astype(np.float32),
            axles=np.array(tables.axles, dtype=np.int8),
            effects=np.array([stage.rows for stage in tables.stages], dtype=np.float32),
            gram=np.array([stage.gram for stage in tables.stages], dtype=np.float32),
            previous=np.zeros(FORCES, dtype=np.float32),
            codes=self._codes,
            answer=self._answer,
            slack=self._slack,
        )

    def exchange(self, frame: Frame) -> Reply:
        """Answer at once.

        Raises:
            ValueError: The frame has not as many codes as the tables say, or its stage is none.
        """
        if frame.codes.shape != self._codes.shape:
            raise ValueError("A frame has as many codes as the tables say")
        self._codes[:] = frame.codes
        self._step(frame.stage)
        front, rear, limited, iterations, unfinished = self._answer.tolist()
        return Reply(
            commands=(front, rear),
            limited=bool(limited),
            iterations=iterations,
            unfinished=bool(unfinished),
            slack=float(self._slack[0]),
        )
