"""Measuring: medians of repeats, fresh processes, and plain tables."""

import resource
import statistics
import subprocess
import sys
from collections.abc import Callable, Iterable, Sequence
from time import process_time

from sim_core.scenario import Scenario


def median_ms(work: Callable[[Scenario], object], cases: Iterable[Scenario]) -> float:
    """Median processor time of `work`, which has one thread, over cases [ms].

    Each is timed once: different ones share only what work itself keeps.
    """
    times = []
    for case in cases:
        begin = process_time()
        work(case)
        times.append(process_time() - begin)
    return statistics.median(times) * 1000


def fresh_process(code: str) -> list[float]:
    """Numbers that Python code prints in a process of its own."""
    command = [sys.executable, "-c", code]
    run = subprocess.run(command, capture_output=True, text=True, check=True)  # noqa: S603 - our own code, no shell
    return [float(word) for word in run.stdout.split()]


def peak_memory_mb() -> float:
    """Largest resident memory of this process so far [MB]."""
    peak = resource.getrusage(resource.RUSAGE_SELF).ru_maxrss
    return peak / (2**20 if sys.platform == "darwin" else 2**10)


def table(title: str, head: Sequence[str], rows: Sequence[Sequence[object]]) -> None:
    """Print rows under a head, the first column left, numbers right."""
    shown = [[f"{cell:,.2f}" if isinstance(cell, float) else str(cell) for cell in row] for row in [head, *rows]]
    widths = [max(len(row[i]) for row in shown) for i in range(len(head))]
    print(f"\n{title}")
    for row in shown:
        cells = [row[0].ljust(widths[0]), *(cell.rjust(width) for cell, width in zip(row[1:], widths[1:], strict=True))]
        print("  " + "  ".join(cells).rstrip())
