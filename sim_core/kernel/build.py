"""Compile the core's C into a library: `python sim_core/kernel/build.py FILE`, which needs nothing but a C compiler.

setup.py and the image run this script, so that sources and flags are stated here alone.
"""

import hashlib
import importlib.util
import os
import shlex
import shutil
import subprocess
import sys
from pathlib import Path

FOLDER = Path(__file__).resolve().parent
_ECU = FOLDER.parent / "ecu" / "source"
_OWN = sorted(FOLDER.glob("*.c"))  # none in a wheel, which has the library alone
SOURCES = [*_OWN, _ECU / "ridelab_controller.c", _ECU / "ridelab_dual.c"] if _OWN else []
HEADERS = [*sorted(FOLDER.glob("*.h")), *sorted(_ECU.glob("*.h"))]
# No compiler's extensions. Without fused operations all compilers give the same numbers.
FLAGS = ("-std=c11", "-pedantic-errors", "-O3", "-ffp-contract=off")


def digest() -> str:
    """SHA-256 of the sources and flags, in hexadecimal: the library says of which it is."""
    content = hashlib.sha256(repr(FLAGS).encode())
    for file in (*SOURCES, *HEADERS):
        content.update(f"\0{file.name}\0".encode() + file.read_bytes())
    return content.hexdigest()


def default_compiler() -> list[str]:
    """What CC names, else the machine's compiler, else that of the package ziglang.

    Raises:
        FileNotFoundError: There is none.
    """
    if "CC" in os.environ:
        return shlex.split(os.environ["CC"])
    installed = next((path for name in ("cc", "gcc", "clang") if (path := shutil.which(name))), None)
    if installed:
        return [installed]
    if importlib.util.find_spec("ziglang") is None:
        raise FileNotFoundError("There is no C compiler: install gcc or clang, or with pip the package ziglang")
    return [sys.executable, "-m", "ziglang", "cc"]


def command(compiler: list[str], library: Path, *options: str) -> list[str]:
    """What compiles the library.

    Args:
        compiler: Its command.
        library: The file to write.
        options: Beside FLAGS.
    """
    identity = f'-DRIDELAB_DIGEST="{digest()}"'
    return [*compiler, *FLAGS, identity, *options, "-shared", "-o", str(library), *map(str, SOURCES), "-lm"]


if __name__ == "__main__":
    sys.exit(subprocess.call(command(default_compiler(), Path(sys.argv[1]), "-fPIC")))  # noqa: S603  # no shell
