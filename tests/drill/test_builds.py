"""DRILL_RUNS random cheap runs (300, by DRILL_SEED) by libraries of two compilers and by two kernels of OpenBLAS."""

import json
import os
import shutil
import subprocess
import sys
from itertools import count, islice
from pathlib import Path

import numpy as np
import pytest

from backend.cost.estimate import estimate
from benchmarks.cost import drawn
from sim_core import STRATEGIES, FloatArray, RidelabError, simulate
from sim_core.kernel import build
from tests.results import SAME
from tests.servers.process import ROOT
from tests.unit.random_runs import CHEAP, numbers, to_its_limits

RUNS = int(os.environ.get("DRILL_RUNS", "300"))
SEED = int(os.environ.get("DRILL_SEED", "1"))
KERNELS = ("Prescott", "Haswell")
# Loads the libraries of another folder, then prints this module's numbers.
PROGRAM = """
import ctypes, json, sys
from pathlib import Path
real = ctypes.CDLL
ctypes.CDLL = lambda file, *rest, **named: real(
    str(Path(sys.argv[1], Path(file).name)) if "libridelab" in str(file) else file, *rest, **named
)
from tests.drill.test_builds import all_numbers
print(json.dumps(all_numbers()))
"""

Numbers = dict[str, dict[str, float]]


def all_numbers() -> Numbers:
    """All numbers of the runs, by what names one."""
    cases = (
        (f"number {number}, {strategy}", scenario, strategy)
        for number in count()
        for scenario, strategy in [
            drawn(SEED, number, [each for each in STRATEGIES if each != "lv_hil"], to_its_limits)
        ]
        if estimate(scenario, strategy) < CHEAP
    )
    found: Numbers = {}
    for name, scenario, strategy in islice(cases, RUNS):
        try:
            found[name] = numbers(simulate(scenario, strategy))
        except RidelabError as error:
            found[name] = {type(error).__name__: 0.0}
    return found


def elsewhere(folder: Path, **environment: str) -> Numbers:
    command = [sys.executable, "-c", PROGRAM, str(folder)]
    run = subprocess.run(command, cwd=ROOT, env={**os.environ, **environment}, capture_output=True, check=True)
    found: Numbers = json.loads(run.stdout)
    return found


def compare(what: str, ours: Numbers, theirs: Numbers) -> FloatArray:
    """By run the greatest difference of a number, relative to the greater of it and 1e-6."""
    assert {name: list(each) for name, each in ours.items()} == {name: list(each) for name, each in theirs.items()}
    differences = {
        name: max(abs(theirs[name][key] - value) / max(abs(value), 1e-6) for key, value in each.items())
        for name, each in ours.items()
    }
    most = max(differences, key=lambda name: differences[name])
    sizes = np.array(list(differences.values()))
    print(
        f"\n{what}: {len(sizes)} runs of seed {SEED}, {np.mean(sizes == 0):.0%} with the same bits, "
        f"most {sizes.max():.2g}: {most}"
    )
    return sizes


@pytest.mark.timeout(3600)
def test_two_compilers_make_the_same_bits(tmp_path: Path) -> None:
    compilers = {"the machine's": shutil.which("cc"), "zig's": f"{sys.executable} -m ziglang cc"}
    found = []
    for number, compiler in enumerate(compilers.values()):
        (tmp_path / str(number)).mkdir()
        command = [sys.executable, build.__file__, str(tmp_path / str(number))]
        subprocess.run(command, env={**os.environ, "CC": str(compiler)}, check=True)
        found.append(elsewhere(tmp_path / str(number)))
    assert not np.any(compare(" and ".join(compilers) + " compiler", *found))


@pytest.mark.timeout(3600)
def test_two_kernels_of_the_blas_make_the_same_numbers_within_the_bound() -> None:
    first, second = (elsewhere(build.FOLDER, OPENBLAS_CORETYPE=kernel) for kernel in KERNELS)
    differences = compare(" and ".join(KERNELS), first, second)
    assert differences.max() < SAME
