"""The C sources of the ECU's program, and what tells one program from another."""

import hashlib
from functools import cache
from pathlib import Path

from sim_core.kernel.build import FLAGS

SOURCES = Path(__file__).parent / "source"
CONTROLLER = ("ridelab_controller.c", "ridelab_dual.c")


@cache
def program_hash() -> str:
    """SHA-256 of what the core's library has of the program, and how, in hexadecimal: it computes `lv_hil`."""
    digest = hashlib.sha256(repr(FLAGS).encode())
    for path in sorted(SOURCES.glob("*.[ch]")):
        digest.update(f"{path.name}\0".encode() + path.read_bytes() + b"\0")
    return digest.hexdigest()
