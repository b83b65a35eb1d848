"""What pyproject.toml cannot say: this folder is the package, and its C is compiled on any machine."""

import hashlib
import os
import shutil
import sys
from pathlib import Path

from setuptools import Extension, find_namespace_packages, setup
from setuptools.command.bdist_wheel import bdist_wheel
from setuptools.command.build_ext import build_ext


class BuildAnywhere(build_ext):
    """The core's C for `ctypes`, by the machine's compiler or else by the package ziglang's."""

    def get_ext_filename(self, fullname: str) -> str:
        """A library that `sim_core.kernel.library` loads: no Python module, and not called like one."""
        return str(Path(*fullname.split(".")).with_name("libridelab.so.1"))

    def build_extensions(self) -> None:
        """Compile."""
        if self.compiler.compiler_type == "unix":
            ours = (path for name in ("cc", "gcc", "clang") if (path := shutil.which(name)))
            compiler = os.environ.get("CC", next(ours, f"{sys.executable} -m ziglang cc"))
            self.compiler.set_executables(compiler_so=f"{compiler} -fPIC", linker_so=f"{compiler} -shared")
        super().build_extensions()


class WheelForEveryPython(bdist_wheel):
    """The library knows nothing of Python: one wheel a platform serves every version."""

    def get_tag(self) -> tuple[str, str, str]:
        """Tags of the wheel."""
        return "py3", "none", super().get_tag()[2]


SOURCES = sorted(Path("kernel").glob("*.c"))
DIGEST = hashlib.sha256(b"".join(file.read_bytes() for file in SOURCES)).hexdigest()
LIBRARY = Extension(
    "sim_core.kernel.libridelab",
    [str(file) for file in SOURCES],
    define_macros=[("RIDELAB_SOURCES", f'"{DIGEST}"')],  # sim_core.kernel.library compares it with the files
    # Without fused operations a run gives the same numbers on every processor.
    extra_compile_args=["-O3", "-ffp-contract=off"],
    libraries=["m"],
)
setup(
    packages=["sim_core", *(f"sim_core.{name}" for name in find_namespace_packages(exclude=["build*"]))],
    cmdclass={"build_ext": BuildAnywhere, "bdist_wheel": WheelForEveryPython},
    ext_modules=[LIBRARY],
)
