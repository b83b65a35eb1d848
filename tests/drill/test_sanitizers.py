"""The core's C under gcc's sanitizers of addresses and undefined behaviour, driven by our tests of it: some minutes.

A copy of the sources is built with sanitizers, and tests are run on the copy.
"""

import os
import runpy
import shutil
import subprocess
import sys
from pathlib import Path

import pytest

from tests.servers.process import ROOT

COPIED = ("sim_core", "backend", "client", "tests", "benchmarks", "docs")
SANITIZERS = ("-fsanitize=address,undefined", "-fno-sanitize-recover=all", "-fno-omit-frame-pointer", "-g", "-fPIC")
# What drives all of the C: roads and kinks, every damper, stop and actuator, metrics, the speed plan, QPs, the ECU,
# what thins time histories out, and the programs of FMUs with whole and damaged numbers.
UNIT = ("fmu", "kernel", "kernel_misuse", "pins", "qp", "recorder")
VALIDATION = (
    *("ecu", "estimation", "fuzzy", "measured", "metrics", "mismatch", "nonlinear"),
    *("road", "sampling", "semi_active", "shape", "speed", "vehicles"),
)
BUILT = "import sim_core.kernel.library as library; print(library.__file__)"


def sanitizer(name: str) -> str:
    return subprocess.check_output(["gcc", f"-print-file-name={name}"], text=True).strip()


@pytest.mark.timeout(3600)
def test_the_tests_drive_nothing_beyond_an_array_or_undefined(tmp_path: Path) -> None:
    ignored = shutil.ignore_patterns("__pycache__", "*.so.1", "*.egg-info")
    for name in COPIED:
        shutil.copytree(ROOT / name, tmp_path / name, ignore=ignored)
    shutil.copy(ROOT / "pyproject.toml", tmp_path)
    kernel = tmp_path / "sim_core" / "kernel"
    build = runpy.run_path(str(kernel / "build.py"))
    subprocess.run(build["command"](["gcc"], kernel / build["NAME"], *SANITIZERS), check=True)
    programs = runpy.run_path(str(tmp_path / "backend" / "fmu" / "programs.py"))
    programs["compile_programs"]("linux64", ["gcc", *SANITIZERS])
    environment = os.environ | {
        "LD_PRELOAD": f"{sanitizer('libasan.so')} {sanitizer('libstdc++.so')}",  # whose exceptions it has to know
        "ASAN_OPTIONS": "detect_leaks=0",  # Python keeps what it has until its end
        "PYTHONDONTWRITEBYTECODE": "1",
    }

    def run(*words: str) -> str:
        command = [sys.executable, *words]
        done = subprocess.run(command, cwd=tmp_path, env=environment, capture_output=True, text=True, check=False)
        assert done.returncode == 0, done.stdout[-5000:] + done.stderr[-5000:]
        return done.stdout + done.stderr

    assert run("-c", BUILT).startswith(str(kernel)), "the copy is what is run"
    tests = [
        *(f"tests/unit/test_{name}.py" for name in UNIT),
        *(f"tests/validation/test_{name}.py" for name in VALIDATION),
    ]
    said = run("-m", "pytest", "-q", "--numprocesses", "2", "-p", "no:cacheprovider", *tests)
    print(said[-2000:])
    assert "runtime error" not in said
