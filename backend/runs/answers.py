"""What is answered of a stored run: each strategy's result, over several roads with mean, interval and change."""

from collections.abc import Mapping, Sequence
from math import isfinite
from typing import Any

from backend.runs.work import Outcome
from backend.store import StoredResult, StoredRun
from sim_core.study.intervals import Interval
from sim_core.study.roads import Comparison, Numbers, compare, numbers

_FAILED: Mapping[str, Any] = {"kind": "refused", "fields": []}  # defaults, which the summary may override


def run_answer(
    stored: StoredRun, *, cached: Mapping[str, bool] | None = None, baseline: str | None = None
) -> dict[str, Any]:
    """`Run` or `RoadsRun`; `CreatedRun` or `CreatedRoadsRun` where it is known what was cached.

    Args:
        stored: The run.
        cached: By strategy whether it was.
        baseline: What the changes over several roads refer to; None is the run's own.
    """
    head = {"id": stored.id, "core_version": stored.core_version, "scenario": stored.scenario}
    cache_field = {name: {} if cached is None else {"cached": cached[name]} for name in stored.by_strategy}
    if stored.roads == 1:
        return {
            **head,
            "strategies": {item.strategy: _entry(item, cache_field[item.strategy]) for item in stored.results},
        }
    against = baseline or stored.baseline or ""
    driven = {
        name: [numbers(item.summary["metrics"], item.summary["comfort"]) for item in stored.by_strategy[name]]
        for name in (item.strategy for item in stored.shown)
    }
    found = compare(driven, against)
    return {
        **head,
        "roads": stored.roads,
        "baseline": against,
        "changes": {name: _plain(change) for name, change in found.changes.items()},
        "strategies": {
            name: _entry_over_roads(items, cache_field[name], found, stored.scenario["road"]["seed"])
            for name, items in stored.by_strategy.items()
        },
    }


def entry_answer(outcome: Outcome, *, cached: bool) -> dict[str, Any]:
    """One strategy's part of a run that is not stored."""
    return _entry(outcome, {"cached": cached})


def default_baseline(strategies: Sequence[str]) -> str:
    """What changes refer to where nobody says: passive, or the first strategy where it does not run."""
    return "passive" if "passive" in strategies else strategies[0]


def _entry(item: Outcome | StoredResult, cache_field: Mapping[str, bool]) -> dict[str, Any]:
    head: dict[str, Any] = {"status": item.status, **cache_field, "compute_ms": item.compute_ms}
    return {**head, **(_FAILED if item.status == "failed" else {}), **item.summary}


def _entry_over_roads(
    items: Sequence[StoredResult], cache_field: Mapping[str, bool], found: Comparison, first_seed: int
) -> dict[str, Any]:
    """The first road's entry with the means of all, or why one of them failed."""
    head = {**_entry(items[0], cache_field), "compute_ms": round(sum(item.compute_ms for item in items), 2)}
    failures = [(seed, item) for seed, item in enumerate(items, first_seed) if item.status != "ok"]
    if failures:
        seed, failure = failures[0]
        reason = f"Road seed {seed}: {failure.summary['reason']}"
        return {**_entry(failure, cache_field), "compute_ms": head["compute_ms"], "reason": reason}
    means = _plain(found.means[items[0].strategy])
    return {**head, "comfort": means.pop("comfort"), "metrics": means}


def _plain(part: Numbers) -> dict[str, Any]:
    """Intervals as JSON; null where there is none."""
    return {key: _interval(value) if isinstance(value, Interval) else _plain(value) for key, value in part.items()}


def _interval(interval: Interval) -> dict[str, float] | None:
    if not isfinite(interval.value):
        return None
    return {"mean": interval.value, "low": interval.low, "high": interval.high}
