"""`ridelab run`: strategies over one scenario."""

from collections.abc import Mapping
from typing import Annotated, Any

import typer

from ridelab.cli import fields, options, requirements, targets
from ridelab.cli.names import Names
from ridelab.cli.reporting import DIFFERENT, InputError, note, print_json, show_cautions, show_table
from ridelab.cli.service import Services
from ridelab.requirements import failing
from ridelab.results import Interval, Outcome, RunResult

_VIEWS = (("rough_road", "rms", "RMS on the rough road"), ("bump", "peak", "peak on the bump"))
_AGAINST = "Id of a run, such as the one before an edit: show changes against it too; needs a service."
_ROADS = "Drive N roads, seeds road.seed and on: mean and interval."


def run(
    services: Services,
    scenario: options.Scenario = "paper",
    changes: options.Changes = None,
    strategy: options.Strategies = None,
    roads: Annotated[int, typer.Option(metavar="N", min=1, max=50, help=_ROADS)] = 1,
    baseline: options.Baseline = None,
    against: Annotated[str | None, options.option("RUN", _AGAINST)] = None,
    require: requirements.Require = None,
    strict: requirements.Strict = False,
    junit: requirements.Junit = None,
    as_json: Annotated[bool, options.flag("The whole run as JSON, as compare reads it.", "--json")] = False,
) -> None:
    """Run strategies over one scenario and show how they compare.

    All strategies unless --strategy names some. Over several roads every figure is a mean with half its 95 % interval's
    width, every change that of the means, paired road by road.

    A service, or a private one with --data-dir, does not compute again what is stored. Without both, a run over one
    road is computed here at once and nothing is left behind.

    With --require the exit code is 1 where a requirement fails, 0 where all pass; over several roads one is uncertain
    where the interval holds its limit.
    """
    names = options.listed(strategy)
    if names and baseline is not None and baseline not in names:
        raise InputError(f"--baseline: one of the strategies that run, {', '.join(names)}")
    source = targets.find(scenario, services)
    changed = fields.changed(source.scenario, changes or [], services)
    ridelab = services.quick
    required = requirements.requirements_of(require, services)
    requirements.check_file(junit, required)
    names = names or list(services.names.strategies)
    result = ridelab.run(changed, names, roads=roads, baseline=baseline, requirements=required, against=against)
    judged = result.requirement_results
    if junit is not None:
        requirements.write_junit(requirements.cases(judged, services), junit, "ridelab run", strict=strict)
    if as_json:
        print_json(with_units(result))
    else:
        _show(result, ", ".join([source.name, *(changes or [])]), against, services.names)
        if judged:
            typer.echo()
            requirements.show(judged, services)
        stored = "not stored (--data-dir DIR stores it)" if result.id is None else services.place_of(result.id)
        typer.echo(f"\n{stored}")
    if any(outcome.status != "ok" for outcome in result):
        note("Not every strategy could run")
        raise typer.Exit(DIFFERENT)
    if failing(judged, strict=strict):
        raise typer.Exit(DIFFERENT)


def with_units(run: RunResult) -> dict[str, Any]:
    """A run for machines: as the service answered it, and the unit of each metric by its flat name."""
    return {**run.answer, "units": run.units}


def _show(run: RunResult, name: str, against: str | None, names: Names) -> None:
    """Print the paper's signals of each strategy that ran and how its drive went; then why others did not run."""
    comparison = run.answer["comparison"]
    seed, drive, computed = run.scenario["road"]["seed"], "", "run"
    if run.roads > 1:
        name = f"{name}, {run.roads} roads (seeds {seed} to {seed + run.roads - 1}; events of {seed})"
        drive, computed = f"road seed {seed} alone", f"{run.roads} runs"
    reference = names.label(comparison["baseline"])
    typer.echo(f"Ridelab core {run.core_version}, {name}; changes against {reference}\n")
    ran = {names.label(outcome.strategy): outcome for outcome in run if outcome.status == "ok"}
    _show_metrics(ran, comparison["changes"], "", names)
    if against is not None:
        _show_metrics(ran, comparison["changes_against"], f", changes against run {against}", names)
    heads = [drive, "travel time", "at the bump", "airborne", "over travel", "QPs", computed]
    show_table(heads, [[label, *_drive(outcome)] for label, outcome in ran.items()])
    for outcome in run:
        for caveat in _caveats(outcome):
            typer.echo(f"{names.label(outcome.strategy)}  {caveat}")
    show_cautions(comparison, with_the_papers=False)


def _show_metrics(ran: Mapping[str, Outcome], changes: Mapping[str, Any], what: str, names: Names) -> None:
    """Print the paper's metrics of strategies, by label, with these changes; `what` says against what they are."""
    for window, statistic, title in _VIEWS:
        metrics = [(window, key, statistic) for key in names.paper_signals]
        rows = [[label, *(_cell(outcome, changes, metric) for metric in metrics)] for label, outcome in ran.items()]
        show_table([f"{title}{what}", *map(names.signal, names.paper_signals)], rows)
        typer.echo()


def _caveats(outcome: Outcome) -> list[str]:
    """Why it did not run, or what its numbers do not tell by themselves (the table has lift-off and travel)."""
    if outcome.status != "ok":
        return [f"failed: {outcome.reason}"]
    caveats = []
    if outcome.events.get("target_reached") is False:
        caveats.append("target speed not reached")
    if outcome.events.get("bump_complete") is False:
        caveats.append("the road ends before the rear axle has left the bump: its peaks are those up to there")
    if failures := outcome.events.get("qp_failures"):
        caveats.append(f"{failures} QPs not solved: the last safe force was held")
    return [*caveats, *(outcome.recording or {}).get("notes", ())]


def _with(value: float | None, form: str, unit: str = "") -> str:
    return "-" if value is None else f"{value:{form}}{unit}"


def _cell(outcome: Outcome, changes: Mapping[str, Any], metric: tuple[str, str, str]) -> str:
    """Return a metric and its change; over several roads both with half their interval's width."""
    window, signal, statistic = metric
    value: Any = outcome.metrics[window][signal][statistic]  # type: ignore[literal-required]  # one of both
    if value is None:
        return "-"
    shown = f"{value}" if isinstance(value, Interval) else f"{value:.4g}"
    change = changes.get(outcome.strategy, {}).get(".".join(metric))
    if change is None or change["change"] is None:
        return shown
    half = "" if change["low"] is None else f" ± {(change['high'] - change['low']) / 2:.1f}"
    return f"{shown} ({change['change']:+z.1f}{half} %)"


def _drive(outcome: Outcome) -> list[str]:
    exceeded = outcome.events["travel_exceeded_mm"]
    return [
        _with(outcome.travel_time, ".2f", " s"),
        _with(outcome.arrival_speed_kmh, ".1f", " km/h"),
        _with(outcome.events["airborne_ms"], ".0f", " ms"),
        _with(exceeded, ".1f" if exceeded else ".0f", " mm"),
        _with(outcome.events["qp_solves"], "d"),
        f"{outcome.compute_ms:8.1f} ms",  # a width that how busy the machine is does not change
    ]
