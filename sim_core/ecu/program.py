"""The ECU's program in this process: its C (sim_core/ecu/source), compiled into the core's library."""

from collections.abc import Iterator
from contextlib import contextmanager

import numpy as np

from sim_core.ecu.calibration import Calibration
from sim_core.ecu.channels import PREVIEW, highest_code
from sim_core.ecu.interface import Ecu, Frame, Reply
from sim_core.kernel import prepared
from sim_core.vehicle.half_car import FORCES, STATES


@contextmanager
def in_process(calibration: Calibration) -> Iterator[Ecu]:
    """A `Connect` that needs neither process nor compiler."""
    yield CompiledEcu(calibration)


class CompiledEcu(Ecu):
    """The program with these tables, in float32 as everywhere it runs: its answers are the same to the bit."""

    def __init__(self, calibration: Calibration) -> None:
        known = calibration
        self._codes = np.zeros(STATES + len(PREVIEW) * known.preview_length, dtype=np.int32)
        self._answer, self._slack = np.zeros(prepared.ECU_ANSWER, dtype=np.int32), np.zeros(1, dtype=np.float32)
        sizes = known.intervals, known.preview_length, known.row_count, known.predicts, known.iterations
        real = known.command_step, known.force_limit, known.slack_price, known.slack_yield
        vehicle = [part.ravel() for part in (known.input_steps, known.A, known.B, known.E)]
        self._step = prepared.ecu_step(
            sizes=np.array([*sizes, highest_code(known.bits)], dtype=np.int32),
            real=np.array(real, dtype=np.float32),
            vehicle=np.concatenate(vehicle).astype(np.float32),
            bounds=known.bounds.astype(np.float32),
            axles=np.array(known.axles, dtype=np.int8),
            effects=np.array([stage.rows for stage in known.stages], dtype=np.float32),
            gram=np.array([stage.gram for stage in known.stages], dtype=np.float32),
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
