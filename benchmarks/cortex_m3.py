"""Counts what a Cortex-M3 spends on a call, by emulation: instructions, and cycles as its manual has them.

Cycles: ARM DDI 0337E, chapter 18 (instruction timings), the longer figure where it has two; on an STM32F103 at 72 MHz
the flash needs two wait states (RM0008, 3.3.3), counted for every datum read from flash and every branch taken, for
the prefetch buffer covers code in a line. Interrupts and DMA are not in it.
"""

import struct
from dataclasses import dataclass
from typing import Any

import unicorn
from unicorn import arm_const

from benchmarks.firmware import FLASH, RAM, Image

WAIT_STATES = 2
_SIZE = 16 * 1024 * 1024
_STACK = RAM + _SIZE
_RETURN = 0x30000000  # where the call comes back to: nothing is there, and the emulator stops


@dataclass(frozen=True, slots=True, kw_only=True)
class Spent:
    """One call: what it returned, instructions, cycles, and its deepest stack [bytes]."""

    result: int
    instructions: int
    cycles: int
    stack: int


class CortexM3:
    """A processor with an image in its flash; memory lasts from call to call."""

    def __init__(self, image: Image) -> None:
        self._image = image
        self._machine = unicorn.Uc(unicorn.UC_ARCH_ARM, unicorn.UC_MODE_THUMB | unicorn.UC_MODE_MCLASS)
        self._machine.ctl_set_cpu_model(arm_const.UC_CPU_ARM_CORTEX_M3)
        for base in (FLASH, RAM):
            self._machine.mem_map(base, _SIZE)
        self._machine.mem_map(_RETURN, 0x1000)
        for address, content in image.segments:
            self._machine.mem_write(address, content)
        self._blocks: dict[int, tuple[int, int]] = {}
        self._instructions = self._cycles = 0
        self._expected = -1
        self._lowest = _STACK
        self._machine.hook_add(unicorn.UC_HOOK_BLOCK, self._block)
        self._machine.hook_add(unicorn.UC_HOOK_MEM_READ, self._read, begin=FLASH, end=FLASH + _SIZE)
        self._machine.hook_add(unicorn.UC_HOOK_MEM_WRITE, self._write, begin=_STACK - 65536, end=_STACK)

    def call(self, name: str) -> Spent:
        """Call a function without arguments."""
        self._instructions = self._cycles = 0
        self._expected, self._lowest = -1, _STACK
        self._machine.reg_write(arm_const.UC_ARM_REG_SP, _STACK)
        self._machine.reg_write(arm_const.UC_ARM_REG_LR, _RETURN | 1)
        self._machine.emu_start(self._image.symbols[name] | 1, _RETURN)
        result = self._machine.reg_read(arm_const.UC_ARM_REG_R0)
        return Spent(
            result=struct.unpack("<i", struct.pack("<I", result))[0],
            instructions=self._instructions,
            cycles=self._cycles,
            stack=_STACK - self._lowest,
        )

    def write(self, name: str, content: bytes) -> None:
        """Fill a variable."""
        self._machine.mem_write(self._image.symbols[name], content)

    def read(self, name: str, length: int) -> bytes:
        """A variable's content."""
        return bytes(self._machine.mem_read(self._image.symbols[name], length))

    def _block(self, machine: Any, address: int, size: int, _: Any) -> None:
        cost = self._blocks.get(address)
        if cost is None:
            cost = self._blocks[address] = measured(bytes(machine.mem_read(address, size)))
        count, cycles = cost
        self._instructions += count
        self._cycles += cycles
        if address != self._expected:
            self._cycles += 2 + WAIT_STATES  # the branch that led here: the pipeline is filled anew
        self._expected = address + size

    def _read(self, *_: Any) -> None:
        self._cycles += WAIT_STATES

    def _write(self, _machine: Any, _access: int, address: int, *_: Any) -> None:
        self._lowest = min(self._lowest, address)


def measured(code: bytes) -> tuple[int, int]:
    """Instructions of straight Thumb code, and their cycles where no branch is taken."""
    halves = struct.unpack(f"<{len(code) // 2}H", code)
    count = cycles = offset = 0
    while offset < len(halves):
        first = halves[offset]
        wide = first >> 11 in (0b11101, 0b11110, 0b11111)
        cycles += _wide(first, halves[offset + 1]) if wide else _narrow(first)
        offset += 2 if wide else 1
        count += 1
    return count, cycles


def _narrow(half: int) -> int:
    if half >> 12 == 0b1100 or (half >> 12 == 0b1011 and half >> 9 & 0b11 == 0b10):  # LDM, STM, PUSH, POP
        return 1 + (half & 0x1FF if half >> 12 == 0b1011 else half & 0xFF).bit_count()
    loads = half >> 11 == 0b01001 or half >> 12 in (0b0101, 0b0110, 0b0111, 0b1000, 0b1001)
    return 2 if loads else 1


def _wide(first: int, second: int) -> int:
    if first >> 9 == 0b1110100:
        return 3 if first & 0x40 else 1 + second.bit_count()  # LDRD, STRD and table branches; LDM, STM
    if first >> 9 == 0b1111100:  # loads and stores
        return 2
    if first >> 7 == 0b111110111:  # long multiplications and divisions
        operation = first >> 4 & 0b111
        return {0b001: 12, 0b011: 12, 0b000: 5, 0b010: 5}.get(operation, 7)
    if first >> 7 == 0b111110110:  # multiplications, with addition where the accumulator is a register
        return 1 if second >> 12 == 0b1111 else 2
    return 1
