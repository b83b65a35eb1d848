"""What a call of the controller costs on a Cortex-M3 without floating-point hardware.

The program counts its operations itself (sim_core/ecu/source/ridelab_count.h). What one costs was measured by running
the compiled controller in an emulator that counts cycles as the processor's manual does: `make ecu` prints it again, a
test holds the factor to it.
"""

from dataclasses import dataclass


@dataclass(frozen=True, slots=True, kw_only=True)
class Part:
    """A microcontroller: clock [Hz], memories [bytes], and the stack kept free for the controller [bytes]."""

    name: str
    clock: float
    flash: int
    ram: int
    stack: int


STM32F103 = Part(
    name="STM32F103xE: Cortex-M3, 72 MHz, no floating-point hardware",
    clock=72e6,
    flash=512 * 1024,
    ram=64 * 1024,
    stack=1024,  # the emulator saw 520
)
CYCLES_PER_OPERATION = 206.0  # multiplication and addition in software, with the table's read and two wait states
SPREAD = 0.17  # of the emulated cycles around that


def seconds(operations: float, part: Part = STM32F103) -> float:
    """Time of so many operations [s]."""
    return operations * CYCLES_PER_OPERATION / part.clock
