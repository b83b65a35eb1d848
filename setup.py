"""What pyproject.toml cannot say: the built page goes into the wheel, and C is compiled on any machine."""

import hashlib
import os
import shutil
import sys
from pathlib import Path

from setuptools import Extension, setup
from setuptools.command.build_ext import build_ext
from setuptools.command.build_py import build_py


class BuildWithPage(build_py):
    """The modules, and the page beside them; an editable installation serves frontend/dist itself."""

    def run(self) -> None:
        """Copy both.

        Raises:
            FileNotFoundError: The page is not built.
        """
        super().run()
        if self.editable_mode:
            return
        page = Path("frontend", "dist")
        if not (page / "index.html").is_file():
            raise FileNotFoundError(f"{page / 'index.html'} is not there: `make setup` builds the page")
        shutil.copytree(page, Path(self.build_lib, "backend", "page"), dirs_exist_ok=True)


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


SOURCES = sorted(Path("sim_core", "kernel").glob("*.c"))
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
    cmdclass={"build_py": BuildWithPage, "build_ext": BuildAnywhere},
    ext_modules=[LIBRARY],
)
