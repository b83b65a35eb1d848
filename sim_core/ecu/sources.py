"""The C sources of the ECU's program, how they are compiled, and what tells one program from another."""

import hashlib
from functools import cache
from pathlib import Path

SOURCES = Path(__file__).parent / "source"
CONTROLLER = ("ridelab_controller.c", "ridelab_dual.c")
# C99, every number a float32 rounded after each operation: all compilers then give the same bits.
FLAGS = ("-std=c99", "-O2", "-ffp-contract=off", "-DRIDELAB_COUNTED")


@cache
def program_hash() -> str:
    """SHA-256 of what is compiled for this machine, and how, in hexadecimal: a result of `lv_hil` depends on both."""
    digest = hashlib.sha256(repr(FLAGS).encode())
    for path in sorted([*SOURCES.glob("*.[ch]"), *SOURCES.glob("host/*.[ch]")]):
        digest.update(f"{path.relative_to(SOURCES).as_posix()}\0".encode() + path.read_bytes() + b"\0")
    return digest.hexdigest()
