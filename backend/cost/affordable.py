"""`simulate` as the service does it: only what is affordable, with room made for what is large."""

from backend.compute.memory import trim_memory
from backend.cost.estimate import check_affordable, references
from backend.custom_controllers.registry import run_in_sandbox_process
from sim_core import Scenario, StrategyResult
from sim_core.caching import SHARED
from sim_core.errors import TooExpensiveError
from sim_core.scenario.recorded import recording_id
from sim_core.simulate import simulate as simulate_core

LARGE = 100e6  # a run's arrays, before which everything that can be spared makes room [bytes]


def simulate(scenario: Scenario, name: str) -> StrategyResult:
    """Drive one strategy, a custom controller in a process of its own; or take a recording that the scenario has.

    Raises:
        TooExpensiveError: It does more than one run may.
        RidelabError: As `sim_core.simulate.simulate` raises.
    """
    if (recording := recording_id(name)) is not None:
        from sim_core.recorded.result import recorded_result  # takes scipy, which few runs need

        return recorded_result(scenario, scenario.recording(recording), _reference)
    return run_in_sandbox_process(name, drive, scenario, name)


def _reference(scenario: Scenario, name: str) -> StrategyResult:
    """Drive what a recording is compared with.

    Raises:
        TooExpensiveError: It costs more than one such drive may.
    """
    if name not in references(scenario):
        raise TooExpensiveError("A drive that a recording is compared with costs too much")
    return simulate(scenario, name)


def drive(scenario: Scenario, name: str) -> StrategyResult:
    """Drive one strategy in this process; raises what `simulate` raises."""
    if check_affordable(scenario, name) > LARGE:
        make_room()
    return simulate_core(scenario, name)


def make_room() -> None:
    """Empty the caches, and have glibc give back what it keeps."""
    SHARED.clear()
    trim_memory()
