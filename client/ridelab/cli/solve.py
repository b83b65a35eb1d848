"""`ridelab solve`: how large a field may be while a metric keeps a limit."""

from typing import Annotated, Any

import typer

from ridelab.cli import fields, options, requirements
from ridelab.cli.reporting import DIFFERENT, InputError, failed, note, print_json
from ridelab.cli.service import Services
from ridelab.errors import RidelabAPIError
from ridelab.results import Solution

_FIELD = "What may be how large, and the range to search, such as speed.target_speed_kmh=10:50."
_LIMIT = "What has to hold, in the metric's unit, such as bump.body_acceleration.peak=4."
_STRATEGY = "Strategy that drives; without one the ids are listed."
_ROADS = "Over N roads, seeds road.seed and on: the interval keeps the limit."


def solve(
    services: Services,
    field: Annotated[str, options.option("FIELD=LOW:HIGH", _FIELD, completes="fields =")],
    limit: Annotated[str | None, options.option("METRIC=MOST", _LIMIT, completes="metrics =")] = None,
    strategy: Annotated[str | None, options.option("ID", _STRATEGY, "--strategy", "-s", completes="strategies")] = None,
    scenario: options.Scenario = "paper",
    changes: options.Changes = None,
    roads: Annotated[int, typer.Option(metavar="N", min=1, max=50, help=_ROADS)] = 1,
    baseline: options.Baseline = None,
    require: requirements.Require = None,
    as_json: options.AsJson = False,
) -> None:
    """Find the largest value of one field that keeps one metric at or below a limit, or every --require.

    The range is scanned first, so that a metric that rises and falls is seen and said. Over several roads the mean's
    95 % interval keeps the limit. The exit code is 1 where no value in the range does.
    """
    if strategy is None:
        raise InputError(f"--strategy names the one that drives: {', '.join(services.names.strategies)}")
    strategy = options.one_strategy(strategy)
    ((name, ends),) = fields.ranges_of([field], "--field", services.names.fields).items()
    if (limit is None) == (not require):
        raise InputError("Say what has to hold with --limit METRIC=MOST, or with --require")
    metric, most = None, None
    if limit is not None:
        metric, most = fields.limit_of(limit, services.names.metrics, "bump.body_acceleration.peak=4")
    required = requirements.requirements_of(require, services)
    start = fields.scenario_of(scenario, changes, services)
    ridelab = services.at()
    services.doing = "Searching"
    try:
        held: dict[str, Any] = {"roads": roads, "baseline": baseline, "requirements": required}
        solution = ridelab.solve(start, strategy, name, (ends[0], ends[1]), metric, most, **held)
    except RidelabAPIError as error:
        if error.kind == "no-solution":
            raise failed(DIFFERENT, [error.detail]) from None
        raise
    if as_json:
        print_json(solution.answer)
        return
    _show(solution, name, metric, roads)
    if solution.requirement_results:
        requirements.show(solution.requirement_results, services)
    typer.echo(f"\n{services.place_of(solution.run_id)}")


def _show(solution: Solution, name: str, metric: str | None, roads: int) -> None:
    low, high = solution.bracket
    value, above, resolved = (_with_unit(each, solution.unit) for each in (low, high, solution.resolved_value))
    untried = any(each["value"] == high and each["metric_value"] is None for each in solution.tried)
    if high > low and resolved == value:
        typer.echo(f"{name} at most {value}; {above} {'could not be tried' if untried else 'does not keep the limit'}")
    elif high > low:
        beyond = "could not be tried" if untried else "does not"
        typer.echo(f"{name} at most about {resolved}: {value} keeps the limit, {above} {beyond}")
    else:
        typer.echo(f"{name}: {value}, the top of the range, keeps the limit; the largest value may lie beyond")
    held = _with_unit(solution.metric_value, solution.metric_unit, 4)
    over = f", the upper end of {solution.interval} over {roads} roads" if solution.interval is not None else ""
    held = held if metric is not None else f"{100 * solution.metric_value:.4g} %"
    typer.echo(
        f"{metric or 'The largest part of a limit that is used'} is {held} at {value}{over} ({solution.runs} runs)"
    )
    for warning in solution.warnings:
        note(warning)


def _with_unit(value: float, unit: str, digits: int = 6) -> str:
    return f"{value:.{digits}g}{'' if unit == '1' else f' {unit}'}"
