"""The rows of a comparison: each strategy's metrics on every road, and the changes between two strategies."""

from collections.abc import Iterable, Mapping, Sequence
from dataclasses import dataclass
from functools import cached_property
from math import isfinite
from typing import Any

import numpy as np

from sim_core.arrays import FloatArray
from sim_core.catalogue import METRICS, SHOWN_UNITS
from sim_core.comparison.change import Change, change_on_one_road, change_over_roads
from sim_core.comparison.intervals import changes_with_intervals
from sim_core.comparison.variation import one_road_resolution, variation_of_one_road
from sim_core.scenario.recorded import recording_id
from sim_core.strategies import label_of

# Neither counts of events nor the speed at the bump.
LOWER_IS_BETTER = tuple(
    key for key, metric in METRICS.items() if metric.path[0] in ("metrics", "comfort") or key == "travel_time"
)
_SPEED = METRICS["arrival_speed_kmh"]
_SCALES = {key: SHOWN_UNITS.get(METRICS[key].unit, ("", 1.0))[1] for key in LOWER_IS_BETTER}


@dataclass(frozen=True, eq=False, kw_only=True)
class Row:
    """One strategy of a comparison.

    Attributes:
        key: Its name among the results that are compared.
        strategy: The id of the strategy that was driven.
        label: What sentences call it.
        values: Metric -> its value on each road [SI unit]; metrics that it does not have on every road are left out.
        speed: At the bump [km/h], the same on every road; None where it was not recorded.
        is_random: Whether another seed would give other values.
    """

    key: str
    strategy: str
    label: str
    values: Mapping[str, Sequence[float]]
    speed: float | None
    is_random: bool

    @property
    def is_recorded(self) -> bool:
        """Check whether it is a recorded drive."""
        return recording_id(self.strategy) is not None

    @cached_property
    def means(self) -> Mapping[str, float]:
        """Return the mean of each metric over the roads [SI unit]."""
        return {metric: sum(values) / len(values) for metric, values in self.values.items()}

    @cached_property
    def resolution(self) -> Mapping[str, float]:
        """Return by statistic the smallest change that one road tells from random variation [%]."""
        return one_road_resolution(self.strategy)


def labels_of(strategies: Iterable[str]) -> dict[str, str]:
    """Return what sentences call strategies, by id: recorded drives, whose files' names are not known, by number."""
    ids = list(dict.fromkeys(strategies))
    recorded = sorted(name for name in ids if recording_id(name) is not None)
    if len(recorded) == 1:
        drives = {recorded[0]: "the recorded drive"}
    else:
        drives = {name: f"recorded drive {number}" for number, name in enumerate(recorded, 1)}
    return {name: drives.get(name) or label_of(name) for name in ids}


def row_of(
    strategy: str,
    summaries: Sequence[Mapping[str, Any]],
    *,
    is_random: bool,
    metrics: Iterable[str] = LOWER_IS_BETTER,
    key: str | None = None,
    label: str | None = None,
) -> Row:
    """Return the row of a strategy.

    Args:
        strategy: The id of the strategy that was driven.
        summaries: `StrategyResult.summary()` on each road.
        is_random: Whether another seed would give other values (`Scenario.is_random`); a recorded drive's always would.
        metrics: Flat names of those that are compared.
        key: Its name among the results that are compared; None is the id.
        label: What sentences call it; None is the strategy's label.
    """
    columns = {metric: [METRICS[metric].of(summary) for summary in summaries] for metric in metrics}
    values = {metric: column for metric, column in columns.items() if column and all(map(_is_number, column))}
    speed = _SPEED.of(summaries[0]) if summaries else None
    return Row(
        key=strategy if key is None else key,
        strategy=strategy,
        label=label_of(strategy) if label is None else label,
        values=values,
        speed=speed if _is_number(speed) else None,
        is_random=is_random or recording_id(strategy) is not None,
    )


def changes_between(row: Row, baseline: Row, metrics: Iterable[str] = LOWER_IS_BETTER) -> dict[str, Change]:
    """Return the change of each metric of `row` against `baseline`; metrics that only one of them has are left out."""
    both = [metric for metric in metrics if metric in row.values and metric in baseline.values]
    if both and len(row.values[both[0]]) > 1:
        intervals = changes_with_intervals(_table(row, both), _table(baseline, both))
        return {
            metric: change_over_roads(interval, row.means[metric], baseline.means[metric], scale=_SCALES[metric])
            for metric, interval in zip(both, intervals, strict=True)
        }
    is_random, resolutions = row.is_random or baseline.is_random, (row.resolution, baseline.resolution)
    return {
        metric: change_on_one_road(
            row.values[metric][0],
            baseline.values[metric][0],
            scale=_SCALES[metric],
            variation=variation_of_one_road(metric, resolutions) if is_random else 0.0,
        )
        for metric in both
    }


def changes_by_key(rows: Iterable[Row], others: Iterable[Row]) -> dict[str, dict[str, Change]]:
    """Return by key the changes of rows against those of the same key of another run; of keys that both have."""
    references = {row.key: row for row in others}
    return {row.key: changes_between(row, references[row.key]) for row in rows if row.key in references}


def _table(row: Row, metrics: Sequence[str]) -> FloatArray:
    """Return the values as columns of metrics (roads, metrics) [SI units]."""
    return np.array([row.values[metric] for metric in metrics], dtype=np.float64).T


def _is_number(value: object) -> bool:
    return isinstance(value, int | float) and isfinite(value)
