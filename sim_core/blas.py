"""BLAS on one thread while a run is simulated.

The matrices are small: a second thread only costs, many times over on a busy machine, and sums in another order.
"""

import os
import sys
from collections.abc import Callable
from functools import cache, wraps
from typing import ParamSpec, TypeVar

_SET = "KMP_DUPLICATE_LIB_OK" in os.environ  # threadpoolctl sets it when it is imported, for its host too
from threadpoolctl import ThreadpoolController  # noqa: E402 - after it was looked at

if not _SET:
    os.environ.pop("KMP_DUPLICATE_LIB_OK", None)

P = ParamSpec("P")
T = TypeVar("T")


@cache
def _controller(with_scipy: bool) -> ThreadpoolController:
    """Return what sets the threads of the libraries that are loaded; SciPy may bring its own later than NumPy."""
    return ThreadpoolController().select(user_api="blas")


def single_threaded(function: Callable[P, T]) -> Callable[P, T]:
    """Give every BLAS one thread while a function runs; behind it each has the threads that it had before it."""

    @wraps(function)
    def limited(*args: P.args, **kwargs: P.kwargs) -> T:
        with _controller("scipy.linalg" in sys.modules).limit(limits=1):
            return function(*args, **kwargs)

    return limited
