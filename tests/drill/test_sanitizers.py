"""The core's C under gcc's sanitizers of addresses and undefined behaviour: what tests drive; and they find errors.

Some minutes. A copy of the sources is built with sanitizers, and tests are run on the copy.
"""

import os
import runpy
import shutil
import subprocess
import sys
from pathlib import Path

import pytest

ROOT = Path(__file__).parents[2]
COPIED = ("sim_core", "backend", "client", "tests", "benchmarks", "docs", "pyproject.toml")
SANITIZERS = ("-fsanitize=address,undefined", "-fno-sanitize-recover=all", "-fno-omit-frame-pointer", "-g", "-fPIC")
# What drives all of the C: roads and kinks, every damper, stop and actuator, metrics, the speed plan, QPs, the ECU,
# and what thins time histories out.
TESTS = (
    *(f"unit/test_{name}.py" for name in ("kernel", "kernel_misuse", "pins", "qp", "recorder")),
    *(f"validation/test_{name}.py" for name in ("ecu", "estimation", "fuzzy", "measured", "metrics", "mismatch")),
    *(
        f"validation/test_{name}.py"
        for name in ("nonlinear", "road", "sampling", "semi_active", "shape", "speed", "vehicles")
    ),
)

pytestmark = pytest.mark.skipif(shutil.which("gcc") is None, reason="no gcc here")


@pytest.fixture
def copy(tmp_path: Path) -> Path:
    """A checkout to build and run in."""
    for name in COPIED:
        source = ROOT / name
        ignored = shutil.ignore_patterns("__pycache__", "*.so.1", "*.egg-info", "node_modules")
        if source.is_dir():
            shutil.copytree(source, tmp_path / name, ignore=ignored)
        else:
            shutil.copy(source, tmp_path / name)
    return tmp_path


def library_of(name: str) -> str:
    return subprocess.check_output(["gcc", f"-print-file-name={name}"], text=True).strip()


def run(folder: Path, *arguments: str) -> subprocess.CompletedProcess[str]:
    """Python in a copy whose C is built with sanitizers."""
    kernel = folder / "sim_core" / "kernel"
    build = runpy.run_path(str(kernel / "build.py"))
    subprocess.run(build["command"](["gcc"], kernel / build["NAME"], *SANITIZERS), check=True)
    environment = os.environ | {
        "LD_PRELOAD": f"{library_of('libasan.so')} {library_of('libstdc++.so')}",  # whose exceptions it has to know
        "ASAN_OPTIONS": "detect_leaks=0",  # Python keeps what it has until its end
        "PYTHONDONTWRITEBYTECODE": "1",
    }
    return subprocess.run(
        [sys.executable, *arguments], cwd=folder, env=environment, capture_output=True, text=True, check=False
    )


DRIVE = """
from sim_core.kernel import library
from sim_core.scenario import Scenario, Vehicle
from sim_core.simulate import simulate
print(library.__file__)
simulate(Scenario(vehicle=Vehicle(rebound_ratio=2.0)), "lqr")
"""


@pytest.mark.timeout(3600)
def test_the_tests_drive_nothing_beyond_an_array_or_undefined(copy: Path) -> None:
    assert run(copy, "-c", DRIVE).stdout == f"{copy}/sim_core/kernel/library.py\n", "the copy is what is run"
    tests = [f"tests/{name}" for name in TESTS]
    outcome = run(copy, "-m", "pytest", "-q", "--numprocesses", "2", "-p", "no:cacheprovider", *tests)
    print(outcome.stdout[-2000:])
    assert outcome.returncode == 0, outcome.stdout[-5000:] + outcome.stderr[-5000:]
    assert "runtime error" not in outcome.stdout + outcome.stderr


@pytest.mark.parametrize(
    ("file", "right", "wrong", "found"),
    [
        ("road.c", "i < n; i++)\n        height", "i <= n; i++)\n        height", "heap-buffer-overflow"),
        ("car.c", "own << OF_AXLE", "own << 40", "shift exponent 40 is too large"),
    ],
    ids=["beyond an array", "undefined"],
)
def test_they_find_what_is_wrong(copy: Path, file: str, right: str, wrong: str, found: str) -> None:
    source = copy / "sim_core" / "kernel" / file
    text = source.read_text()
    assert text.count(right) == 1
    source.write_text(text.replace(right, wrong))
    outcome = run(copy, "-c", DRIVE)
    assert outcome.returncode != 0
    assert found in outcome.stderr
