"""`simulate` as the service does it: only what is affordable, and an ECU is its C program, in a process of its own."""

import logging

from backend.compute.processes import make_room
from backend.cost.estimate import check_affordable, expected_time, memory
from backend.ecu import build
from backend.ecu.build import EcuError
from backend.ecu.link import connected
from backend.errors import EcuUnavailableError
from sim_core.ecu.controller import EcuController
from sim_core.result import StrategyResult
from sim_core.scenario import Scenario
from sim_core.simulate import simulate as simulate_core
from sim_core.strategies import strategy_named

logger = logging.getLogger(__name__)
LARGE = 100e6  # a run's arrays, before which everything that can be spared makes room [bytes]


def simulate(scenario: Scenario, name: str) -> StrategyResult:
    """Drive one strategy, one with an ECU by its program; a program that ends in mid-drive is restarted once.

    Raises:
        EcuUnavailableError: The program cannot be built, or failed twice.
        TooExpensiveError: It does more than one run may.
        RidelabError: As `sim_core.simulate.simulate` raises.
    """
    strategy = strategy_named(name)
    if memory(scenario, strategy, expected_time(scenario, strategy)) > LARGE:
        make_room()
    if not issubclass(strategy, EcuController):
        check_affordable(scenario, name)
        return simulate_core(scenario, strategy)
    try:
        build.program()
    except EcuError as error:
        raise EcuUnavailableError(error.message) from None
    check_affordable(scenario, name)
    try:
        return simulate_core(scenario, strategy(connect=connected))
    except EcuError as error:
        logger.warning("The drive of an ECU failed: %s", error.message)
    try:
        return simulate_core(scenario, strategy(connect=connected))
    except EcuError as error:
        raise EcuUnavailableError(error.message) from None
