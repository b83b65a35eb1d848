"""What pyproject.toml cannot say: the built page and the built manual go into the wheel."""

import shutil
from pathlib import Path

from setuptools import setup
from setuptools.command.build_py import build_py


class BuildWithPage(build_py):
    """The modules, page and manual beside them; an editable installation serves the built folders themselves."""

    def run(self) -> None:
        """Copy all.

        Raises:
            FileNotFoundError: Page or manual is not built.
        """
        super().run()
        if self.editable_mode:
            return
        for name, built in (("page", Path("frontend", "dist")), ("manual", Path("build", "manual"))):
            if not (built / "index.html").is_file():
                raise FileNotFoundError(f"{built / 'index.html'} is not there: `make setup` builds it")
            shutil.copytree(built, Path(self.build_lib, "backend", name), dirs_exist_ok=True)


setup(cmdclass={"build_py": BuildWithPage})
