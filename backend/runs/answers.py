"""The answers about a stored run: each strategy's result, over several roads with mean, interval and change.

They have the shapes of `backend.models` and `backend.runs.models`; what is stored as JSON goes in as it is.
Over 50 roads they take 0.2 s: they are made in threads, beside the event loop.
"""

from collections.abc import Callable, Collection, Mapping, Sequence
from dataclasses import asdict, replace
from hashlib import sha256
from math import isfinite
from threading import Lock

import cachetools
import orjson

from backend.errors import InvalidError
from backend.json_types import JsonObject
from backend.means_over_roads import Changes, Numbers, OverRoads, means_and_changes, numbers, paired_changes
from backend.outcome import Outcome
from backend.requirements import Driven, Requirement, judge
from backend.runs import series
from backend.store import StoredRun
from sim_core import __version__ as CORE_VERSION
from sim_core.catalogue import PAPER_METRICS
from sim_core.comparison.caution import Caution
from sim_core.comparison.change import Change
from sim_core.comparison.compare import Comparison, compare_summaries, default_baseline
from sim_core.comparison.intervals import Interval
from sim_core.comparison.rows import Row, changes_between, row_of
from sim_core.scenario import Scenario, characteristics
from sim_core.strategies import find_strategy, label_of

WRITTEN_FACTS = 128  # runs, and ways to compare them, whose facts are kept; at most 0.1 MB each


def run_answer(
    stored: StoredRun,
    *,
    cached: Mapping[str, bool] | None = None,
    requirements: Sequence[Requirement] = (),
    baseline: str | None = None,
    compared: Collection[str] | None = None,
) -> JsonObject:
    """Return the answer about a stored run, for orjson.

    Args:
        stored: The run, its scenario today's.
        cached: To the request that created it, by strategy whether nothing of it was computed for that one.
        requirements: What its strategies are held to.
        baseline: The strategy that all changes refer to, those of requirements too; None is the run's own.
        compared: The strategies that `comparison` is of, beside its baseline; None is all.
    """
    fields: dict[str, JsonObject] = {name: {} for name in stored.by_strategy}
    if cached is not None:
        fields = {name: {"cached": value} for name, value in cached.items()}
    for name, (first, *_) in stored.by_strategy.items():
        if first.core_version not in (None, stored.core_version):
            fields[name]["core_version"] = first.core_version
    head: JsonObject = {
        "id": stored.id,
        "core_version": stored.core_version,
        "scenario": stored.scenario,
        **_written_facts(stored, baseline, compared),
    }
    if requirements:
        head["requirement_results"] = _judged(stored, requirements, baseline)
    if stored.roads == 1:
        return head | {
            "strategies": {name: item.answer(**fields[name]) for name, (item,) in stored.by_strategy.items()}
        }
    baseline = baseline or stored.baseline or ""
    over_roads = means_and_changes(_driven(stored), baseline)
    return head | {
        "roads": stored.roads,
        "baseline": baseline,
        "changes": _plain_changes(over_roads.changes),
        "strategies": {
            name: _entry_over_roads(items, fields[name], over_roads, stored.scenario["road"]["seed"])
            for name, items in stored.by_strategy.items()
        },
    }


def _facts_key(stored: StoredRun, baseline: str | None, compared: Collection[str] | None) -> tuple[object, ...]:
    """Return what facts depend on: a digest of a run and its comparison, and the controllers, which have labels."""
    results = [
        (name, item.status, item.core_version or stored.core_version, orjson.Fragment(item.json))
        for name, items in stored.by_strategy.items()
        for item in items
    ]
    against = baseline or stored.baseline
    selected = None if compared is None else sorted(compared)
    content = orjson.dumps((stored.core_version, stored.scenario, stored.roads, against, selected, results))
    return (sha256(content).digest(), *map(find_strategy, stored.by_strategy))


@cachetools.cached(cachetools.LRUCache(WRITTEN_FACTS), _facts_key, Lock())
def _written_facts(
    stored: StoredRun, baseline: str | None, compared: Collection[str] | None
) -> dict[str, orjson.Fragment]:
    """Return the facts of a stored run as JSON: to compare takes longer than all else of a stored run's answer."""
    scenario = Scenario.model_validate(stored.scenario)
    comparison = comparison_of(stored, scenario, baseline, compared)
    facts = {
        "characteristics": asdict(characteristics(scenario.vehicle)),
        "cautions": comparison.cautions,
        "comparison": comparison,
    }
    return {name: orjson.Fragment(orjson.dumps(value)) for name, value in facts.items()}


def comparison_of(
    stored: StoredRun, scenario: Scenario, baseline: str | None, compared: Collection[str] | None = None
) -> Comparison:
    """Return what the strategies that succeeded on every road mean beside each other."""
    names = list(stored.by_strategy)
    against = baseline or stored.baseline or default_baseline(names)
    summaries = {
        item.strategy: [each.summary for each in stored.by_strategy[item.strategy]]
        for item in stored.shown
        if compared is None or item.strategy == against or item.strategy in compared
    }
    comparison = compare_summaries(summaries, against, scenario)
    # Those had failed with the run's core version.
    others = [item for item in stored.shown if item.core_version not in (None, stored.core_version)]
    cautions = tuple(_other_version(item, stored) for item in others if item.strategy in summaries)
    return replace(comparison, cautions=(*comparison.cautions, *cautions)) if cautions else comparison


def _other_version(item: Outcome, stored: StoredRun) -> Caution:
    """Return the caution about a strategy that another core version than the run's has computed."""
    text = (
        f"{label_of(item.strategy)} was computed by core {item.core_version}, the other strategies by core "
        f"{stored.core_version}: part of a difference may come from that."
    )
    return Caution(kind="core_version", text=text, strategy=item.strategy)


def _judged(stored: StoredRun, requirements: Sequence[Requirement], baseline: str | None) -> list[JsonObject]:
    driven: dict[str, Driven] = {}
    for name, items in stored.by_strategy.items():
        failed = next((item for item in items if item.status != "ok"), None)
        driven[name] = [item.summary for item in items] if failed is None else failed.summary["reason"]
    return [result.model_dump() for result in judge(requirements, driven, baseline or _named_baseline(stored))]


def _named_baseline(stored: StoredRun) -> str | None:
    """The run's own baseline where it is none that nobody named."""
    return None if stored.baseline == default_baseline(list(stored.by_strategy)) else stored.baseline


def as_plain(answer: JsonObject) -> JsonObject:
    """An answer as Python values throughout."""
    plain: JsonObject = orjson.loads(orjson.dumps(answer))
    return plain


def live_json(
    scenario: Scenario, outcomes: Mapping[str, Outcome], signals: Sequence[str], baseline: str | None
) -> bytes:
    """Return a run that is not stored, with the time histories of these signals in base64.

    Args:
        scenario: What was driven.
        outcomes: By strategy.
        signals: Whose time histories are in it.
        baseline: What the changes of `comparison` refer to; None is passive, or the first strategy.
    """

    def typed(values: series.SeriesArray) -> JsonObject:
        return {key: series.packed(values[series.ROWS[key]]) for key in signals}

    return _live(scenario, outcomes, typed, baseline)


def live_binary(
    scenario: Scenario, outcomes: Mapping[str, Outcome], signals: Sequence[str], baseline: str | None
) -> bytes:
    """Return the same in a third less: the length of its JSON (uint32), the JSON, all numbers as little-endian float32.

    JSON has `signals` and `samples` of each strategy that succeeded, whose numbers follow each other in its order. They
    begin at a multiple of four bytes, as spaces end the JSON.
    """
    numbers: list[bytes] = []

    def described(values: series.SeriesArray) -> JsonObject:
        numbers.append(values[[series.ROWS[key] for key in signals]].astype("<f4", copy=False).tobytes())
        return {"signals": signals, "samples": values.shape[1]}

    head = _live(scenario, outcomes, described, baseline)
    head += b" " * (-len(head) % 4)
    return b"".join((len(head).to_bytes(4, "little"), head, *numbers))


def _live(
    scenario: Scenario,
    outcomes: Mapping[str, Outcome],
    described: Callable[[series.SeriesArray], JsonObject],
    baseline: str | None,
) -> bytes:
    def entry(outcome: Outcome) -> orjson.Fragment:
        values = outcome.series
        return outcome.answer(cached=outcome.cached, **({} if values is None else {"series": described(values)}))

    strategies = {name: entry(outcome) for name, outcome in outcomes.items()}
    comparison = compare_summaries(
        {name: [outcome.summary] for name, outcome in outcomes.items() if outcome.status == "ok"},
        baseline or default_baseline(list(outcomes)),
        scenario,
        metrics=PAPER_METRICS,
    )
    head = {
        "core_version": CORE_VERSION,
        "scenario": scenario.model_dump(mode="json"),
        "characteristics": asdict(characteristics(scenario.vehicle)),
        "cautions": comparison.cautions,
        "comparison": comparison,
    }
    return orjson.dumps(head | {"strategies": strategies})


def changes_to_strategy(stored: StoredRun, baseline: str) -> JsonObject:
    """Return the changes of a run over several roads against one of its strategies.

    Raises:
        InvalidError: The run is of one road, or that strategy did not succeed in it.
    """
    _check_several(stored)
    driven = _driven(stored)
    if baseline not in driven:
        message = f"This run has {', '.join(driven) or 'no strategy'}; the baseline is one of them"
        raise InvalidError(message, parameter="baseline")
    changes = _plain_changes(means_and_changes(driven, baseline).changes)
    return {"against": None, "baseline": baseline, "roads": stored.roads, "changes": changes}


def metric_changes(stored: StoredRun, against: StoredRun) -> dict[str, dict[str, Change]]:
    """Return by strategy and metric the changes of a run against another one, strategy by strategy.

    Raises:
        InvalidError: They are of several roads, and not of the same, or not of the same core version.
    """
    if (stored.roads, against.roads) != (1, 1):
        _check_same_roads(stored, against)
    rows, others = _rows(stored), _rows(against)
    return {name: changes_between(row, others[name]) for name, row in rows.items() if name in others}


def _rows(stored: StoredRun) -> dict[str, Row]:
    """Return the row of each strategy that succeeded on every road."""
    is_random = Scenario.model_validate(stored.scenario).is_random
    return {
        item.strategy: row_of(
            item.strategy, [each.summary for each in stored.by_strategy[item.strategy]], is_random=is_random
        )
        for item in stored.shown
    }


def changes_to_run(stored: StoredRun, against: StoredRun) -> JsonObject:
    """Return the changes of a run over several roads against another one, strategy by strategy.

    Raises:
        InvalidError: They are not of the same roads, or not of the same core version.
    """
    _check_same_roads(stored, against)
    changes = _plain_changes(paired_changes(_driven(stored), _driven(against)))
    return {"against": against.id, "baseline": None, "roads": stored.roads, "changes": changes}


def _check_same_roads(stored: StoredRun, against: StoredRun) -> None:
    seeds = [run.scenario["road"]["seed"] for run in (stored, against)]
    if (against.roads, seeds[1]) != (stored.roads, seeds[0]):
        message = f"Number of roads: {against.roads} from seed {seeds[1]}; of this run {stored.roads} from {seeds[0]}"
        raise InvalidError(message + ": changes are of the same roads", parameter="against")
    _check_several(stored)
    if against.core_version != stored.core_version:
        message = f"Core {against.core_version} computed it, {stored.core_version} this run: request it again"
        raise InvalidError(message, parameter="against")


def _check_several(stored: StoredRun) -> None:
    if stored.roads == 1:
        raise InvalidError("This run is of one road: a change has no interval", parameter="id")


def _driven(stored: StoredRun) -> dict[str, list[Numbers]]:
    """By strategy that succeeded on every road its numbers on each."""
    summaries = {item.strategy: [each.summary for each in stored.by_strategy[item.strategy]] for item in stored.shown}
    return {
        name: [numbers(each["metrics"], each["comfort"]) for each in of_roads] for name, of_roads in summaries.items()
    }


def _entry_over_roads(
    items: Sequence[Outcome], fields: JsonObject, over_roads: OverRoads, first_seed: int
) -> orjson.Fragment | JsonObject:
    """The first road's entry with the means of all, or why one of them failed."""
    compute_ms = round(sum(item.compute_ms for item in items), 2)
    failures = [(seed, item) for seed, item in enumerate(items, first_seed) if item.status != "ok"]
    if failures:
        seed, failure = failures[0]
        content = failure.summary
        content["reason"] = f"Road seed {seed}: {content['reason']}"
        return replace(failure, compute_ms=compute_ms, json=orjson.dumps(content)).answer(**fields)
    means = _plain(over_roads.means[items[0].strategy])
    of_all = {"compute_ms": compute_ms, "comfort": means.pop("comfort"), "metrics": means}
    return {"status": "ok", "source": None, **fields, **items[0].summary, **of_all}


def _plain_changes(changes: Changes) -> JsonObject:
    return {name: _plain(change) for name, change in changes.items()}


def _plain(part: Numbers) -> JsonObject:
    """Intervals as JSON; null where there is none."""
    return {key: _interval(value) if isinstance(value, Interval) else _plain(value) for key, value in part.items()}


def _interval(interval: Interval) -> dict[str, float] | None:
    if not isfinite(interval.value):
        return None
    return {"mean": interval.value, "low": interval.low, "high": interval.high}
