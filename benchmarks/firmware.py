"""The controller compiled for the control unit's own processor, by the package `ziglang`, and its memory there.

The part is of the STM32F103 class: Cortex-M3 at 72 MHz without floating-point hardware, 512 KB flash, 64 KB RAM
(STM32F103xE data sheet, DS5792). The service compiles nothing: backend/ecu/effort.py has what is found here.
"""

import struct
import subprocess
import sys
import tempfile
from collections.abc import Iterator
from dataclasses import dataclass
from pathlib import Path

from backend.ecu import export
from sim_core.ecu.calibration import Calibration
from sim_core.ecu.sources import CONTROLLER

FLASH, RAM = 0x08000000, 0x20000000  # stm32f103.ld
_COMMAND = (
    sys.executable, "-m", "ziglang", "cc",
    "-target", "thumb-freestanding-eabi", "-mcpu=cortex_m3", "-std=c99", "-O2", "-g0", "-ffp-contract=off",
    "-ffunction-sections", "-fdata-sections", "-Wall", "-Wextra", "-Werror",
    "-Wl,--gc-sections", "-Wl,-e,ridelab_firmware_step",
)  # fmt: skip


@dataclass(frozen=True, slots=True, eq=False, kw_only=True)
class Image:
    """A linked program: section name -> size in memory [bytes], symbol -> address, and its segments."""

    sections: dict[str, int]
    symbols: dict[str, int]
    segments: tuple[tuple[int, bytes], ...]

    @property
    def flash(self) -> int:
        """Code, constants and the initial values of variables [bytes]."""
        return sum(self.sections.get(name, 0) for name in (".text", ".rodata", ".data"))

    @property
    def ram(self) -> int:
        """Variables without the stack [bytes]."""
        return self.sections.get(".data", 0) + self.sections.get(".bss", 0)


def image(calibration: Calibration) -> Image:
    """Compile and link the controller with these tables.

    Raises:
        CalledProcessError: The compiler is not there, or fails.
    """
    with tempfile.TemporaryDirectory() as name:
        folder = Path(name)
        write_sources(folder, calibration)
        sources = [folder / source for source in (*CONTROLLER, "ridelab_tables.c", "target/ridelab_firmware.c")]
        program, script = folder / "firmware.elf", folder / "target" / "stm32f103.ld"
        options = [f"-I{folder}", *map(str, sources), f"-Wl,-T,{script}", "-o", str(program)]
        subprocess.run([*_COMMAND, *options], check=True)  # noqa: S603  # our own command, no shell
        return parsed(program.read_bytes())


def write_sources(folder: Path, calibration: Calibration) -> None:
    """Write an exported controller with these tables into a folder."""
    for name, text in export.files(calibration, "{}").items():
        (folder / name).parent.mkdir(exist_ok=True)
        (folder / name).write_text(text)


def parsed(content: bytes) -> Image:
    """An ELF file's sections and symbols (System V ABI, 32 bits, little-endian).

    Raises:
        ValueError: It is none.
    """
    if content[:6] != b"\x7fELF\x01\x01":
        raise ValueError("The linker wrote no ELF file")
    table = struct.unpack_from("<I", content, 32)[0]
    size, count, names = struct.unpack_from("<HHH", content, 46)
    headers = [struct.unpack_from("<10I", content, table + i * size) for i in range(count)]
    texts = headers[names]
    sections, segments = {}, []
    for head in headers:
        if head[2] & 2 and head[5]:  # it takes memory
            sections[_string(content, texts[4] + head[0])] = head[5]
            if head[1] != 8:  # and has content
                segments.append((head[3], content[head[4] : head[4] + head[5]]))
    symbols = {name: value for head in headers if head[1] == 2 for name, value in _symbols(content, headers, head)}
    return Image(sections=sections, symbols=symbols, segments=tuple(segments))


def _symbols(content: bytes, headers: list[tuple[int, ...]], head: tuple[int, ...]) -> Iterator[tuple[str, int]]:
    strings = headers[head[6]]
    for offset in range(head[4], head[4] + head[5], head[9]):
        name, value = struct.unpack_from("<II", content, offset)
        if name:
            yield _string(content, strings[4] + name), value & ~1


def _string(content: bytes, offset: int) -> str:
    return content[offset : content.index(b"\0", offset)].decode()
