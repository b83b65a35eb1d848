"""`ridelab run`: strategies over one scenario."""

from typing import Annotated, Any

import typer

from ridelab.cli import fields, options, targets
from ridelab.cli.names import Names
from ridelab.cli.reporting import DIFFERENT, InputError, note, print_json
from ridelab.cli.service import Services
from ridelab.cli.tables import show_run
from ridelab.results import RunResult


def run(
    services: Services,
    scenario: options.Scenario = "paper",
    changes: options.Changes = None,
    strategy: options.Strategies = None,
    roads: Annotated[
        int,
        typer.Option(metavar="N", min=1, max=50, help="Drive N roads, seeds road.seed and on: mean and interval."),
    ] = 1,
    baseline: options.Baseline = None,
    as_json: Annotated[bool, typer.Option("--json", help="The whole run as JSON, as compare reads it.")] = False,
) -> None:
    """Run strategies over one scenario and show how they compare.

    All strategies unless --strategy names some. What is stored already is not computed again. Over several roads every
    figure is a mean with half its 95 % interval's width, every change that of the means, paired road by road.
    """
    names = options.listed(strategy)
    if names and baseline is not None and baseline not in names:
        raise InputError(f"--baseline: one of the strategies that run, {', '.join(names)}")
    source = targets.find(scenario, services)
    changed = fields.changed(source.scenario, changes or [], services)
    ridelab = services.at()
    result = ridelab.run(changed, names or list(services.names.strategies), roads=roads, baseline=baseline)
    if as_json:
        print_json(with_units(result))
    else:
        _show(result, ", ".join([source.name, *(changes or [])]), baseline, services.names)
        typer.echo(f"\nrun {result.id}" if services.private else f"\n{ridelab.address}/r/{result.id}")
    if any(outcome.status != "ok" for outcome in result):
        note("Not every strategy could run")
        raise typer.Exit(DIFFERENT)


def with_units(run: RunResult) -> dict[str, Any]:
    """A run for machines: as the service answered it, and the unit of each metric by its flat name."""
    return {**run.answer, "units": run.units}


def _show(result: RunResult, name: str, baseline: str | None, names: Names) -> None:
    ran = list(result.strategies)
    against = baseline or result.baseline or ("passive" if "passive" in ran else ran[0])
    if result.roads > 1:
        seed = result.scenario["road"]["seed"]
        name = f"{name}, {result.roads} roads (seeds {seed} to {seed + result.roads - 1}; events of {seed})"
    typer.echo(f"Ridelab core {result.core_version}, {name}; changes against {names.label(against)}")
    show_run(result, against, names)
