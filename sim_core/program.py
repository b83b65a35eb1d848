"""What computes a strategy's result, named by what it is: a result is stored under it and what its strategy reads."""

import hashlib
import inspect
from collections.abc import Hashable
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
    controller = vars(strategy).get("file_digest") or _source(strategy)  # type: ignore[arg-type]  # a class can be hashed
    return {"core": sim_core.__version__, "kernel": DIGEST, "osqp": _osqp(), "controller": controller}


@cache
def _osqp() -> str:
    return version("osqp")


@cache
def _source(strategy: Hashable) -> str:
    """SHA-256 of the file that has the class, as it was when somebody first asked."""
    assert isinstance(strategy, type)  # noqa: S101 - a class can be hashed
    return hashlib.sha256(Path(inspect.getfile(strategy)).read_bytes()).hexdigest()
