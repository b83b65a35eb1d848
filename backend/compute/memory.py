"""How much memory a container may use; and what glibc does with freed memory, nothing with another C library."""

import ctypes
from contextlib import suppress
from pathlib import Path

_M_TRIM_THRESHOLD, _M_MMAP_THRESHOLD, _M_ARENA_MAX = -1, -3, -8  # mallopt(3)


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


def memory_limit() -> int | None:
    """Return how much this container may use [bytes]; None where nothing limits it."""
    for name in ("memory.max", "memory/memory.limit_in_bytes"):  # cgroups of version 2, and 1, which has a vast number
        with suppress(OSError, ValueError):
            return int(Path("/sys/fs/cgroup", name).read_text())
    return None


def _set_allocator(*settings: tuple[int, int]) -> None:
    with suppress(OSError, AttributeError):  # another C library
        mallopt = ctypes.CDLL(None).mallopt
        for parameter, value in settings:
            mallopt(parameter, value)
