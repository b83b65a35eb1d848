"""What an operation of the ECU's controller costs on its processor, by emulation: `python -m benchmarks.ecu`.

backend/ecu/effort.py has the result as CYCLES_PER_OPERATION and SPREAD, to which tests/unit/test_ecu_export.py
holds it.
"""

import struct
from contextlib import nullcontext

import numpy as np

from backend.ecu import effort
from benchmarks import firmware
from benchmarks.cortex_m3 import CortexM3, Spent
from sim_core import Mpc, Scenario, simulate
from sim_core.ecu.calibration import Checked
from sim_core.ecu.interface import Ecu, Frame, Reply
from sim_core.ecu.program import CompiledEcu
from sim_core.strategies.calibration import ecu_calibration
from sim_core.strategies.lv_hil import LvHil

SIZES: tuple[tuple[int, int, Checked], ...] = ((30, 20, "all"), (30, 20, "few"), (15, 10, "all"), (8, 4, "all"))
RANKS = (-1, -5, -20, -100)  # the busiest steps, from the end


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


def main() -> None:
    """Emulate quiet and busy steps of several controllers on a drive with tight limits."""
    ratios = []
    print("Np  Nc  limits  iterations  operations  instructions     cycles  cycles/operation  stack")
    for prediction, control, checked in SIZES:
        mpc = Mpc(prediction_horizon=prediction, control_horizon=control, force_limit=1500, deflection_limit=0.03)
        drive = RecordedDrive(Scenario(mpc=mpc), checked)
        image = firmware.image(drive.calibration)
        print(f"flash {image.flash}, RAM {image.ram} bytes; computed: {effort.memory(drive.calibration)}")
        machine = CortexM3(image)
        machine.call("ridelab_firmware_start")
        for k in (drive.by_operations[0], *(drive.by_operations[rank] for rank in RANKS)):
            _, reply, operations = drive.steps[k]
            spent, _ = drive.emulated(machine, k)
            ratios.append(spent.cycles / operations)
            print(
                f"{prediction:<4}{control:<4}{checked:<6}{reply.iterations:>12}{operations:>12}{spent.instructions:>14}"
                f"{spent.cycles:>11}{ratios[-1]:>18.1f}{spent.stack:>7}"
            )
    spread = max(abs(ratio / effort.CYCLES_PER_OPERATION - 1) for ratio in ratios)
    print(f"{effort.CYCLES_PER_OPERATION:g} cycles an operation are within {100 * spread:.0f} % of these")


if __name__ == "__main__":
    main()
