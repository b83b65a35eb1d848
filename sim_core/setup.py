"""What pyproject.toml cannot say: this folder is the package, and its C is compiled on any machine."""

import runpy
from pathlib import Path

from setuptools import Extension, find_namespace_packages, setup
from setuptools.command.bdist_wheel import bdist_wheel
from setuptools.command.build_ext import build_ext
from setuptools.command.build_py import build_py


class BuildLibrary(build_ext):
    """The core's C for each kind of processor, which `sim_core.kernel.library` loads: no modules, and not called so."""

    def get_ext_filename(self, fullname: str) -> str:
        """Return its file."""
        return str(Path(*fullname.split(".")).with_suffix(".so.1"))

    def build_extension(self, ext: Extension) -> None:
        """Compile it; an editable installation takes the one beside the sources, where that is of these sources."""
        library = Path(self.get_ext_fullpath(ext.name))
        library.parent.mkdir(parents=True, exist_ok=True)
        present = BUILD["FOLDER"] / library.name
        if self.editable_mode and BUILD["is_current"](present):
            self.copy_file(str(present), str(library))
        else:
            self.spawn(BUILD["command"](COMPILER, library, *LIBRARIES[library.name]))


class BuildPackage(build_py):
    """The package without this file."""

    def find_package_modules(self, package: str, package_dir: str) -> list[tuple[str, str, str]]:
        """Return its modules: package, name and file of each."""
        return [
            each for each in super().find_package_modules(package, package_dir) if each[:2] != ("sim_core", "setup")
        ]


class WheelForEveryPython(bdist_wheel):
    """The library knows nothing of Python: one wheel a platform serves every version."""

    def get_tag(self) -> tuple[str, str, str]:
        """Return the tags of the wheel."""
        return "py3", "none", super().get_tag()[2]


BUILD = runpy.run_path("kernel/build.py")
COMPILER = BUILD["default_compiler"]()
LIBRARIES = BUILD["libraries"](COMPILER)
SOURCES = [str(file.relative_to(Path.cwd())) for file in BUILD["SOURCES"]]
setup(
    packages=["sim_core", *(f"sim_core.{name}" for name in find_namespace_packages(exclude=["build*"]))],
    cmdclass={"build_py": BuildPackage, "build_ext": BuildLibrary, "bdist_wheel": WheelForEveryPython},
    ext_modules=[Extension(f"sim_core.kernel.{name.removesuffix('.so.1')}", SOURCES) for name in LIBRARIES],
)
