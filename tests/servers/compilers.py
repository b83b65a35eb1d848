"""A machine without any C compiler, as far as a process can tell."""

import os
from pathlib import Path

# As where the package is not installed: in every Python process with this environment.
WITHOUT_ZIG = 'import sys\n\nsys.modules["ziglang"] = None\n'


class Bare:
    """Environment of a process that finds no compiler: none on PATH, no package `ziglang`.

    Args:
        folder: Where it puts what that needs.
    """

    def __init__(self, folder: Path) -> None:
        programs = folder / "bin"
        site = folder / "site"
        programs.mkdir()
        site.mkdir()
        (site / "sitecustomize.py").write_text(WITHOUT_ZIG)
        paths = [str(site), *filter(None, [os.environ.get("PYTHONPATH")])]
        self.environment = {
            "PATH": str(programs),
            "PYTHONPATH": os.pathsep.join(paths),
        }
