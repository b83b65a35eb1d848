"""`python -m sim_core.demo`: the paper's comparison in a terminal, computed here."""

import json
import sys
from collections.abc import Iterator

from sim_core.catalogue import PAPER_SIGNALS, PAPER_VIEWS, SIGNALS, STATISTICS, WINDOWS
from sim_core.result import StrategyResult
from sim_core.scenario import Scenario
from sim_core.simulate import simulate
from sim_core.strategies import STRATEGIES

SHOWN = ("lv", "lqr", "passive")
_FIRST = 34  # characters of a table's first column


def main(*, as_json: bool = False) -> int:
    """Print the comparison, or each result for machines."""
    scenario = Scenario()
    results = {name: simulate(scenario, name) for name in SHOWN}
    if as_json:
        text = json.dumps({name: result.summary() for name, result in results.items()}, indent=1, default=dict)
    else:
        text = "\n".join(lines(scenario, results))
    sys.stdout.write(f"{text}\n")
    return 0


def lines(scenario: Scenario, results: dict[str, StrategyResult]) -> Iterator[str]:
    """Yield the comparison over a scenario's bump."""
    bump, speed = scenario.road.bump, scenario.speed.initial_speed_kmh
    yield f"A car at {speed:g} km/h, a bump {bump.height:g} m high and {bump.length:g} m long, computed here."
    for name, result in results.items():
        peak = result.metrics["bump"]["body_acceleration"]["peak"]
        yield f"{STRATEGIES[name].label}: {peak:.2f} m/s^2 on the bump, met at {result.arrival_speed_kmh:.1f} km/h"
    yield ""
    yield from _table(results)


def _table(results: dict[str, StrategyResult]) -> Iterator[str]:
    yield f"{'change against Passive':{_FIRST}}" + "".join(f"{STRATEGIES[name].label:>16}" for name in results)
    for window, statistic in PAPER_VIEWS:
        yield f"{STATISTICS[statistic].label}, {WINDOWS[window].label.lower()}"
        for signal in PAPER_SIGNALS:
            values = {name: result.metrics[window][signal][statistic] for name, result in results.items()}
            cells = [_cell(value, values["passive"], name) for name, value in values.items()]
            head = f"  {SIGNALS[signal].label} [{SIGNALS[signal].unit}]"
            yield f"{head:{_FIRST}}" + "".join(f"{cell:>16}" for cell in cells)


def _cell(value: float, passive: float, name: str) -> str:
    return f"{value:.4g}" if name == "passive" else f"{value:.4g} ({value / passive - 1:+z.0%})"


if __name__ == "__main__":
    sys.exit(main(as_json="--json" in sys.argv))
