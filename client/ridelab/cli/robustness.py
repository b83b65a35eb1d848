"""`ridelab robustness`: how each strategy does where car, sensors and actuators are not what it believes."""

from collections.abc import Callable, Mapping, Sequence
from typing import Annotated, Any

import typer

from ridelab.cli import fields, options
from ridelab.cli.following import follow_to_end, say_end, submit_job
from ridelab.cli.reporting import InputError, print_json, show_table, shown, with_unit
from ridelab.cli.service import Services
from ridelab.jobs import Batch

_FOLLOWED = 2  # fields named beside a figure
_CHANCE = 0.001  # what chance makes more often than this is not named
_RANGE = "Instead of, or beside, the default ranges."
_EXACT = "Known exactly: not varied; with commas or repeated."


def robustness(
    services: Services,
    scenario: options.Scenario = "paper",
    samples: Annotated[int | None, options.option("N", "Points drawn [default: 200].", min=2)] = None,
    ranges: Annotated[list[str] | None, options.option("FIELD=LOW:HIGH", _RANGE, "--range")] = None,
    exact: Annotated[list[str] | None, options.option("FIELD", _EXACT)] = None,
    only: Annotated[bool, options.flag("Vary only what --range names.", "--only")] = False,
    seed: options.Seed = 0,
    strategy: options.Strategies = None,
    baseline: options.Baseline = None,
    changes: options.Changes = None,
    label: options.Label = None,
    as_json: options.AsJson = False,
) -> None:
    """Worst case and quantiles of each strategy over uncertain mass, stiffness, damping, preview and actuators.

    Every strategy runs at the same points of a Latin hypercube; the controllers know none of it. Without options it is
    the study that GET /robustness describes.
    """
    start = fields.scenario_of(scenario, changes, services)
    ridelab = services.at()
    usual = ridelab.get("/robustness")
    names = options.listed(strategy) or usual["strategies"]
    if baseline is not None and baseline not in names:
        raise InputError(f"--baseline: {baseline} is not among the strategies {', '.join(names)}")
    varied = {} if only else {each["field"]: [each["low"], each["high"]] for each in usual["ranges"]}
    varied |= fields.ranges_of(ranges or [], "--range", services.names.fields)
    for name in options.listed(exact, "--exact"):
        if varied.pop(name, None) is None:
            raise InputError(f"--exact: {name} is not varied; what is: {', '.join(varied) or 'nothing'}")
    if not varied:
        raise InputError("Nothing is uncertain: every field is exact. Name one with --range FIELD=LOW:HIGH")
    sweep = {"latin_hypercube": {"ranges": varied, "samples": samples or usual["samples"], "seed": seed}}
    label = label or "Robustness study"
    batch, code = submit_job(lambda key: ridelab.submit(start, names, sweep, key, label), services)
    code = code or follow_to_end(batch, services)
    if batch.state != "failed":
        summary = batch.summary(baseline=baseline)
        print_json(summary) if as_json else _show(summary, varied, batch, services.names.label)
    raise typer.Exit(code or say_end(batch))


def _show(
    summary: Mapping[str, Any], ranges: Mapping[str, Sequence[float]], batch: Batch, label: Callable[[str], str]
) -> None:
    """Print the summary as tables."""
    strategies, percents = summary["strategies"], summary["quantiles"]
    what = f"{summary['points']} points of {len(ranges)} uncertain fields"
    version, baseline = batch.answer["core_version"], label(summary["baseline"])
    typer.echo(f"Ridelab core {version}: {what}; changes against {baseline} at the same point")
    typer.echo("  " + ", ".join(f"{name} {shown(low)}:{shown(high)}" for name, (low, high) in ranges.items()))
    for key, unit in summary["units"].items():
        event = key.startswith("events.")
        heads = ["", "nominal", "median", "5 %", "95 %", "worst", "in run"]
        heads += [*(["over 0"] if event else ["change, median", "5 %", "95 %", "better"]), "follows"]
        typer.echo(f"\n{with_unit(key, unit)}")
        figures = {label(name): each["figures"][key] for name, each in strategies.items()}
        show_table(heads, [[name, *_row(figure, percents, event)] for name, figure in figures.items()])
    typer.echo("\nleast damping ratio of the closed loop (below 0: unstable)")
    heads = ["", "nominal", "median", "lowest", "in run", "unstable", "follows"]
    show_table(heads, [[label(name), *_stability(each["stability"], percents)] for name, each in strategies.items()])
    for name, each in strategies.items():
        for reason, count in each["reasons"].items():
            typer.echo(f"{label(name)}: {count} failed: {reason}")


def _row(figure: Mapping[str, Any], percents: Sequence[float], event: bool) -> list[str]:
    """The row of a metric; an event, which happens at few points only, has their number instead of a change in %."""
    values = [figure["nominal"], *_quantiles(figure, percents, 50, 5, 95, 100)]
    run = "-" if figure["highest"] is None or (event and not figure["above_zero"]) else str(figure["highest"]["run"])
    compared = ["", "", "", ""]
    if event:
        compared = [f"{figure['above_zero']} of {figure['n']}"]
    elif (margin := figure["margin"]) is not None:
        better = "-" if margin["better"] is None else f"{100 * margin['better']:.0f} %"
        changes = ("-" if value is None else f"{value:+z.0f} %" for value in _quantiles(margin, percents, 50, 5, 95))
        compared = [*changes, better]
    return [*(shown(value, 4) for value in values), run, *compared, _follows(figure["sensitivity"])]


def _stability(stability: Mapping[str, Any], percents: Sequence[float]) -> list[str]:
    values = [stability["nominal"], *_quantiles(stability, percents, 50, 0)]
    run = "-" if stability["lowest"] is None else str(stability["lowest"]["run"])
    unstable = f"{stability['unstable']} of {stability['known']}"
    return [*(shown(value, 3) for value in values), run, unstable, _follows(stability["sensitivity"])]


def _quantiles(distribution: Mapping[str, Any], percents: Sequence[float], *asked: float) -> list[float | None]:
    values = distribution["quantiles"]
    return [None if values is None else values[list(percents).index(percent)] for percent in asked]


def _follows(sensitivity: Sequence[Mapping[str, Any]]) -> str:
    """The fields that matter most, with their rank correlation."""
    named = [item for item in sensitivity if item["p_value"] < _CHANCE][:_FOLLOWED]
    return ", ".join(f"{item['field'].rpartition('.')[2]} {item['spearman']:+z.2f}" for item in named)
