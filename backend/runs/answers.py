"""The answers about a stored run: each strategy's result, over several roads with mean, interval and change.

They have the shapes of `backend.models` and `backend.runs.models`; what is stored as JSON goes in as it is.
Over 50 roads they take 0.2 s: they are made in threads, beside the event loop.
"""

from collections.abc import Callable, Collection, Iterable, Mapping, Sequence
from dataclasses import asdict, replace
from hashlib import sha256
from math import isfinite
from threading import Lock

import cachetools
import orjson

from backend.errors import InvalidError
from backend.json_types import JsonObject, Summary
from backend.means_over_roads import Changes, Numbers, OverRoads, means_and_changes, numbers, paired_changes
from backend.outcome import Outcome
from backend.requirements import Requirement
from backend.runs import series
from backend.runs.models import LiveRequest
from backend.store import StoredRun
from sim_core import __version__ as CORE_VERSION
from sim_core.catalogue import PAPER_METRICS
from sim_core.comparison.caution import Caution
from sim_core.comparison.compare import Comparison, compare_summaries
from sim_core.comparison.intervals import Interval
from sim_core.comparison.requirements import Driven, baseline_of, judge
from sim_core.comparison.requirements import Requirement as CoreRequirement
from sim_core.comparison.rows import LOWER_IS_BETTER
from sim_core.scenario import SCHEMA_VERSION, Scenario, characteristics
from sim_core.strategies import find_strategy, label_of

WRITTEN_FACTS = 128  # runs, and ways to compare them, whose facts are kept; at most 0.1 MB each


def run_answer(
    stored: StoredRun,
    *,
    cached: Mapping[str, bool] | None = None,
    requirements: Sequence[Requirement] = (),
    baseline: str | None = None,
    compared: Collection[str] | None = None,
    against: StoredRun | None = None,
) -> JsonObject:
    """Return the answer about a stored run, for orjson.

    Args:
        stored: The run, its scenario today's.
        cached: To the request that created it, by strategy whether nothing of it was computed for that one.
        requirements: Limits that its strategies have to satisfy.
        baseline: The strategy that all changes refer to, those of requirements too; None is the run's own.
        compared: The strategies that `comparison` is of, beside its baseline; None is all.
        against: The run that the comparison's `changes_against` refer to.

    Raises:
        InvalidError: They are of several roads, and that run is not of the same, or not of the same core version.
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
        **_written_facts(stored, baseline, compared, tuple(each.to_core() for each in requirements), against),
    }
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


def _facts_key(
    stored: StoredRun,
    baseline: str | None,
    compared: Collection[str] | None,
    requirements: Sequence[CoreRequirement],
    against: StoredRun | None,
) -> tuple[object, ...]:
    """Return what facts depend on: a digest of a run and its comparison, and the controllers, which have labels."""
    runs = [
        (
            *(run.core_version, run.scenario, run.roads, run.baseline),
            [
                (name, item.status, item.core_version or run.core_version, orjson.Fragment(item.json))
                for name, items in run.by_strategy.items()
                for item in items
            ],
        )
        for run in (stored, against)
        if run is not None
    ]
    selected = None if compared is None else sorted(compared)
    content = orjson.dumps((runs, baseline, selected, requirements))
    return (sha256(content).digest(), *map(find_strategy, stored.by_strategy))


@cachetools.cached(cachetools.LRUCache(WRITTEN_FACTS), _facts_key, Lock())
def _written_facts(
    stored: StoredRun,
    baseline: str | None,
    compared: Collection[str] | None,
    requirements: Sequence[CoreRequirement],
    against: StoredRun | None,
) -> dict[str, orjson.Fragment]:
    """Return the facts of a stored run as JSON: to compare takes longer than all else of a stored run's answer."""
    scenario = Scenario.model_validate(stored.scenario)
    comparison = comparison_of(
        stored, scenario, baseline=baseline, compared=compared, requirements=requirements, against=against
    )
    facts: JsonObject = {
        "characteristics": asdict(characteristics(scenario.vehicle)),
        "cautions": comparison.cautions,
        "comparison": comparison,
    }
    if requirements:
        facts["requirement_results"] = comparison.requirements
    return {name: orjson.Fragment(orjson.dumps(value)) for name, value in facts.items()}


def comparison_of(
    stored: StoredRun,
    scenario: Scenario,
    *,
    baseline: str | None,
    compared: Collection[str] | None = None,
    requirements: Sequence[CoreRequirement] = (),
    against: StoredRun | None = None,
    metrics: Iterable[str] = LOWER_IS_BETTER,
) -> Comparison:
    """Return what the strategies that succeeded on every road mean beside each other.

    Raises:
        InvalidError: They are of several roads, and `against` is not of the same, or not of the same core version.
    """
    reference = baseline_of(list(stored.by_strategy), baseline or stored.baseline)
    is_compared = {reference, *(stored.by_strategy if compared is None else compared)}
    driven = _summaries(stored)
    summaries = {name: each for name, each in driven.items() if name in is_compared}
    other = None
    if against is not None:
        check_same_roads(stored.roads, scenario.road.seed, stored.core_version, against)
        other = _summaries(against), Scenario.model_validate(against.scenario)
    comparison = compare_summaries(summaries, reference, scenario, metrics, other)
    # Those had failed with the run's core version.
    others = [item for item in stored.shown if item.core_version not in (None, stored.core_version)]
    cautions = tuple(_other_version(item, stored) for item in others if item.strategy in summaries)
    comparison = replace(comparison, cautions=(*comparison.cautions, *cautions))
    if not requirements:
        return comparison
    results = judge(requirements, _reasons(stored) | driven, baseline or _named_baseline(stored))
    return replace(comparison, requirements=results)


def _other_version(item: Outcome, stored: StoredRun) -> Caution:
    """Return the caution about a strategy that another core version than the run's has computed."""
    text = (
        f"{label_of(item.strategy)} was computed by core {item.core_version}, the other strategies by core "
        f"{stored.core_version}: part of a difference may come from that."
    )
    return Caution(kind="core_version", text=text, strategy=item.strategy)


def _reasons(stored: StoredRun) -> dict[str, Driven]:
    """Return why each strategy has no summary on some road; empty where it has all."""
    return {
        name: next((item.summary["reason"] for item in items if item.status != "ok"), "")
        for name, items in stored.by_strategy.items()
    }


def _summaries(stored: StoredRun) -> dict[str, list[Summary]]:
    """Return the summaries on every road of each strategy that succeeded on all of them."""
    return {item.strategy: [each.summary for each in stored.by_strategy[item.strategy]] for item in stored.shown}


def _named_baseline(stored: StoredRun) -> str | None:
    """Return the run's own baseline where somebody named it."""
    return None if stored.baseline == baseline_of(list(stored.by_strategy)) else stored.baseline


def as_plain(answer: JsonObject) -> JsonObject:
    """An answer as Python values throughout."""
    plain: JsonObject = orjson.loads(orjson.dumps(answer))
    return plain


def live_answer(
    scenario: Scenario, outcomes: Mapping[str, Outcome], request: LiveRequest, against: StoredRun | None
) -> bytes:
    """Return a run that is not stored, with the time histories that were asked for: in base64, or binary.

    Binary is a third less: the length of its JSON (uint32), the JSON, all numbers as little-endian float32. JSON has
    `signals` and `samples` of each strategy that succeeded, whose numbers follow each other in its order. They begin at
    a multiple of four bytes, as spaces end the JSON.

    Args:
        scenario: What was driven.
        outcomes: By strategy.
        request: Which signals are in it, and what they are compared with.
        against: The run of one road that it names.
    """
    signals, numbers = series.ordered_signals(request.signals), []

    def described(values: series.SeriesArray) -> JsonObject:
        if request.encoding == "base64":
            return {key: series.packed(values[series.ROWS[key]]) for key in signals}
        numbers.append(values[[series.ROWS[key] for key in signals]].astype("<f4", copy=False).tobytes())
        return {"signals": signals, "samples": values.shape[1]}

    head = orjson.dumps(_live(scenario, outcomes, request, against, described))
    if request.encoding == "base64":
        return head
    head += b" " * (-len(head) % 4)
    return b"".join((len(head).to_bytes(4, "little"), head, *numbers))


def _live(
    scenario: Scenario,
    outcomes: Mapping[str, Outcome],
    request: LiveRequest,
    against: StoredRun | None,
    described: Callable[[series.SeriesArray], JsonObject],
) -> JsonObject:
    """Return a run that is not stored, for orjson; its comparison is of the paper's eight metrics."""

    def entry(outcome: Outcome) -> orjson.Fragment:
        values = outcome.series
        return outcome.answer(cached=outcome.cached, **({} if values is None else {"series": described(values)}))

    run = StoredRun(
        id="",
        core_version=CORE_VERSION,
        schema_version=SCHEMA_VERSION,
        scenario=scenario.model_dump(mode="json"),
        by_strategy={name: [outcome] for name, outcome in outcomes.items()},
    )
    limits = [each.to_core() for each in request.requirements]
    comparison = comparison_of(
        run, scenario, baseline=request.baseline, requirements=limits, against=against, metrics=PAPER_METRICS
    )
    return {
        "core_version": CORE_VERSION,
        "scenario": run.scenario,
        "characteristics": asdict(characteristics(scenario.vehicle)),
        "cautions": comparison.cautions,
        "comparison": comparison,
        "strategies": {name: entry(outcome) for name, outcome in outcomes.items()},
    }


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


def changes_to_run(stored: StoredRun, against: StoredRun) -> JsonObject:
    """Return the changes of a run over several roads against another one, strategy by strategy.

    Raises:
        InvalidError: They are not of the same roads, or not of the same core version.
    """
    check_same_roads(stored.roads, stored.scenario["road"]["seed"], stored.core_version, against)
    _check_several(stored)
    changes = _plain_changes(paired_changes(_driven(stored), _driven(against)))
    return {"against": against.id, "baseline": None, "roads": stored.roads, "changes": changes}


def check_same_roads(roads: int, seed: int, core_version: str, against: StoredRun) -> None:
    """Check that changes of so many roads from a seed on can refer to a run; of one road they can to any other one.

    Raises:
        InvalidError: They cannot, of the parameter `against`.
    """
    if (roads, against.roads) == (1, 1):
        return
    if (against.roads, other := against.scenario["road"]["seed"]) != (roads, seed):
        message = f"Number of roads: {against.roads} from seed {other}; of this run {roads} from {seed}"
        raise InvalidError(message + ": changes are of the same roads", parameter="against")
    if against.core_version != core_version:
        message = f"Core {against.core_version} computed it, {core_version} this run: request it again"
        raise InvalidError(message, parameter="against")


def _check_several(stored: StoredRun) -> None:
    if stored.roads == 1:
        raise InvalidError("This run is of one road: a change has no interval", parameter="id")


def _driven(stored: StoredRun) -> dict[str, list[Numbers]]:
    """By strategy that succeeded on every road its numbers on each."""
    return {
        name: [numbers(each["metrics"], each["comfort"]) for each in of_roads]
        for name, of_roads in _summaries(stored).items()
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
