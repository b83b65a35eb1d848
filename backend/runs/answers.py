"""The answers about a stored run: each strategy's result, over several roads with mean, interval and change."""

from collections.abc import Mapping, Sequence
from math import isfinite

from backend.analysis.intervals import Interval
from backend.analysis.roads import Changes, Comparison, Numbers, compare, numbers, paired_changes
from backend.errors import InvalidError
from backend.json_types import JsonObject
from backend.models import CreatedRun, LiveRun, Run
from backend.runs.roads_models import CreatedRoadsRun, PairedChanges, RoadsRun
from backend.runs.work import ComputedResult
from backend.store import StoredResult, StoredRun
from sim_core import __version__ as CORE_VERSION
from sim_core.scenario import Scenario


def run_answer(stored: StoredRun, *, baseline: str | None = None) -> Run | RoadsRun:
    """A stored run; `baseline` is what the changes over several roads refer to, by default the run's own."""
    no_fields: dict[str, JsonObject] = {name: {} for name in stored.by_strategy}
    if stored.roads == 1:
        return Run(**_on_one_road(stored, no_fields))
    return RoadsRun(**_over_roads(stored, no_fields, baseline or stored.baseline or ""))


def created_answer(stored: StoredRun, cached: Mapping[str, bool]) -> CreatedRun | CreatedRoadsRun:
    """The answer to the request that created a run; `cached` says by strategy what was not computed for it."""
    fields = {name: {"cached": value} for name, value in cached.items()}
    if stored.roads == 1:
        return CreatedRun(**_on_one_road(stored, fields))
    return CreatedRoadsRun(**_over_roads(stored, fields, stored.baseline or ""))


def live_answer(
    scenario: Scenario, outcomes: Mapping[str, ComputedResult], fields: Mapping[str, JsonObject]
) -> LiveRun:
    """A run that is not stored; `fields` holds what each strategy has beside its metrics."""
    entries = {name: _entry(outcome, fields[name]) for name, outcome in outcomes.items()}
    return LiveRun(core_version=CORE_VERSION, scenario=scenario, strategies=entries)


def changes_to_strategy(stored: StoredRun, baseline: str) -> PairedChanges:
    """What the strategies of a run over several roads change against one of them.

    Raises:
        InvalidError: The run is of one road, or that strategy did not succeed in it.
    """
    _check_several(stored)
    driven = _driven(stored)
    if baseline not in driven:
        message = f"This run has {', '.join(driven) or 'no strategy'}; the baseline is one of them"
        raise InvalidError(message, parameter="baseline")
    changes = compare(driven, baseline).changes
    return PairedChanges(against=None, baseline=baseline, roads=stored.roads, changes=_plain_changes(changes))


def changes_to_run(stored: StoredRun, against: StoredRun) -> PairedChanges:
    """What a run over several roads changes against another one, strategy by strategy.

    Raises:
        InvalidError: They are not of the same roads, or not of the same core version.
    """
    seeds = [run.scenario["road"]["seed"] for run in (stored, against)]
    if (against.roads, seeds[1]) != (stored.roads, seeds[0]):
        message = f"Number of roads: {against.roads} from seed {seeds[1]}; of this run {stored.roads} from {seeds[0]}"
        raise InvalidError(message + ": changes are of the same roads", parameter="against")
    _check_several(stored)
    if against.core_version != stored.core_version:
        message = f"Core {against.core_version} computed it, {stored.core_version} this run: request it again"
        raise InvalidError(message, parameter="against")
    changes = paired_changes(_driven(stored), _driven(against))
    return PairedChanges(against=against.id, baseline=None, roads=stored.roads, changes=_plain_changes(changes))


def _check_several(stored: StoredRun) -> None:
    if stored.roads == 1:
        raise InvalidError("This run is of one road: a change has no interval", parameter="id")


def default_baseline(strategies: Sequence[str]) -> str:
    """The default baseline of changes: passive, or the first strategy where passive is not run."""
    return "passive" if "passive" in strategies else strategies[0]


def _head(stored: StoredRun) -> JsonObject:
    return {"id": stored.id, "core_version": stored.core_version, "scenario": stored.scenario}


def _on_one_road(stored: StoredRun, fields: Mapping[str, JsonObject]) -> JsonObject:
    return _head(stored) | {
        "strategies": {item.strategy: _entry(item, fields[item.strategy]) for item in stored.results}
    }


def _over_roads(stored: StoredRun, fields: Mapping[str, JsonObject], baseline: str) -> JsonObject:
    comparison = compare(_driven(stored), baseline)
    first_seed = stored.scenario["road"]["seed"]
    return _head(stored) | {
        "roads": stored.roads,
        "baseline": baseline,
        "changes": _plain_changes(comparison.changes),
        "strategies": {
            name: _entry_over_roads(items, fields[name], comparison, first_seed)
            for name, items in stored.by_strategy.items()
        },
    }


def _driven(stored: StoredRun) -> dict[str, list[Numbers]]:
    """By strategy that succeeded on every road its numbers on each."""
    return {
        name: [numbers(item.summary["metrics"], item.summary["comfort"]) for item in stored.by_strategy[name]]
        for name in (item.strategy for item in stored.shown)
    }


def _entry(item: ComputedResult | StoredResult, fields: JsonObject) -> JsonObject:
    """One strategy's result or failure: its summary is answered as it was stored."""
    return {"status": item.status, "compute_ms": item.compute_ms, **fields, **item.summary}


def _entry_over_roads(
    items: Sequence[StoredResult], fields: JsonObject, comparison: Comparison, first_seed: int
) -> JsonObject:
    """The first road's entry with the means of all, or why one of them failed."""
    compute_ms = round(sum(item.compute_ms for item in items), 2)
    failures = [(seed, item) for seed, item in enumerate(items, first_seed) if item.status != "ok"]
    if failures:
        seed, failure = failures[0]
        reason = f"Road seed {seed}: {failure.summary['reason']}"
        return {**_entry(failure, fields), "compute_ms": compute_ms, "reason": reason}
    means = _plain(comparison.means[items[0].strategy])
    return {**_entry(items[0], fields), "compute_ms": compute_ms, "comfort": means.pop("comfort"), "metrics": means}


def _plain_changes(changes: Changes) -> JsonObject:
    return {name: _plain(change) for name, change in changes.items()}


def _plain(part: Numbers) -> JsonObject:
    """Intervals as JSON; null where there is none."""
    return {key: _interval(value) if isinstance(value, Interval) else _plain(value) for key, value in part.items()}


def _interval(interval: Interval) -> dict[str, float] | None:
    if not isfinite(interval.value):
        return None
    return {"mean": interval.value, "low": interval.low, "high": interval.high}
