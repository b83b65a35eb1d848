"""Compile the core's C into libraries: `python sim_core/kernel/build.py FOLDER`, which needs nothing but a C compiler.

setup.py and the image run this script, so that sources and flags are stated here alone.
"""

import hashlib
import importlib.util
import os
import platform
import shlex
import shutil
import sys
from pathlib import Path

FOLDER = Path(__file__).resolve().parent
_ECU = FOLDER.parent / "ecu" / "source"
SOURCES = sorted(FOLDER.glob("*.c"))  # with those of the ECU, which they include
INCLUDED = [*sorted(FOLDER.glob("*.h")), *sorted(_ECU.glob("*.[ch]"))]
# No compiler's extensions. Without fused operations all compilers give the same numbers.
FLAGS = ("-std=c11", "-pedantic-errors", "-O3", "-ffp-contract=off")
NAME = "libridelab.so.1"  # no Python module, so not called like one
WIDE_NAME = "libridelab-avx2.so.1"  # the same for processors with AVX2: the same numbers, a fifth sooner
X86_64 = ("x86_64", "AMD64")
_PROCESSOR = Path("/proc/cpuinfo")


def digest() -> str:
    """SHA-256 of the sources and flags, in hexadecimal: the library says of which it is."""
    content = hashlib.sha256(repr(FLAGS).encode())
    for file in (*SOURCES, *INCLUDED):
        content.update(f"\0{file.name}\0".encode() + file.read_bytes())
    return content.hexdigest()


def is_current(library: Path) -> bool:
    """Check whether a library is compiled from these sources with these flags, for the machine that asks."""
    content = library.read_bytes() if library.exists() else b""
    return digest().encode() in content and f"{_target([])}\0".encode() in content


def default_compiler() -> list[str]:
    """Return what CC names, else the machine's compiler, else that of the package ziglang.

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


def best() -> Path:
    """Return the library that is made for this processor."""
    wide = FOLDER / WIDE_NAME
    has_avx2 = wide.exists() and _PROCESSOR.exists() and " avx2 " in _PROCESSOR.read_text()
    return wide if has_avx2 else FOLDER / NAME


def libraries(compiler: list[str]) -> dict[str, tuple[str, ...]]:
    """Return the libraries that a compiler makes: name -> options of its own."""
    target = _target(compiler)
    own = ("-s",) if "windows" in target else ("-fPIC",)
    wide = {WIDE_NAME: (*own, "-mavx2")} if target.startswith(X86_64) else {}
    return {NAME: own, **wide}


def _target(compiler: list[str]) -> str:
    """Return the machine it compiles for."""
    own = f"{platform.machine()}-{platform.system()}"
    return compiler[compiler.index("-target") + 1] if "-target" in compiler else own


def command(compiler: list[str], library: Path, *options: str) -> list[str]:
    """Return what compiles the library.

    Args:
        compiler: Its command.
        library: The file to write.
        options: Beside FLAGS.
    """
    identity = [f'-DRIDELAB_DIGEST="{digest()}"', f'-DRIDELAB_MACHINE="{_target(compiler)}"']
    return [*compiler, *FLAGS, *identity, *options, "-shared", "-o", str(library), *map(str, SOURCES), "-lm"]


if __name__ == "__main__":
    import subprocess  # here: whoever imports the core needs the digest alone

    compiler = default_compiler()
    for name, options in libraries(compiler).items():
        subprocess.run(command(compiler, Path(sys.argv[1], name), *options), check=True)  # noqa: S603  # no shell
