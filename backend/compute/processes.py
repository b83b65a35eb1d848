"""What a worker process does around its tasks."""

import ctypes
import os
import resource
import signal
import threading
from collections.abc import Callable
from contextlib import suppress
from importlib import import_module
from multiprocessing import parent_process
from pathlib import Path
from types import FrameType
from typing import Any, TypeVar

T = TypeVar("T")
INTERRUPT = signal.SIGUSR1
RETRY_INTERVAL = 0.02  # in which an import that is under way may end before the task is interrupted [s]
_interruptible = False  # while a task runs

_STATM = Path("/proc/self/statm")
_M_TRIM_THRESHOLD, _M_MMAP_THRESHOLD, _M_ARENA_MAX = -1, -3, -8  # mallopt(3)


class CalledOffError(Exception):
    """The task was interrupted: nobody waits for it any more."""


class _Interrupt(BaseException):
    """What a task does not catch."""


def keep_freed_memory() -> None:
    """Have glibc keep the blocks that a run frees, some MiB, for the next run.

    Fetched from the system page by page they would take a quarter of a run's time. In a worker, which has one thread.
    """
    _set_allocator((_M_MMAP_THRESHOLD, 8 * 1024 * 1024), (_M_TRIM_THRESHOLD, 16 * 1024 * 1024))


def return_freed_memory() -> None:
    """Have glibc give large blocks back to the system, and all threads share two heaps.

    In the service, whose answers of some MB pass through many threads: by itself glibc keeps what was freed in each
    one's heap, and takes larger and larger blocks from there (test_live_answers_leave_little_memory_behind).
    """
    _set_allocator((_M_MMAP_THRESHOLD, 128 * 1024), (_M_TRIM_THRESHOLD, 1024 * 1024), (_M_ARENA_MAX, 2))


def trim_memory() -> None:
    """Have glibc give back the freed pages that lie between blocks in use, which it keeps by itself."""
    with suppress(OSError, AttributeError):  # another C library
        ctypes.CDLL(None).malloc_trim(0)


def _set_allocator(*settings: tuple[int, int]) -> None:
    with suppress(OSError, AttributeError):  # another C library
        mallopt = ctypes.CDLL(None).mallopt
        for parameter, value in settings:
            mallopt(parameter, value)


def start(nice: int) -> None:
    """Make a new worker keep its memory and end with the service, even a killed one, and tasks end by INTERRUPT.

    SIGALRM is taken too, for an interrupt that has to wait.

    Called first.

    Args:
        nice: How far behind other processes this one stands (0 to 19).
    """
    if nice:
        os.nice(nice)
    keep_freed_memory()
    signal.signal(INTERRUPT, _interrupt)
    signal.signal(signal.SIGALRM, _interrupt)
    parent = parent_process()
    if parent is not None:

        def follow() -> None:
            parent.join()
            os._exit(1)

        threading.Thread(target=follow, name="follow-service", daemon=True).start()


def _interrupt(_: int, frame: FrameType | None) -> None:
    if _interruptible and _is_importing(frame):
        signal.setitimer(signal.ITIMER_REAL, RETRY_INTERVAL)
    elif _interruptible:
        raise _Interrupt


def _is_importing(frame: FrameType | None) -> bool:
    """Whether an import is under way. A package broken off half way may stay broken in its process.

    Those of its modules that are there already are not bound to it again, and C extensions load once.
    """
    while frame is not None:
        if frame.f_code.co_filename == "<frozen importlib._bootstrap>":
            return True
        frame = frame.f_back
    return False


def prepare(warm_up: str) -> int:
    """Import that module, unless the process was forked from one that has; the process's id."""
    import_module(warm_up)
    return os.getpid()


def call_and_measure(function: Callable[..., T], args: tuple[Any, ...], controllers: Any) -> tuple[T, int]:
    """The function's result, and the resident memory of this process afterwards [bytes]; 0 outside Linux.

    Args:
        function: What to call.
        args: Its arguments.
        controllers: Those of one's own that there are (`backend.custom_controllers.controller_sources`).

    Raises:
        CalledOffError: By INTERRUPT, between two steps of Python and after an import that is under way; the process is
            well and its caches are empty.
    """
    from backend import custom_controllers

    global _interruptible
    custom_controllers.adopt(controllers)
    try:
        try:
            _interruptible = True
            result = function(*args)
        finally:
            _interruptible = False
            signal.setitimer(signal.ITIMER_REAL, 0)
    except _Interrupt:
        from sim_core.caching import SHARED

        SHARED.clear()  # an entry may be there in part
        raise CalledOffError from None
    try:
        return result, int(_STATM.read_text().split()[1]) * resource.getpagesize()
    except OSError:
        return result, 0
