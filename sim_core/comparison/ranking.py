"""The ranking of strategies in each metric, beyond random variation."""

from collections.abc import Iterable, Mapping, Sequence
from functools import cached_property

from sim_core.catalogue import PAPER_METRICS
from sim_core.comparison.change import Change
from sim_core.comparison.rows import Row, changes_between
from sim_core.strategies import STRATEGIES


class Ranking:
    """The ranking of the simulated strategies in the metrics that all of them have.

    Args:
        rows: All rows of a comparison, in any order. Recorded drives take no part: nobody chooses them for a car.
    """

    def __init__(self, rows: Sequence[Row]) -> None:
        self.rows = in_catalogue_order(row for row in rows if not row.is_recorded)
        shared = [metric for metric in PAPER_METRICS if all(metric in row.values for row in self.rows)]
        self.metrics = shared if self.rows else []
        self._changes: dict[tuple[str, str], dict[str, Change]] = {}

    def is_better(self, one: Row, other: Row, metric: str) -> bool:
        """Check whether one is lower than the other beyond random variation, whichever of both is the baseline."""
        if one is other or one.means[metric] >= other.means[metric]:
            return False
        return all(self._change(*pair, metric).beyond_variation for pair in ((one, other), (other, one)))

    def _change(self, row: Row, baseline: Row, metric: str) -> Change:
        pair = row.key, baseline.key
        if pair not in self._changes:
            self._changes[pair] = changes_between(row, baseline, self.metrics)
        return self._changes[pair][metric]

    @cached_property
    def undominated(self) -> Mapping[str, tuple[Row, ...]]:
        """Metric -> the strategies that no other one is better than."""
        return {metric: self._undominated(metric) for metric in self.metrics}

    def _undominated(self, metric: str) -> tuple[Row, ...]:
        in_turn = sorted(self.rows, key=lambda row: row.means[metric])  # the lowest is better than most: asked first
        return tuple(row for row in self.rows if not any(self.is_better(other, row, metric) for other in in_turn))

    @cached_property
    def best(self) -> Mapping[str, Row | None]:
        """Metric -> the strategy that is better than every other one."""
        return {metric: self._best(metric, rows) for metric, rows in self.undominated.items()}

    def _best(self, metric: str, undominated: Sequence[Row]) -> Row | None:
        if len(self.rows) < 2 or len(undominated) > 1:
            return None
        best, others = undominated[0], [row for row in self.rows if row is not undominated[0]]
        return best if all(self.is_better(best, other, metric) for other in others) else None

    @cached_property
    def never_worse(self) -> Sequence[Row]:
        """The strategies that no other one is better than in any metric."""
        return [row for row in self.rows if all(row in rows for rows in self.undominated.values())]

    def wins(self, row: Row) -> int:
        """Return in how many metrics a strategy is better than every other one."""
        return sum(best is row for best in self.best.values())

    @cached_property
    def winner(self) -> Row | None:
        """The strategy that is best on the whole: the only one that is never worse, or best in most metrics."""
        if len(self.never_worse) == 1:
            return self.never_worse[0] if self.wins(self.never_worse[0]) else None
        most = max(self.rows, key=self.wins, default=None)
        return most if most is not None and 2 * self.wins(most) > len(self.metrics) else None


def in_catalogue_order(rows: Iterable[Row]) -> list[Row]:
    """Return the rows in the catalogue's order of strategies, others behind by id."""
    places = {name: place for place, name in enumerate(STRATEGIES)}
    return sorted(rows, key=lambda row: (places.get(row.strategy, len(places)), row.strategy, row.key))
