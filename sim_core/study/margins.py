"""How much worse LQR is than LV, against the paper's Tables 9-10, and every control against the passive car.

The rule is fixed before the numbers: mean over the seeds of each strategy's metric, then the change of the means;
a cell is reached if the change is at least the paper's. Nothing is tuned to reach one.
"""

from collections.abc import Callable, Iterable
from dataclasses import dataclass
from statistics import fmean

from sim_core.scenario import Scenario
from sim_core.simulate import simulate
from sim_core.strategies import STRATEGIES
from sim_core.study.paper_tables import cells

# Changes "LQR vs. LV" of Tables 9 (rough road RMS) and 10 (bump peak), in %, by window, statistic and signal; the one
# that is misprinted as its absolutes have it.
PAPER_MARGINS = {(cell.window, cell.statistic, cell.signal): cell.claim for cell in cells() if cell.strategy == "lqr"}

# strategy -> (window, statistic, signal) -> mean over the seeds
Means = dict[str, dict[tuple[str, str, str], float]]


@dataclass(frozen=True, slots=True, kw_only=True)
class Margin:
    """One cell: how much worse LQR is than LV [%], the paper's figure, and whether ours is at least that."""

    window: str
    statistic: str
    signal: str
    paper: float
    ours: float

    @property
    def reached(self) -> bool:
        """Ours is at least the paper's."""
        return self.ours >= self.paper


def mean_metrics(scenario: Scenario, seeds: Iterable[int], report: Callable[[int], None] = lambda seed: None) -> Means:
    """Run every strategy over each seed's road and average the cells of Tables 9-10."""
    found: dict[str, dict[tuple[str, str, str], list[float]]] = {
        name: {cell: [] for cell in PAPER_MARGINS} for name in STRATEGIES
    }
    for seed in seeds:
        road = scenario.road.model_copy(update={"seed": seed})
        seeded = scenario.model_copy(update={"road": road})
        for name, values in found.items():
            metrics = simulate(seeded, name).metrics
            for window, statistic, signal in PAPER_MARGINS:
                values[window, statistic, signal].append(metrics[window][signal][statistic])
        report(seed)
    return {name: {cell: fmean(values) for cell, values in each.items()} for name, each in found.items()}


def margins(means: Means) -> list[Margin]:
    """The eight cells."""
    return [
        Margin(
            window=window,
            statistic=statistic,
            signal=signal,
            paper=paper,
            ours=change(means["lqr"][window, statistic, signal], means["lv"][window, statistic, signal]),
        )
        for (window, statistic, signal), paper in PAPER_MARGINS.items()
    ]


def change(value: float, base: float) -> float:
    """Change against a base [%]; NaN against a zero base."""
    return (value / base - 1) * 100 if base else float("nan")
