"""A run's numbers by name, and which of them are the same as stored ones."""

import math
from typing import Any

from sim_core.result import StrategyResult

SAME = 1e-7  # relative: two processors' BLAS differed by 8.7e-9 at most (docs/decisions/0018-c-beneath-numpy.md)


def event(result: StrategyResult, name: str) -> float:
    """The event's value of a strategy that has it."""
    value = result.events[name]
    assert value is not None, name
    return value


def metrics(result: StrategyResult) -> dict[str, float]:
    """Every metric, `window.signal.statistic`, and `comfort.…`."""
    found = {
        f"{window}.{signal}.{statistic}": value
        for window, signals in result.metrics.items()
        for signal, statistics in signals.items()
        for statistic, value in statistics.items()
    }
    return found | {f"comfort.{key}": value for key, value in result.comfort.items()}


def moved_only(stored: Any, computed: Any) -> Any:
    """Return what was computed, with the stored number wherever it is the same beyond rounding (`SAME`).

    Who writes a file of numbers anew so changes those alone that have moved.

    Args:
        stored: Plain JSON: numbers, texts, lists and objects.
        computed: The same, of this program.
    """
    if isinstance(stored, dict) and isinstance(computed, dict):
        return {key: moved_only(stored.get(key), value) for key, value in computed.items()}
    if isinstance(stored, list) and isinstance(computed, list) and len(stored) == len(computed):
        return [moved_only(one, other) for one, other in zip(stored, computed, strict=True)]
    numbers = isinstance(stored, float) and isinstance(computed, float)
    return stored if numbers and math.isclose(stored, computed, rel_tol=SAME, abs_tol=1e-12) else computed
