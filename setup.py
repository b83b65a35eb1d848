"""What pyproject.toml cannot say: the built page goes into the wheel, and C is compiled on any machine."""

import runpy
import shutil
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


class BuildLibrary(build_ext):
    """The core's C, which `sim_core.kernel.library` loads: no Python module, and not called like one."""

    def get_ext_filename(self, fullname: str) -> str:
        """Its file."""
        return str(Path(*fullname.split(".")).with_name("libridelab.so.1"))

    def build_extension(self, ext: Extension) -> None:
        """Compile it."""
        library = Path(self.get_ext_fullpath(ext.name))
        library.parent.mkdir(parents=True, exist_ok=True)
        self.spawn(BUILD["command"](BUILD["default_compiler"](), library, "-fPIC"))


BUILD = runpy.run_path("sim_core/kernel/build.py")
LIBRARY = Extension("sim_core.kernel.libridelab", [str(file.relative_to(Path.cwd())) for file in BUILD["SOURCES"]])
setup(
    cmdclass={"build_py": BuildWithPage, "build_ext": BuildLibrary},
    ext_modules=[LIBRARY],
)
