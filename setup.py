"""What pyproject.toml cannot say: the built page goes into the wheel."""

import shutil
from pathlib import Path

from setuptools import setup
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


setup(cmdclass={"build_py": BuildWithPage})
