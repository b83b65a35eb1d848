"""`simulate` as the service does it: a strategy with an ECU drives the C program, in a process of its own."""

import logging

from backend.ecu import build
from backend.ecu.build import EcuError
from backend.ecu.link import connected
from backend.errors import EcuUnavailableError
from sim_core.result import StrategyResult
from sim_core.scenario import Scenario
from sim_core.simulate import simulate as simulate_core
from sim_core.strategies import SuspensionPolicy, strategy_named

logger = logging.getLogger(__name__)


def simulate(scenario: Scenario, name: str) -> StrategyResult:
    """Drive one strategy, one with an ECU by its program; a program that ends in mid-drive is restarted once.

    Raises:
        EcuUnavailableError: The program cannot be built, or failed twice.
        RidelabError: As `sim_core.simulate.simulate` raises.
    """
    if strategy_named(name).suspension is SuspensionPolicy.ECU:
        try:
            build.program()
        except EcuError as error:
            raise EcuUnavailableError(error.message) from None
    try:
        return simulate_core(scenario, name, connected)
    except EcuError as error:
        logger.warning("The drive of an ECU failed: %s", error.message)
    try:
        return simulate_core(scenario, name, connected)
    except EcuError as error:
        raise EcuUnavailableError(error.message) from None
