"""What the controller takes of a Cortex-M3 without floating-point hardware: memory, and the time of one call.

The compiled program is the same for every scenario: its tables and the memory that it works in are data beside it. So
its size is measured once, and so is what an operation costs, by running the program in an emulator that counts cycles
as the processor's manual does; the program counts its operations itself (sim_core/ecu/source/ridelab_count.h). Tests
hold memory to a real compilation and the cycles to the emulator.
"""

from backend.ecu import tables
from backend.ecu.models import ControllerPart
from sim_core.ecu.calibration import Calibration

STM32F103 = ControllerPart(
    name="STM32F103xE: Cortex-M3, 72 MHz, no floating-point hardware",
    clock=72e6,
    flash=512 * 1024,
    ram=64 * 1024,
    stack=1024,  # the emulator saw 528
)
CYCLES_PER_OPERATION = 206.0  # multiplication and addition in software, with the table's read and two wait states
SPREAD = 0.17  # of the emulated cycles around that
CODE = 10_072  # with the compiler's arithmetic, by clang for thumbv7m with -O2 [bytes]
_OWN_CONSTANTS, _OWN_VARIABLES = 120, 84  # beside tables and working memory [bytes]
_NUMBER = 4  # of float32 and int32, and of a limit that binds [bytes]


def constants(calibration: Calibration) -> int:
    """Return the flash that tables take [bytes]."""
    aligned_axles = -(-calibration.row_count // _NUMBER) * _NUMBER
    return _OWN_CONSTANTS + _NUMBER * sum(values.size for values in calibration.arrays.values()) + aligned_axles


def variables(calibration: Calibration) -> int:
    """Return the RAM that a controller takes without its stack [bytes]."""
    working = tables.code_count(calibration) + calibration.most_active + tables.work_count(calibration)
    return _OWN_VARIABLES + _NUMBER * working


def seconds(operations: float, part: ControllerPart = STM32F103) -> float:
    """Return the time of so many operations [s]."""
    return operations * CYCLES_PER_OPERATION / part.clock
