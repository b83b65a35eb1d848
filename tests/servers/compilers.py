"""A machine without any C compiler, as far as a process can tell; and one that is installed on it later."""

import os
import shlex
from pathlib import Path

import pytest

from backend.ecu import build

# As where the package is not installed: in every Python process with this environment.
WITHOUT_ZIG = 'import sys\n\nsys.modules["ziglang"] = None\n'


class Bare:
    """Environment of a process that finds no compiler: none on PATH, no package `ziglang`, no program built before.

    Args:
        folder: Where it puts what that needs.
    """

    def __init__(self, folder: Path) -> None:
        self._path = os.environ.get("PATH", os.defpath)
        self._compilers = build.compilers()
        self._programs = folder / "bin"
        site = folder / "site"
        self._programs.mkdir()
        site.mkdir()
        (site / "sitecustomize.py").write_text(WITHOUT_ZIG)
        paths = [str(site), *filter(None, [os.environ.get("PYTHONPATH")])]
        self.environment = {
            "PATH": str(self._programs),
            "PYTHONPATH": os.pathsep.join(paths),
            build.FOLDER: str(folder / "ecu"),
        }

    def install(self) -> None:
        """From now on there is one, `cc`."""
        if not self._compilers:
            pytest.fail("These tests need a C compiler: apt-get install gcc, or make compiler")
        compiler = self._programs / "cc"
        command = shlex.join(self._compilers[0])
        compiler.write_text(f'#!/bin/sh\nunset PYTHONPATH\nPATH={shlex.quote(self._path)} exec {command} "$@"\n')
        compiler.chmod(0o755)
