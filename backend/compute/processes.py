"""The first steps of a process. A worker imports the core itself, so the service can spawn it before importing it."""

import ctypes
import os
import resource
import threading
from collections.abc import Callable
from contextlib import suppress
from multiprocessing import parent_process
from pathlib import Path
from typing import Any, TypeVar

T = TypeVar("T")

_STATM = Path("/proc/self/statm")
_M_TRIM_THRESHOLD, _M_MMAP_THRESHOLD, _M_ARENA_MAX = -1, -3, -8  # mallopt(3)


def return_freed_memory() -> None:
    """Have glibc give large blocks back to the system, and all threads share two heaps.

    sim_core has it keep what it frees, which makes a worker's single thread faster. In the service each of its threads
    would keep a heap of its own. Call it once sim_core is imported.
    """
    with suppress(OSError, AttributeError):  # another C library
        mallopt = ctypes.CDLL(None).mallopt
        for parameter, value in ((_M_MMAP_THRESHOLD, 128 * 1024), (_M_TRIM_THRESHOLD, 1024 * 1024), (_M_ARENA_MAX, 2)):
            mallopt(parameter, value)


def start(nice: int) -> None:
    """Make a new worker end with the service, even when the service is killed; called first.

    Args:
        nice: How far behind other processes this one stands (0 to 19).
    """
    if nice:
        os.nice(nice)
    parent = parent_process()
    if parent is not None:

        def follow() -> None:
            parent.join()
            os._exit(1)

        threading.Thread(target=follow, name="follow-service", daemon=True).start()


def warm_up() -> None:
    """Run the paper's scenario with every strategy once, so that the first request has filled caches.

    Not those with an ECU: its program is built when somebody asks for it.
    """
    from backend.ecu.drive import simulate
    from sim_core.scenario import Scenario
    from sim_core.strategies import STRATEGIES, SuspensionPolicy

    for strategy in STRATEGIES.values():
        if strategy.suspension is not SuspensionPolicy.ECU:
            simulate(Scenario(), strategy.id)


def call_and_measure(function: Callable[..., T], args: tuple[Any, ...]) -> tuple[T, int]:
    """The function's result, and the resident memory of this process afterwards [bytes]; 0 outside Linux."""
    result = function(*args)
    try:
        return result, int(_STATM.read_text().split()[1]) * resource.getpagesize()
    except OSError:
        return result, 0
