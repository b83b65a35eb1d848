"""What the core does to the process it is imported into: nothing; and BLAS has one thread while a run is simulated."""

import os
import subprocess
import sys
from collections.abc import Iterator
from pathlib import Path
from typing import Any

import pytest
from threadpoolctl import ThreadpoolController

from sim_core import Scenario, simulate
from sim_core.metrics.evaluate import evaluate
from tests.servers.process import HANG_TIMEOUT

SIMULATE = sys.modules["sim_core.simulate"]  # the module: the package binds the function by that name
# Prints how many blocks of 4 MiB glibc fetches from the system one by one: it keeps none of them when they are freed.
_FETCHED = """
import ctypes, sys
import numpy as np

class Info(ctypes.Structure):
    NAMES = "arena ordblks smblks hblks hblkhd usmblks fsmblks uordblks fordblks keepcost"
    _fields_ = [(name, ctypes.c_size_t) for name in NAMES.split()]

mallinfo = getattr(ctypes.CDLL(None), "mallinfo2", None)
if mallinfo is None:
    sys.exit()
mallinfo.restype = Info
before = mallinfo().hblks
blocks = [np.empty(2**19) for _ in range(3)]
print(mallinfo().hblks - before)
"""


def printed(code: str) -> str:
    """What it prints in a process whose variables are those of a user's, without what this one has imported."""
    names = [name for name in os.environ if not name.endswith("_NUM_THREADS") and not name.startswith("KMP_")]
    environment = {name: os.environ[name] for name in names}
    command = [sys.executable, "-c", code]
    return subprocess.run(
        command, env=environment, capture_output=True, text=True, check=True, timeout=HANG_TIMEOUT
    ).stdout.strip()


def test_importing_the_core_leaves_the_environment_alone() -> None:
    code = "import os; before = dict(os.environ); import sim_core.simulate; print(dict(os.environ) == before)"
    assert printed(code) == "True"


def test_importing_the_core_leaves_the_allocator_alone_and_a_worker_has_it_keep_memory() -> None:
    if not (fetched := printed(_FETCHED)):
        pytest.skip("This C library does not say how it allocates")
    assert fetched == "3"
    assert printed(f"import sim_core.simulate\n{_FETCHED}") == "3"
    start = "from backend.compute.memory import keep_freed_memory; keep_freed_memory()"
    assert printed(f"{start}\n{_FETCHED}") == "0"


@pytest.fixture
def libraries() -> Iterator[list[Any]]:
    """Every BLAS that NumPy and SciPy have loaded, with three threads each."""
    every = [each for each in ThreadpoolController().lib_controllers if each.user_api == "blas"]
    found = [each for each in every if Path(each.filepath).parent.name in ("numpy.libs", "scipy.libs")]  # not a test's
    assert found, "threadpoolctl knows the BLAS of NumPy's and SciPy's wheels"
    before = [each.get_num_threads() for each in found]
    for each in found:
        each.set_num_threads(3)  # this thread sets the number from now on, threadpoolctl says
    assert threads(found) == {3}
    yield found
    for each, number in zip(found, before, strict=True):
        each.set_num_threads(number)


def threads(libraries: list[Any]) -> set[int]:
    return {each.get_num_threads() for each in libraries}


def test_a_run_has_one_thread_of_blas_and_the_host_has_its_own_back(
    libraries: list[Any], monkeypatch: pytest.MonkeyPatch
) -> None:
    during = []

    def seen(*arguments: Any) -> Any:
        during.append(threads(libraries))
        return evaluate(*arguments)

    monkeypatch.setattr(SIMULATE, "evaluate", seen)
    simulate(Scenario(), "passive")
    assert (during, threads(libraries)) == ([{1}], {3})
