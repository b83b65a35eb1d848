"""The answer from the values tried: the largest that keeps the limit, and warnings in plain words."""

from collections.abc import Iterator, Mapping, Sequence
from dataclasses import asdict, dataclass
from math import inf, isfinite

from backend.errors import InvalidError, NoSolutionError, ServiceError
from backend.json_types import Summary
from backend.requirements import RequirementResult
from backend.runs.models import Interval
from backend.runs.solve import limit_search
from backend.runs.solve.models import Solution, SolveRequest, TriedValue
from backend.scenario_at import scenario_at
from sim_core import __version__ as CORE_VERSION
from sim_core.catalogue import METRICS
from sim_core.comparison.intervals import mean_with_interval
from sim_core.comparison.requirements import judge_strategy, share_used
from sim_core.comparison.variation import one_road_resolution, variation_of_one_road
from sim_core.scenario import Scenario, dotted
from sim_core.strategies import reads, strategy_named

RESOLUTION = 0.005  # of a metric: peaks are exact to half a percent (docs/explanation/metrics.md)
MAX_EXTREMA = 4  # that one sentence names


@dataclass(frozen=True, slots=True, kw_only=True)
class Tried:
    """The outcome of one value.

    Attributes:
        run_id: The run; None where the scenario contradicts itself.
        bound: What is held to the limit: the metric, or its interval's upper end, or the largest part of a
            requirement's limit that is used; infinite where there is none.
        interval: The metric's mean and interval over several roads; None on one, and of requirements.
        reason: Why there is no bound.
        undefined: The car was driven, and the strategy has no such metric.
        results: Whether the requirements are satisfied.
    """

    run_id: str | None = None
    bound: float = inf
    interval: Interval | None = None
    reason: str | None = None
    undefined: bool = False
    results: tuple[RequirementResult, ...] = ()


def of_metric(request: SolveRequest, run_id: str, driven: Mapping[str, Sequence[Summary]]) -> Tried:
    """Return the outcome of a run whose metric is held to the limit."""
    values = [METRICS[str(request.metric)].of(summary) for summary in driven[request.strategy]]
    if None in values:
        return Tried(
            run_id=run_id, reason=f"{strategy_named(request.strategy).label} has no {request.metric}", undefined=True
        )
    if len(values) == 1:
        return Tried(run_id=run_id, bound=float(values[0]))
    over = mean_with_interval(values)
    interval = Interval(mean=over.value, low=over.low, high=over.high)
    return Tried(run_id=run_id, bound=over.high, interval=interval)


def of_requirements(request: SolveRequest, run_id: str, driven: Mapping[str, Sequence[Summary]]) -> Tried:
    """Return the outcome of a run that is held to requirements: how far it uses their limits."""
    requirements = [each.to_core() for each in request.requirements]
    results = [judge_strategy(each, request.strategy, driven, request.against) for each in requirements]
    own, base = driven[request.strategy], driven[request.driven[-1]]
    reason = next((f"{each.metric}: {each.reason}" for each in results if each.reason is not None), None)
    return Tried(
        run_id=run_id,
        bound=max(share_used(each, own, base) for each in requirements),
        reason=reason,
        undefined=reason is not None,
        results=tuple(RequirementResult(**asdict(each)) for each in results),
    )


def bounds_of(tried: Mapping[int, Tried]) -> dict[int, float]:
    """Return by the value's index what the limit is compared with."""
    return {index: each.bound for index, each in tried.items()}


def solution(request: SolveRequest, tried: Mapping[int, Tried]) -> Solution:
    """The answer to the request.

    Raises:
        NoSolutionError: No value keeps the limit.
        InvalidError: No value could be tried.
    """
    bounds = bounds_of(tried)
    low, high = limit_search.bracket(request.axis, request.bound, bounds)
    if low is None:
        raise _refusal(request, tried)
    best = tried[low]
    resolution = _resolution(request, low, best)
    alike: tuple[float, float] = (low, low)
    if resolution is not None and high > low:
        alike = limit_search.alike(request.bound, bounds, low, resolution / 100)
    return Solution(
        value=request.value(low),
        metric_value=best.bound,
        interval=best.interval,
        resolution=resolution,
        resolved_value=request.resolved(low, alike[1] - alike[0]),
        bracket=(request.value(low), request.value(high)),
        runs=request.roads * sum(each.run_id is not None for each in tried.values()),
        run_id=str(best.run_id),
        unit=dotted.field(request.field).unit,
        metric_unit=request.held_unit,
        warnings=[*_unresolved(request, resolution, alike), *_warnings(request, tried, bounds, low)],
        tried=[_answered(request.value(index), each) for index, each in sorted(tried.items())],
        requirement_results=list(best.results),
        core_version=CORE_VERSION,
    )


def _answered(value: int | float, tried: Tried) -> TriedValue:
    bound = tried.bound if isfinite(tried.bound) else None
    return TriedValue(value=value, metric_value=bound, run_id=tried.run_id, reason=tried.reason)


def _refusal(request: SolveRequest, tried: Mapping[int, Tried]) -> ServiceError:
    """Return the error that says why there is no solution."""
    least = min(tried, key=lambda index: tried[index].bound)
    if tried[least].reason is not None:
        asked = "/metric" if request.metric else "/requirements"
        pointer = asked if any(each.undefined for each in tried.values()) else "/range"
        return InvalidError(f"No value in the range can be tried: {tried[least].reason}.", pointer=pointer)
    if request.metric is None:
        return NoSolutionError(
            f"No value tried from {_value(request, 0, bare=True)} to {_value(request, request.axis.last)} keeps every "
            f"requirement; nearest is {_value(request, least)}: {_kept(tried[least].results)}.",
            pointer="/range",
        )
    return NoSolutionError(
        f"No value tried from {_value(request, 0, bare=True)} to {_value(request, request.axis.last)} keeps "
        f"{request.metric} at or below {_metric(request, request.bound)}; the least, "
        f"{_metric(request, tried[least].bound)}, is at {_value(request, least)}.",
        pointer="/range",
    )


def _kept(results: Sequence[RequirementResult]) -> str:
    """Name the metrics whose limits are not satisfied."""
    return ", ".join(f"{each.metric} does not pass" for each in results if each.result != "pass")


def scenario_of(request: SolveRequest, index: int) -> Scenario:
    """The scenario with that value of the field.

    Raises:
        ValidationError: It contradicts itself.
    """
    return scenario_at(request.scenario.model_dump(mode="json"), {request.field: request.value(index)})


def _resolution(request: SolveRequest, index: int, best: Tried) -> float | None:
    """Return the smallest change of the metric there [%] beyond random variation; None where none is known."""
    if best.interval is not None:
        half = best.interval.high - best.interval.mean
        return 100 * half / abs(best.bound) if half and best.bound else None
    if request.metric is None:
        return None  # each of its requirements has another
    if not scenario_of(request, index).is_random:
        return None
    return variation_of_one_road(request.metric, [one_road_resolution(request.strategy)]) or None


def _unresolved(request: SolveRequest, resolution: float | None, alike: tuple[float, float]) -> Iterator[str]:
    """Say what the value's last digits do not tell."""
    first, last = (request.value(round(index)) for index in alike)
    if resolution is None or first == last:
        return
    accuracy = f"On one road a change of {request.metric} below {resolution:.2g} % may be random variation"
    if request.roads > 1:
        accuracy = f"Over {request.roads} roads the mean of {request.metric} is known to ±{resolution:.2g} %"
    unit = dotted.field(request.field).unit
    yield f"{accuracy}; from {first:.4g} to {last:.4g}{'' if unit == '1' else f' {unit}'} it changes by less."


def _warnings(
    request: SolveRequest, tried: Mapping[int, Tried], bounds: Mapping[int, float], best: int
) -> Iterator[str]:
    missing = [index for index in sorted(tried) if not isfinite(tried[index].bound)]
    if missing:
        first = missing[0]
        yield (
            f"{len(missing)} of {len(tried)} values could not be tried and count as beyond the limit, "
            f"the first {_value(request, first)}: {tried[first].reason}."
        )
    finite = {index: bound for index, bound in bounds.items() if isfinite(bound)}
    if len(finite) > 1 and len(set(finite.values())) == 1:
        strategy = strategy_named(request.strategy)
        read = reads(strategy, request.scenario.speed.policy)
        is_read = any(dotted.is_within(request.field, each) for each in read)
        cause = "" if is_read else f": {strategy.label} does not use {request.field}"
        yield f"{_subject(request)} is the same at every value tried{cause}."
    spans = limit_search.spans_over(request.bound, finite, best)
    if spans:
        over = ", ".join(
            _value(request, first)
            if first == last
            else f"{_value(request, first, bare=True)} to {_value(request, last)}"
            for first, last in spans
        )
        yield f"Not every smaller value keeps the limit: {over} exceed it."
    # Over the scan: within the bracket a metric may jump from one control step to the next.
    scan = {index: finite[index] for index in request.axis.scan if index in finite}
    extrema = limit_search.turning_points(scan, RESOLUTION)
    if len(extrema) > 2:
        yield _not_monotone(request, bounds, extrema)


def _not_monotone(request: SolveRequest, bounds: Mapping[int, float], extrema: list[int]) -> str:
    """A sentence with the extrema of a metric that is not monotone."""
    rises = bounds[extrema[1]] > bounds[extrema[0]]
    steps = [f"{_metric(request, bounds[extrema[0]])} at {_value(request, extrema[0])}"]
    for number, index in enumerate(extrema[1:MAX_EXTREMA]):
        goes = "rises" if rises == (number % 2 == 0) else "falls"
        steps.append(f"{goes} to {_metric(request, bounds[index])} at {_value(request, index)}")
    more = " and so on" if len(extrema) > MAX_EXTREMA else ""
    unseen = "between values tried it may exceed the limit unseen"
    return f"{_subject(request)} is not monotone: {', '.join(steps)}{more}; {unseen}."


def _subject(request: SolveRequest) -> str:
    return "The metric" if request.metric else request.held.capitalize()


def _value(request: SolveRequest, index: int, *, bare: bool = False) -> str:
    unit = dotted.field(request.field).unit
    return f"{request.value(index):g}{'' if bare or unit == '1' else f' {unit}'}"


def _metric(request: SolveRequest, value: float) -> str:
    unit = request.held_unit
    return f"{value:.4g}{'' if unit == '1' else f' {unit}'}"
