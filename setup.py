"""What pyproject.toml cannot say: the built page and the built manual go into the wheel and the source distribution.

Into the wheel also the bill of materials, where `make dist` has made it (PEP 770).
"""

import shutil
from pathlib import Path

from setuptools import setup
from setuptools.command.bdist_wheel import bdist_wheel
from setuptools.command.build_py import build_py
from setuptools.command.sdist import sdist

BUILT = {"page": Path("frontend", "dist"), "manual": Path("build", "manual")}

BILL = Path("build", "sbom.cdx.json")


def copy_built(package: Path) -> None:
    """Copy page and manual into the package; one of a source distribution has them.

    Raises:
        FileNotFoundError: Page or manual is not built.
    """
    for name, folder in BUILT.items():
        built = Path("backend", name) if Path("backend", name).is_dir() else folder
        if not (built / "index.html").is_file():
            raise FileNotFoundError(f"{built / 'index.html'} is not there: `make setup` builds it")
        shutil.copytree(built, package / name, dirs_exist_ok=True)


class BuildWithPage(build_py):
    """The modules, page and manual beside them; an editable installation serves the built folders themselves."""

    def run(self) -> None:
        """Copy all."""
        super().run()
        if not self.editable_mode:
            copy_built(Path(self.build_lib, "backend"))


class SourcesWithPage(sdist):
    """The sources, and beside them page and manual as they were built: no Node.js builds the wheel."""

    def make_release_tree(self, base_dir: str, files: list[str]) -> None:
        """Copy all."""
        super().make_release_tree(base_dir, files)
        copy_built(Path(base_dir, "backend"))


class WheelWithBill(bdist_wheel):
    """The wheel, its bill of materials beside its metadata."""

    def egg2dist(self, egginfo_path: str, distinfo_path: str) -> None:
        """Add it."""
        super().egg2dist(egginfo_path, distinfo_path)
        if BILL.is_file():
            Path(distinfo_path, "sboms").mkdir()
            shutil.copy(BILL, Path(distinfo_path, "sboms", BILL.name))


setup(cmdclass={"bdist_wheel": WheelWithBill, "build_py": BuildWithPage, "sdist": SourcesWithPage})
