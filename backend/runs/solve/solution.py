"""The answer from the values tried: the largest that keeps the limit, and warnings in plain words."""

from collections.abc import Iterator, Mapping
from dataclasses import dataclass
from math import inf, isfinite

from backend.errors import InvalidError, NoSolutionError, ServiceError
from backend.intervals import mean_with_interval
from backend.means_over_roads import one_road_resolution
from backend.runs.over_roads import Interval
from backend.runs.solve import limit_search
from backend.runs.solve.models import Solution, SolveRequest, TriedValue
from sim_core import __version__ as CORE_VERSION
from sim_core.catalogue import METRICS, RMS
from sim_core.scenario import dotted

RESOLUTION = 0.005  # of a metric: peaks are exact to half a percent (docs/explanation/metrics.md)
MAX_EXTREMA = 4  # that one sentence names


@dataclass(frozen=True, slots=True, kw_only=True)
class Tried:
    """What came of one value.

    Attributes:
        run_id: The run; None where the scenario contradicts itself.
        values: The metric on each road; None where there is none.
        reason: Why there is none.
        undefined: The car was driven, and the strategy has no such metric.
    """

    run_id: str | None = None
    values: tuple[float, ...] | None = None
    reason: str | None = None
    undefined: bool = False

    @property
    def interval(self) -> Interval | None:
        """The metric's mean and interval over several roads."""
        if self.values is None or len(self.values) == 1:
            return None
        over = mean_with_interval(self.values)
        return Interval(mean=over.value, low=over.low, high=over.high)

    @property
    def bound(self) -> float:
        """What the limit is compared with: the metric, or its interval's upper end; infinite without a metric."""
        if self.values is None:
            return inf
        return self.values[0] if (interval := self.interval) is None else interval.high


def bounds_of(tried: Mapping[int, Tried]) -> dict[int, float]:
    """By index of the value what the limit is compared with."""
    return {index: each.bound for index, each in tried.items()}


def solution(request: SolveRequest, tried: Mapping[int, Tried]) -> Solution:
    """The answer to the request.

    Raises:
        NoSolutionError: No value keeps the limit.
        InvalidError: No value could be tried.
    """
    bounds = bounds_of(tried)
    low, high = limit_search.bracket(request.axis, request.limit, bounds)
    if low is None:
        raise _refusal(request, tried)
    best = tried[low]
    resolution = _resolution(request, best)
    alike: tuple[float, float] = (low, low)
    if resolution is not None and high > low:
        alike = limit_search.alike(request.limit, bounds, low, resolution / 100)
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
        metric_unit=METRICS[request.metric].unit,
        warnings=[*_unresolved(request, resolution, alike), *_warnings(request, tried, bounds, low)],
        tried=[_answered(request.value(index), each) for index, each in sorted(tried.items())],
        core_version=CORE_VERSION,
    )


def _answered(value: int | float, tried: Tried) -> TriedValue:
    bound = tried.bound if tried.values is not None else None
    return TriedValue(value=value, metric_value=bound, run_id=tried.run_id, reason=tried.reason)


def _refusal(request: SolveRequest, tried: Mapping[int, Tried]) -> ServiceError:
    """Why there is no solution."""
    least = min(tried, key=lambda index: tried[index].bound)
    if tried[least].values is None:
        pointer = "/metric" if any(each.undefined for each in tried.values()) else "/range"
        return InvalidError(f"No value in the range can be tried: {tried[least].reason}.", pointer=pointer)
    return NoSolutionError(
        f"No value tried from {_value(request, 0, bare=True)} to {_value(request, request.axis.last)} keeps "
        f"{request.metric} at or below {_metric(request, request.limit)}; the least, "
        f"{_metric(request, tried[least].bound)}, is at {_value(request, least)}.",
        pointer="/range",
    )


def _resolution(request: SolveRequest, best: Tried) -> float | None:
    """The smallest change of the metric there [%] that is more than luck; None where none is known."""
    if best.interval is not None:
        half = best.interval.high - best.interval.mean
        return 100 * half / abs(best.bound) if half and best.bound else None
    path = METRICS[request.metric].path
    if request.scenario.road.is_smooth or path[0] not in ("metrics", "comfort"):
        return None
    resolution = one_road_resolution(request.strategy)
    return resolution.get(path[-1], resolution[RMS])


def _unresolved(request: SolveRequest, resolution: float | None, alike: tuple[float, float]) -> Iterator[str]:
    """What the value's last digits do not tell."""
    first, last = (request.value(round(index)) for index in alike)
    if resolution is None or first == last:
        return
    known = f"On one road a change of {request.metric} below {resolution:.2g} % may be luck"
    if request.roads > 1:
        known = f"Over {request.roads} roads the mean of {request.metric} is known to ±{resolution:.2g} %"
    unit = dotted.field(request.field).unit
    yield f"{known}; from {first:.4g} to {last:.4g}{'' if unit == '1' else f' {unit}'} it changes by less."


def _warnings(
    request: SolveRequest, tried: Mapping[int, Tried], bounds: Mapping[int, float], best: int
) -> Iterator[str]:
    missing = [index for index in sorted(tried) if tried[index].values is None]
    if missing:
        first = missing[0]
        yield (
            f"{len(missing)} of {len(tried)} values could not be tried and count as beyond the limit, "
            f"the first {_value(request, first)}: {tried[first].reason}."
        )
    finite = {index: bound for index, bound in bounds.items() if isfinite(bound)}
    if len(finite) > 1 and len(set(finite.values())) == 1:
        yield f"The metric is the same at every value tried: {request.strategy} may not depend on {request.field}."
    spans = limit_search.spans_over(request.limit, finite, best)
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
    return f"The metric is not monotone: {', '.join(steps)}{more}; between values tried it may exceed the limit unseen."


def _value(request: SolveRequest, index: int, *, bare: bool = False) -> str:
    unit = dotted.field(request.field).unit
    return f"{request.value(index):g}{'' if bare or unit == '1' else f' {unit}'}"


def _metric(request: SolveRequest, value: float) -> str:
    unit = METRICS[request.metric].unit
    return f"{value:.4g}{'' if unit == '1' else f' {unit}'}"
