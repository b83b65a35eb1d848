"""BLAS on one thread while a run is simulated, and as it was before and after.

The matrices are small: a second thread only costs, many times over on a busy machine, and sums in another order.
"""

import os
from collections.abc import Iterable, Iterator
from contextlib import contextmanager
from functools import cache
from threading import Lock

_SET = "KMP_DUPLICATE_LIB_OK" in os.environ  # threadpoolctl sets it when it is imported, for its host too
from threadpoolctl import LibController, ThreadpoolController  # noqa: E402

if not _SET:
    os.environ.pop("KMP_DUPLICATE_LIB_OK", None)

ThreadCounts = list[tuple[LibController, int]]


@cache
def _libraries() -> tuple[list[LibController], list[LibController]]:
    """Every BLAS, NumPy's and SciPy's: those with a number of threads for the process, and for each of its threads."""
    libraries = [each for each in ThreadpoolController().lib_controllers if each.user_api == "blas"]
    own = [each for each in libraries if getattr(each, "threading_layer", None) == "openmp"]
    return [each for each in libraries if each not in own], own


def _limit(libraries: Iterable[LibController]) -> ThreadCounts:
    """Hold them to one thread; returns the numbers of those that had another."""
    numbers = [(each, each.get_num_threads()) for each in libraries]
    changed = [(each, number) for each, number in numbers if number != 1]
    _set((each, 1) for each, _ in changed)
    return changed


def _set(numbers: Iterable[tuple[LibController, int]]) -> None:
    for library, number in numbers:
        if library.internal_api == "openblas":  # of which threadpoolctl lets one thread alone set the number
            library.clear_controlling_thread(force=True)
            library.set_num_threads(number)
            library.clear_controlling_thread(force=True)
        else:
            library.set_num_threads(number)


class _Process:
    """The process's numbers: the first run that begins sets them, the last one that ends sets them back."""

    def __init__(self) -> None:
        self._lock = Lock()
        self._runs = 0
        self._before: ThreadCounts = []

    def limit(self, libraries: Iterable[LibController]) -> None:
        with self._lock:
            if not self._runs:
                self._before = _limit(libraries)
            self._runs += 1

    def restore(self) -> None:
        with self._lock:
            self._runs -= 1
            if not self._runs:
                _set(self._before)


_PROCESS = _Process()


@contextmanager
def one_thread() -> Iterator[None]:
    """Hold every BLAS to one thread; runs of several threads may overlap."""
    of_process, of_thread = _libraries()
    _PROCESS.limit(of_process)
    before = _limit(of_thread)
    try:
        yield
    finally:
        _set(before)
        _PROCESS.restore()
