"""A run's numbers by name."""

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
