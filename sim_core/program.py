"""What computes a strategy's result, named by what it is: a result is stored under it and what its strategy reads."""

import hashlib
import inspect
from functools import cache
from importlib.metadata import version
from pathlib import Path

import sim_core
from sim_core.control.controller import Controller
from sim_core.kernel.library import DIGEST

SOLVERS = ("daqp", "osqp")


def program(strategy: type[Controller]) -> dict[str, str]:
    """What computes its results.

    The core's version, the digest of the kernel's sources and flags, the versions of the QP solvers, and the digest of
    the file of a controller that is not Ridelab's. Another processor or another BLAS computes the same within rounding
    (docs/decisions/0018-c-beneath-numpy.md).

    Raises:
        OSError: The file of a controller that is not Ridelab's cannot be read.
        TypeError: It is in no file: `sys.modules` has no such module.
    """
    found = {"core": sim_core.__version__, "kernel": DIGEST, **_solvers()}
    if not strategy.__module__.startswith("sim_core."):
        file = Path(inspect.getfile(strategy))
        found["controller"] = hashlib.sha256(file.read_bytes()).hexdigest()
    return found


@cache
def _solvers() -> dict[str, str]:
    return {name: version(name) for name in SOLVERS}
