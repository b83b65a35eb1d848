"""`python -m sim_core.demo`: the paper's comparison in a terminal, computed here, with plots of dots."""

import json
import sys
from collections.abc import Iterator

import numpy as np

from sim_core.arrays import FloatArray
from sim_core.catalogue import PAPER_SIGNALS, SIGNALS, STATISTICS, WINDOWS
from sim_core.result import StrategyResult
from sim_core.scenario import Scenario
from sim_core.simulate import simulate
from sim_core.strategies import STRATEGIES

SHOWN = ("lv", "lqr", "passive")
BEFORE, BEHIND = 8.0, 22.0  # the bump's beginning, what is drawn of the road [m]
WIDTH, HEIGHT = 76, 5  # of a plot [characters]
# A character of Braille has four rows of two dots; U+2800 and these bits.
_DOTS = np.array([[0x01, 0x08], [0x02, 0x10], [0x04, 0x20], [0x40, 0x80]])
_FIRST = 34  # characters of a table's first column
_COMPARED = (("rough_road", "rms"), ("bump", "peak"))  # windows and statistics


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
    """The comparison over a scenario's bump."""
    bump, speed = scenario.road.bump, scenario.speed.initial_speed_kmh
    yield f"A car at {speed:g} km/h, a bump {bump.height:g} m high and {bump.length:g} m long, computed here."
    yield "The body's vertical acceleration over the road, one scale for all:"
    curves = {name: _near_bump(result, bump.start) for name, result in results.items()}
    most = max(float(np.abs(curve).max()) for curve in curves.values())
    for name, curve in curves.items():
        peak = results[name].metrics["bump"]["body_acceleration"]["peak"]
        speed = results[name].arrival_speed_kmh
        yield f"\n{STRATEGIES[name].label}: {peak:.2f} m/s^2 on the bump, met at {speed:.1f} km/h"
        yield from plot(curve, most)
    first, last = (round(WIDTH * x / (BEFORE + BEHIND)) for x in (BEFORE, BEFORE + bump.length))
    yield " " * first + "bump".center(last - first, "~") + "\n"
    yield from _table(results)


def plot(values: FloatArray, most: float) -> list[str]:
    """A curve as lines of Braille characters, `HEIGHT` of them.

    Args:
        values: At equal distances (samples,).
        most: The value at the upper edge; its negative is at the lower one.
    """
    dots = np.zeros((4 * HEIGHT, 2 * WIDTH), dtype=bool)
    rows = np.rint((1 - values / most) / 2 * (4 * HEIGHT - 1)).astype(int)
    for column, part in enumerate(np.array_split(rows, 2 * WIDTH)):
        dots[part.min() : part.max() + 1, column] = True
    cells = dots.reshape(HEIGHT, 4, WIDTH, 2).transpose(0, 2, 1, 3)
    return ["".join(chr(0x2800 + int((cell * _DOTS).sum())) for cell in line) for line in cells]


def _near_bump(result: StrategyResult, start: float) -> FloatArray:
    """The body acceleration at equal distances around the bump [m/s^2]."""
    position = np.linspace(start - BEFORE, start + BEHIND, 20 * WIDTH)
    return np.interp(position, result.series["position"], result.series["body_acceleration"])


def _table(results: dict[str, StrategyResult]) -> Iterator[str]:
    yield f"{'change against Passive':{_FIRST}}" + "".join(f"{STRATEGIES[name].label:>16}" for name in results)
    for window, statistic in _COMPARED:
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
