"""C sources compiled to programs and cached by content; any machine that runs Ridelab can build them."""

import hashlib
import importlib.util
import os
import platform
import shutil
import stat
import subprocess
import sys
import tempfile
from collections.abc import Sequence
from functools import cache
from pathlib import Path

from backend.command_error import CommandError
from sim_core.ecu.sources import CONTROLLER, SOURCES

# C99, every number a float32 rounded after each operation: all compilers then give the same bits.
FLAGS = ("-std=c99", "-O2", "-ffp-contract=off", "-DRIDELAB_COUNTED")
COMPILER_TIMEOUT = 80.0  # for the compiler; the first time ziglang builds its own runtime [s]
FOLDER = "RIDELAB_ECU_DIR"
# The package is a C compiler that builds for the control unit too; the target is that of a checkout.
REMEDY = "make compiler" if (Path(__file__).parents[2] / "Makefile").is_file() else "pip install ziglang"
NO_COMPILER = f"There is no C compiler to build the ECU's program: install one (gcc, clang) or run “{REMEDY}”"
TOO_LONG = "the compiler took too long"
NO_CROSS_COMPILER = f"There is no compiler for the control unit's processor, a Cortex-M3: run “{REMEDY}”"


class EcuError(CommandError):
    """The ECU's program cannot be built or does not work."""


def folder() -> Path:
    """The folder of built programs: the operator's, else one that nobody else may write to.

    Raises:
        EcuError: There is no such folder.
    """
    named = os.environ.get(FOLDER)
    if not named:
        return _own_folder()
    path = Path(named)
    try:
        path.mkdir(parents=True, exist_ok=True)
    except OSError as error:
        raise EcuError(f"There is no folder for the ECU's program: {error.strerror}") from None
    return path


def compiler_cache() -> Path:
    """The folder of the compiler's own cache, inside that of the programs if it can be written.

    Raises:
        EcuError: There is no such folder.
    """
    programs = folder()
    return (programs if os.access(programs, os.W_OK) else _own_folder()) / "zig"


def _own_folder() -> Path:
    path = Path(tempfile.gettempdir()) / f"ridelab-ecu-{os.getuid()}"
    try:
        path.mkdir(mode=0o700, exist_ok=True)
        status = path.lstat()
    except OSError as error:
        raise EcuError(f"There is no folder for the ECU's program: {error.strerror}") from None
    if status.st_uid != os.getuid() or not stat.S_ISDIR(status.st_mode) or stat.S_IMODE(status.st_mode) & 0o022:
        raise EcuError(f"The folder for the ECU's program is somebody else's; name one in {FOLDER}")
    return path


def compilers() -> list[list[str]]:
    """C compilers for this machine in the order they are tried: its own, else that of the package `ziglang`."""
    own = [[path] for name in ("cc", "gcc", "clang") if (path := shutil.which(name))]
    return [*own[:1], zig()] if has_zig() else own[:1]


def has_zig() -> bool:
    """Check whether the package `ziglang` is installed."""
    return importlib.util.find_spec("ziglang") is not None


def zig() -> list[str]:
    """The C compiler of the package `ziglang`."""
    return [sys.executable, "-m", "ziglang", "cc"]


_PROGRAM = [SOURCES / name for name in (*CONTROLLER, "host/ridelab_main.c", "host/ridelab_loaded.c")]
_HEADERS = [SOURCES, SOURCES / "host"]


@cache
def program() -> Path:
    """The ECU's program for this machine, which loads its tables; built where it is not there yet.

    Raises:
        EcuError: There is no working C compiler.
    """
    return built(_PROGRAM, _HEADERS)


def program_fault() -> str | None:
    """Return why the ECU's program is neither there nor can be built; None where it is or may be."""
    return None if compilers() or _target(_PROGRAM, _HEADERS).is_file() else NO_COMPILER


def firmware_fault() -> str | None:
    """Return why nothing can be built for the control unit's processor; None where it may be."""
    return None if has_zig() else NO_CROSS_COMPILER


def built(sources: Sequence[Path], include: Sequence[Path]) -> Path:
    """The program of these sources, built where it is not cached.

    Raises:
        EcuError: There is no working C compiler.
    """
    target = _target(sources, include)
    if target.is_file():
        return target
    options = [*FLAGS, *(f"-I{place}" for place in include), *map(str, sources)]
    reasons = []
    for compiler in compilers():
        try:
            with tempfile.TemporaryDirectory(dir=target.parent) as beside:
                program = Path(beside) / "program"
                reason = compiled([*compiler, *options, "-o", str(program)], compiler_cache())
                if reason is None:
                    program.replace(target)  # at once, whoever else builds it too
                    return target
        except OSError as error:
            reason = f"its folder cannot be written ({error.strerror})"
        reasons.append(reason)
    if not reasons:
        raise EcuError(NO_COMPILER)
    other = "" if has_zig() else f"; “{REMEDY}” installs another compiler"
    raise EcuError(f"The ECU's program cannot be built: {'; '.join(reasons)}{other}")


def _target(sources: Sequence[Path], include: Sequence[Path]) -> Path:
    """Return the file in which the program of these sources is cached."""
    texts = [path.read_bytes() for path in sources]
    texts += [path.read_bytes() for place in include for path in sorted(place.glob("*.h"))]
    content = hashlib.sha256(repr([platform.system(), platform.machine(), FLAGS, texts]).encode()).hexdigest()
    return folder() / f"ridelab_ecu-{content[:24]}"


def compiled(command: Sequence[str], cache: Path, timeout: float = COMPILER_TIMEOUT) -> str | None:
    """Run a compiler for so many seconds at most; None, or why it failed.

    Its cache has the runtimes of systems and so does not grow; what it makes of each controller is removed.
    """
    try:
        with tempfile.TemporaryDirectory(ignore_cleanup_errors=True) as objects:
            run = subprocess.run(  # noqa: S603  # our own command, no shell
                command,
                cwd=cache.parent,  # from elsewhere ziglang would build its runtimes again: it names files from there
                env=os.environ | {"ZIG_GLOBAL_CACHE_DIR": str(cache), "ZIG_LOCAL_CACHE_DIR": objects},
                capture_output=True,
                text=True,
                timeout=timeout,
                check=False,
            )
    except subprocess.TimeoutExpired:
        return TOO_LONG
    except OSError as error:
        return f"the compiler does not start ({error.strerror})"
    if run.returncode == 0:
        return None
    lines = run.stderr.strip().splitlines()
    said = next((line for line in lines if "error" in line), *lines[:1] or [str(run.returncode)])
    return f"the compiler failed ({said[:200]})"
