"""A program built from exported sources drives the scenario, and is compared with Ridelab's own."""

from collections.abc import Iterator
from functools import partial
from pathlib import Path

from backend.controller.link import connected
from backend.controller.realtime import changes
from backend.cost import affordable
from sim_core.scenario import Scenario
from sim_core.simulate import simulate
from sim_core.strategies.lv_hil import LvHil


def driven(scenario: Scenario, program: Path) -> Iterator[str]:
    """Whether every metric equals that of Ridelab's own program, and the changes against `lv` simulated [%], as text.

    Raises:
        EcuError: It has another scenario's tables, or did not answer.
        RidelabError: The scenario has no controller.
    """
    ours = affordable.simulate(scenario, "lv_hil")
    result = simulate(scenario, LvHil(connect=partial(connected, program=program.resolve())))
    same = result.summary() == ours.summary()
    yield f"{program} drove the scenario; every metric {'is' if same else 'is NOT'} that of Ridelab's own program"
    for window, row in changes(result, affordable.simulate(scenario, "lv")).items():
        cells = (f"{key} {'none' if value is None else f'{value:+.1f} %'}" for key, value in row.items())
        yield f"against lv simulated, {window}: {', '.join(cells)}"
