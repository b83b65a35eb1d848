"""What computes a strategy's result, named by what it is: a result is stored under it and what its strategy reads."""

import hashlib
import inspect
from functools import cache
from importlib.metadata import version
from pathlib import Path

import sim_core
from sim_core.control.controller import Controller
from sim_core.kernel.library import DIGEST


def program(strategy: type[Controller]) -> dict[str, str]:
    """Return what computes its results.

    The core's version, the digest of the kernel's sources and flags, OSQP's version, and the digest of the controller's
    own file (`Controller.file_digest` of one that `load_controllers` loaded). Another processor or another BLAS
    computes the same within rounding (docs/decisions/0018-c-beneath-numpy.md).

    Raises:
        OSError: The controller's file cannot be read.
        TypeError: It is in no file: `sys.modules` has no such module.
    """
    controller = vars(strategy).get("file_digest") or _digest(inspect.getfile(strategy))
    return {"core": sim_core.__version__, "kernel": DIGEST, "osqp": _version("osqp"), "controller": controller}


_version = cache(version)


@cache
def _digest(file: str) -> str:
    """Return the SHA-256 of a file as it was when somebody first asked."""
    return hashlib.sha256(Path(file).read_bytes()).hexdigest()
