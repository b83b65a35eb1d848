"""Measuring: medians of repeats, and plain tables."""

import statistics
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


def table(title: str, head: Sequence[str], rows: Sequence[Sequence[object]]) -> None:
    """Print rows under a head, the first column left, numbers right."""
    shown = [[f"{cell:,.2f}" if isinstance(cell, float) else str(cell) for cell in row] for row in [head, *rows]]
    widths = [max(len(row[i]) for row in shown) for i in range(len(head))]
    print(f"\n{title}")
    for row in shown:
        cells = [row[0].ljust(widths[0]), *(cell.rjust(width) for cell, width in zip(row[1:], widths[1:], strict=True))]
        print("  " + "  ".join(cells).rstrip())
