"""The programs of FMUs, one for each kind, version of FMI and platform: `python backend/fmu/programs.py` compiles them.

Without words that of this machine's platform, with its own compiler; with `all` those of every platform, by the package
ziglang. All numbers are in an FMU's resources, so that nothing is compiled when one is exported. The script needs
nothing but Python and a compiler: the image and `make` run it before the packages are there.
"""

import hashlib
import importlib.util
import platform
import runpy
import subprocess
import sys
from concurrent.futures import ThreadPoolExecutor
from functools import cache
from pathlib import Path
from tempfile import TemporaryDirectory
from typing import NamedTuple

FOLDER = Path(__file__).resolve().parent
ROOT = FOLDER.parents[1]
BINARIES = FOLDER / "binaries"
_CONTROLLER = ("ridelab_tables.h", "ridelab_count.h", "ridelab_dual.h", "ridelab_controller.h",
               "ridelab_controller.c", "ridelab_dual.c")  # fmt: skip
_CAR = ("numbers.h", "qp.h", "loop.h", "record.h", "road.h", "car.c", "record.c", "road.c")
_SHARED = ("resources.h", "resources.c", "model.h", "instance.h")
# As the core's C: without fused operations all compilers give the same numbers. Only FMI's functions can be seen.
FLAGS = ("-std=c11", "-O2", "-g0", "-ffp-contract=off", "-fvisibility=hidden", "-shared")
KINDS = {
    "law": ((FOLDER / "source", (*_SHARED, "sampled.h", "law.c")),),
    "ecu": ((FOLDER / "source", (*_SHARED, "sampled.h", "program.c")), ("ecu/source", _CONTROLLER)),
    "vehicle": ((FOLDER / "source", (*_SHARED, "vehicle.c")), ("kernel", _CAR)),
}  # of each kind the folders of its C, some of them in the core, and the files there


class Platform(NamedTuple):
    """A platform by its name in FMI 3.0, a library's ending there, the machine it is, and ziglang's name of it."""

    name: str
    ending: str
    machine: tuple[str, str]
    target: str


PLATFORMS = {
    "linux64": Platform("x86_64-linux", ".so", ("Linux", "x86_64"), "x86_64-linux-gnu.2.17"),
    "win64": Platform("x86_64-windows", ".dll", ("Windows", "AMD64"), "x86_64-windows-gnu"),
    "darwin64": Platform("x86_64-darwin", ".dylib", ("Darwin", "x86_64"), "x86_64-macos"),
}  # by the name that FMI 2.0 has


@cache
def sources(kind: str, version: str) -> dict[str, str]:
    """Return the C of a program by file name.

    Args:
        kind: One of KINDS.
        version: Of FMI.
    """
    core = importlib.util.find_spec("sim_core")
    places = list(core.submodule_search_locations or []) if core else []
    texts = {}
    for folder, names in KINDS[kind]:
        for name in names:
            texts[name] = Path(*places[:1], folder, name).read_text(encoding="utf-8")
    interface = f"fmi{version[0]}.c"
    return {**texts, interface: (FOLDER / "source" / interface).read_text(encoding="utf-8")}


def binary(kind: str, version: str, wanted: str) -> Path:
    """Return the file of a program, which is there once it is compiled; another one for other sources.

    Args:
        kind: One of KINDS.
        version: Of FMI.
        wanted: One of PLATFORMS.
    """
    digest = hashlib.sha256(repr((FLAGS, sorted(sources(kind, version).items()))).encode()).hexdigest()
    return BINARIES / wanted / f"{kind}-fmi{version[0]}-{digest[:16]}{PLATFORMS[wanted].ending}"


def compile_programs(wanted: str, compiler: list[str]) -> None:
    """Compile all programs of a platform; those of other sources are removed.

    Raises:
        CalledProcessError: The compiler fails.
    """
    targets = {binary(kind, version, wanted): sources(kind, version) for kind in KINDS for version in ("2.0", "3.0")}
    (BINARIES / wanted).mkdir(parents=True, exist_ok=True)
    for target, texts in targets.items():
        with TemporaryDirectory(dir=BINARIES) as name:
            folder = Path(name)
            for file, text in texts.items():
                (folder / file).write_text(text, encoding="utf-8")
            own = ("-s",) if target.suffix == ".dll" else ("-fPIC",)
            files = [file for file in texts if file.endswith(".c")]
            command = [*compiler, *FLAGS, *own, "-o", target.name, *files, "-lm"]
            subprocess.run(command, cwd=folder, check=True)  # noqa: S603  # no shell
            (folder / target.name).replace(target)
    for other in {*(BINARIES / wanted).iterdir()} - targets.keys():
        other.unlink()


def main(words: list[str]) -> None:
    """Compile what the words ask for."""
    if words == ["all"]:
        zig = [sys.executable, "-m", "ziglang", "cc", "-target"]
        with ThreadPoolExecutor() as pool:  # ziglang builds another system's C library first
            list(pool.map(lambda name: compile_programs(name, [*zig, PLATFORMS[name].target]), PLATFORMS))
        return
    machine = (platform.system(), platform.machine())
    for name, each in PLATFORMS.items():
        if each.machine == machine:
            kernel = runpy.run_path(str(ROOT / "sim_core" / "kernel" / "build.py"))
            compile_programs(name, kernel["default_compiler"]())


if __name__ == "__main__":
    sys.path.insert(0, str(ROOT))  # where the core's C is looked for
    main(sys.argv[1:])
