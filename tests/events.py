"""What a drive counts, as a number."""

from sim_core.result import StrategyResult


def event(result: StrategyResult, name: str) -> float:
    """The event's value of a strategy that has it."""
    value = result.events[name]
    assert value is not None, name
    return value
