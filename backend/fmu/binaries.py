"""An FMU's sources compiled for each platform: for Linux by this machine's own compiler, else by `ziglang`."""

import hashlib
import platform
import sys
import tempfile
from collections.abc import Mapping, Sequence
from pathlib import Path
from time import monotonic

from backend.ecu.build import TOO_LONG, EcuError, compiled, compiler_cache, compilers, has_zig, zig
from backend.fmu.description import Version

# By the name that FMI 2.0 has: that of 3.0, the ending, ziglang's target.
PLATFORMS = {
    "linux64": ("x86_64-linux", ".so", "x86_64-linux-gnu.2.17"),
    "win64": ("x86_64-windows", ".dll", "x86_64-windows-gnu"),
    "darwin64": ("x86_64-darwin", ".dylib", "x86_64-macos"),
}
TIME = 70.0  # for all of them: less than a worker's task may take [s]
CACHED = 12  # binaries made last that a worker has at hand, of some 100 kB
_compiled: dict[bytes, bytes] = {}  # by the digest of sources and target
# As the core's C: without fused operations all compilers give the same numbers. Only FMI's functions can be seen.
_FLAGS = ("-std=c11", "-O2", "-g0", "-ffp-contract=off", "-fvisibility=hidden", "-shared")


def binaries(
    name: str, sources: Mapping[str, str], files: Sequence[str], version: Version, platforms: Sequence[str]
) -> tuple[dict[str, bytes], dict[str, str]]:
    """The binaries by their path in the FMU, and by platform why there is none.

    Args:
        name: Of the model.
        sources: C text by file name.
        files: Those that are compiled.
        version: Of FMI.
        platforms: Of PLATFORMS, those that are wanted.
    """
    built, missing, end = {}, {}, monotonic() + TIME
    with tempfile.TemporaryDirectory() as place:
        folder = Path(place)
        for file, text in sources.items():
            (folder / file).write_text(text, encoding="utf-8")
        for wanted in platforms:
            fmi3, ending, target = PLATFORMS[wanted]
            output = folder / f"{name}{ending}"
            digest = hashlib.sha256(repr((name, target, files, sorted(sources.items()))).encode()).digest()
            if digest not in _compiled:
                reason = _built(_compiler(wanted, target), [folder / file for file in files], output, end)
                if reason is not None:
                    missing[wanted] = reason
                    continue
                _compiled[digest] = output.read_bytes()
            built[f"binaries/{wanted if version == '2.0' else fmi3}/{name}{ending}"] = _compiled[digest]
    for oldest in list(_compiled)[:-CACHED]:
        del _compiled[oldest]
    return built, missing


def _compiler(wanted: str, target: str) -> list[str] | None:
    own = compilers()
    if wanted == "linux64" and own and (sys.platform, platform.machine()) == ("linux", "x86_64"):
        return own[0]
    return [*zig(), "-target", target] if has_zig() else None


def _built(compiler: Sequence[str] | None, files: Sequence[Path], output: Path, end: float) -> str | None:
    """None, or why it was not."""
    if compiler is None:
        return "the package ziglang is not installed where it was made"
    flags = [*_FLAGS, *(() if output.suffix == ".dll" else ("-fPIC",))]
    command = [*compiler, *flags, "-o", str(output), *map(str, files), "-lm"]
    try:
        reason = compiled(command, compiler_cache(), max(1.0, end - monotonic()))
    except EcuError as error:
        return str(error)
    # It begins by building the other system's C library, and keeps what it has built of it.
    return f"{reason}; the first time it needs a minute or more, so ask again" if reason == TOO_LONG else reason
