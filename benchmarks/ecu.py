"""What an operation of the ECU's controller costs on its processor, by emulation.

backend/ecu/effort.py has the result as CYCLES_PER_OPERATION and SPREAD, to which tests/unit/test_ecu_export.py
holds it.
"""

import struct
from contextlib import nullcontext

import numpy as np

from benchmarks.cortex_m3 import CortexM3, Spent
from sim_core import Scenario, simulate
from sim_core.ecu.calibration import Checked
from sim_core.ecu.program import CompiledEcu, Ecu, Frame, Reply
from sim_core.strategies.calibration import ecu_calibration
from sim_core.strategies.lv_hil import LvHil


class RecordedDrive(Ecu):
    """An ECU's program in a drive of `lv_hil`; `steps` has each frame, its reply and how many operations that took."""

    def __init__(self, scenario: Scenario, checked: Checked = "all") -> None:
        self.steps: list[tuple[Frame, Reply, int]] = []
        self.calibration = ecu_calibration(scenario, checked)
        self._program = CompiledEcu(self.calibration)
        simulate(scenario, LvHil(connect=lambda _: nullcontext(self), checked=checked))
        self.by_operations = sorted(range(1, len(self.steps)), key=lambda k: self.steps[k][2])

    def exchange(self, frame: Frame) -> Reply:
        """Answer a frame as the program does."""
        reply = self._program.exchange(frame)
        self.steps.append((frame, reply, reply.operations))
        return reply

    def emulated(self, machine: CortexM3, k: int) -> tuple[Spent, tuple[int, int]]:
        """Have an emulated processor answer frame k: what that took, and its commands."""
        frame = self.steps[k][0]
        before = np.array(self.steps[k - 1][1].commands if k else (0, 0)) * self.calibration.command_step
        machine.write("controller", machine.read("controller", 4) + struct.pack("<2f", *before))
        machine.write("ridelab_firmware_input", struct.pack("<i", frame.stage))
        machine.write("ridelab_codes", frame.codes.astype("<i4").tobytes())
        spent = machine.call("ridelab_firmware_step")
        front, rear = struct.unpack("<2i", machine.read("ridelab_firmware_output", 8))
        return spent, (front, rear)
