"""The paper's claims against ours: the runs they need, verdicts by rule.

The rules are fixed before any number (docs/explanation/paper.md); nothing is tuned to reach a cell.
"""

from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from enum import StrEnum
from typing import Any

from backend.paper.interpretations import DATA, OPEN_QUESTIONS, TYRE_LOADS, changes_of
from backend.paper.tables import PaperCell, cells
from sim_core.catalogue import PAPER_SIGNALS, PAPER_VIEWS
from sim_core.comparison.intervals import Interval, change_with_interval
from sim_core.metrics.evaluate import rms_between
from sim_core.result import StrategyResult
from sim_core.scenario import Scenario, dotted
from sim_core.speed.profile import make_speed_profile
from sim_core.strategies import strategy_named

SEEDS = 20  # roads 1 to this
STRATEGIES = ("passive", "speed_only", "suspension_only", "lv", "lv_hil", "lqr")
IN_ECU = "lv_hil"  # the one that needs the ECU's program
SIMULATED = tuple(name for name in STRATEGIES if name != IN_ECU)
PREVIEWED = ("suspension_only", "lv", "lv_hil")  # those whose controller looks ahead
WINDOW = "window"  # the question that changes no run, only where its RMS are taken
WITHOUT_RUNS = (WINDOW, TYRE_LOADS)  # those that change no run
HIL_TOLERANCE = 8.0  # a HIL cell is reached within this of the simulation, either way [%]
AGREEMENT = 10.0  # a simulated change agrees with the printed one within this, either way [percentage points]
FIGURES = tuple((window, statistic, signal) for window, statistic in PAPER_VIEWS for signal in PAPER_SIGNALS)

# strategy -> (window, statistic, signal) -> a value for each seed
Values = Mapping[str, Mapping[tuple[str, str, str], Sequence[float]]]


class Verdict(StrEnum):
    """The verdict on a printed change."""

    REACHED = "reached"
    SMALLER = "smaller"
    CONTRADICTS = "contradicts"


RULES = {name: text.format(hil=HIL_TOLERANCE, agreement=AGREEMENT) for name, text in DATA["rules"].items()}


def verdict(claim: float, ours: float, *, hil: bool) -> Verdict:
    """The verdict on a claimed change [%] by ours [%]; NaN contradicts.

    Args:
        claim: The paper's change.
        ours: Our change.
        hil: Whether it is hardware in the loop against the simulation.
    """
    if hil:
        return Verdict.REACHED if abs(ours) <= HIL_TOLERANCE else Verdict.CONTRADICTS
    if not ours * claim > 0:
        return Verdict.CONTRADICTS
    return Verdict.REACHED if abs(ours) >= abs(claim) else Verdict.SMALLER


@dataclass(frozen=True, slots=True, kw_only=True)
class Judged:
    """One printed change with ours beside it; `value` is the strategy's mean over the seeds, SI."""

    cell: PaperCell
    value: float
    change: Interval
    verdict: Verdict
    certain: bool


def judge(values: Values) -> list[Judged]:
    """Every cell of the paper's comparing tables whose two strategies have values, judged."""
    return [_judged(cell, values) for cell in cells() if {cell.strategy, cell.against} <= values.keys()]


def _judged(cell: PaperCell, values: Values) -> Judged:
    figure = (cell.window, cell.statistic, cell.signal)
    ours, base = values[cell.strategy][figure], values[cell.against][figure]
    change = change_with_interval(ours, base)
    hil = cell.strategy == IN_ECU
    judgement = verdict(cell.claim, change.value, hil=hil)
    ends = {verdict(cell.claim, end, hil=hil) for end in (change.low, change.high)}
    return Judged(
        cell=cell,
        value=sum(ours) / len(ours),
        change=change,
        verdict=judgement,
        certain=ends == {judgement},
    )


def count(judged: Sequence[Judged]) -> dict[str, int]:
    """Count the cells with each verdict."""
    return {each.value: sum(item.verdict is each for item in judged) for each in Verdict}


def split(judged: Sequence[Judged]) -> tuple[list[Judged], list[Judged]]:
    """The changes we simulate, and those of hardware in the loop, which the ±8 % rule is for."""
    in_ecu = [item for item in judged if item.cell.strategy == IN_ECU]
    return [item for item in judged if item.cell.strategy != IN_ECU], in_ecu


def scenario_for(choices: Mapping[str, str], seed: int) -> Scenario:
    """The paper's scenario under these choices (question -> choice; others take their default) on one road.

    Raises:
        UnknownNameError: No such question or choice.
    """
    changes: dict[str, Any] = {**changes_of(choices), "road.seed": seed}
    return Scenario.model_validate(dotted.with_changes(Scenario().model_dump(mode="json"), changes))


def figures_of(result: StrategyResult) -> list[float]:
    """The eight figures of one run, in the order of FIGURES."""
    return [result.metrics[window][signal][statistic] for window, statistic, signal in FIGURES]


def figures_by_window(scenario: Scenario, result: StrategyResult) -> dict[str, list[float]]:
    """`figures_of` a run under each choice of the question `window`."""
    own, figures = figures_of(result), {}
    for choice in OPEN_QUESTIONS[WINDOW].choices:
        if choice.intervals is None:
            figures[choice.id] = own
            continue
        rms = rms_between(
            result.series, make_speed_profile(scenario, strategy_named(result.strategy).speed_plan), choice.intervals
        )
        figures[choice.id] = [
            rms[signal] if window == "rough_road" else value
            for (window, _, signal), value in zip(FIGURES, own, strict=True)
        ]
    return figures
