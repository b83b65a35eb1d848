"""A clock that a test sets: the programs it starts with that environment ask it in place of the machine's."""

import os
import struct
import subprocess
from pathlib import Path

from sim_core.kernel.build import default_compiler

SOURCE = Path(__file__).with_name("clock.c")


class Clock:
    """The machine's clock, or ahead of it, or behind.

    Attributes:
        environment: Of the programs that have it.
        ahead: By how much [s].
    """

    def __init__(self, folder: Path) -> None:
        library, self._file = folder / "clock.so", folder / "clock"
        subprocess.run([*default_compiler(), "-shared", "-fPIC", "-o", library, SOURCE], check=True)
        self.environment = {"LD_PRELOAD": str(library), "CLOCK_FILE": str(self._file)}
        self._file.write_bytes(bytes(8))
        self.set(0)

    def set(self, ahead: int) -> None:
        """Let it jump."""
        self.ahead = ahead
        with self._file.open("r+b") as file:  # as it is mapped, it stays the same file
            os.pwrite(file.fileno(), struct.pack("q", ahead), 0)
