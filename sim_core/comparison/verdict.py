"""The verdict of a comparison: the best strategy by metric, and as text."""

from collections.abc import Mapping, Sequence
from dataclasses import dataclass

from sim_core.comparison.ranking import Ranking
from sim_core.comparison.rows import Row
from sim_core.comparison.sentences import sentences


@dataclass(frozen=True, slots=True, kw_only=True)
class Verdict:
    """The verdict of a comparison: the best strategy by metric, and as text.

    Attributes:
        text: Whole sentences: who is best in how many of the paper's metrics, by how much one that it is best in
            differs from the baseline's, and at which speed each was driven.
        best: Metric -> the strategy that is lower than every other one beyond random variation; None where none is. Of
            the paper's eight metrics those that every simulated strategy has.
        mixed: Whether every strategy has a metric in which another one is lower beyond random variation.

    Example:
        >>> from sim_core import Road, Scenario, compare, simulate
        >>> smooth = Scenario(road=Road(roughness=0))
        >>> verdict = compare({name: simulate(smooth, name) for name in ("speed_only", "passive")}).verdict
        >>> verdict.best["rough_road.front_tyre_load.rms"], verdict.best["bump.front_tyre_load.peak"], verdict.mixed
        ('passive', 'speed_only', True)
    """

    text: str
    best: Mapping[str, str | None]
    mixed: bool


def verdict_on(rows: Sequence[Row], baseline: Row | None) -> Verdict:
    """Return the verdict on the strategies of a comparison.

    Args:
        rows: One for each strategy; their order is of no account.
        baseline: What changes refer to; None where it failed.
    """
    ranking = Ranking(rows)
    return Verdict(
        text=" ".join(sentences(ranking, rows, baseline)),
        best={metric: None if best is None else best.key for metric, best in ranking.best.items()},
        mixed=len(ranking.rows) > 1 and bool(ranking.metrics) and not ranking.never_worse,
    )
