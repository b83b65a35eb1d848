"""The cost of one call of the controller on a Cortex-M3 without floating-point hardware.

The program counts its operations itself (sim_core/ecu/source/ridelab_count.h). What one costs was measured by running
the compiled controller in an emulator that counts cycles as the processor's manual does: `make ecu` prints it again, a
test holds the factor to it.
"""

from backend.ecu.models import ControllerPart

STM32F103 = ControllerPart(
    name="STM32F103xE: Cortex-M3, 72 MHz, no floating-point hardware",
    clock=72e6,
    flash=512 * 1024,
    ram=64 * 1024,
    stack=1024,  # the emulator saw 520
)
CYCLES_PER_OPERATION = 206.0  # multiplication and addition in software, with the table's read and two wait states
SPREAD = 0.17  # of the emulated cycles around that


def seconds(operations: float, part: ControllerPart = STM32F103) -> float:
    """Time of so many operations [s]."""
    return operations * CYCLES_PER_OPERATION / part.clock
