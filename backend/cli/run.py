"""`ridelab run`: strategies over one scenario."""

import json
from typing import Annotated, Any

import typer

from backend.cli import fields, options, targets
from backend.cli.reporting import DIFFERENT, InputError, note
from backend.cli.services import Services
from backend.client import RunResult


def run(
    scenario: options.Scenario = "paper",
    changes: options.Changes = None,
    strategy: options.Strategies = None,
    roads: Annotated[
        int,
        typer.Option(metavar="N", min=1, max=50, help="Drive N roads, seeds road.seed and on: mean and interval."),
    ] = 1,
    baseline: Annotated[
        str | None,
        typer.Option(metavar="ID", help="Strategy the changes refer to [default: passive].", show_default=False),
    ] = None,
    as_json: Annotated[bool, typer.Option("--json", help="The whole run as JSON, as compare reads it.")] = False,
    server: options.Server = None,
    data_dir: options.DataDir = None,
) -> None:
    """Run strategies over one scenario and show how they compare.

    All strategies unless --strategy names some. What is stored already is not computed again. Over several roads every
    figure is a mean with half its 95 % interval's width, every change that of the means, paired road by road.
    """
    from sim_core.strategies import STRATEGIES

    names = options.listed(strategy) or list(STRATEGIES)
    if baseline is not None and baseline not in names:
        raise InputError(f"--baseline: one of the strategies that run, {', '.join(names)}")
    with Services(server, data_dir) as services:
        found = targets.find(scenario, services)
        wanted = fields.changed(found.scenario, changes or [])
        ridelab = services.at()
        result = ridelab.run(wanted, names, roads=roads, baseline=baseline)
        if as_json:
            typer.echo(json.dumps(with_units(result), indent=1, ensure_ascii=False))
        else:
            _show(result, found.name, changes or [], baseline)
            typer.echo(f"\nrun {result.id}" if services.private else f"\n{ridelab.address}/r/{result.id}")
    if any(outcome.status != "ok" for outcome in result):
        note("Not every strategy could run")
        raise typer.Exit(DIFFERENT)


def with_units(run: RunResult) -> dict[str, Any]:
    """A run for machines: as the service answered it, and the unit of each figure by its flat name."""
    return {**run.answer, "units": run.units}


def _show(result: RunResult, name: str, changes: list[str], baseline: str | None) -> None:
    from backend.cli import tables

    names = list(result.strategies)
    against = baseline or result.baseline or ("passive" if "passive" in names else names[0])
    told = ", ".join([name, *changes])
    if result.roads > 1:
        seed = result.scenario["road"]["seed"]
        told = f"{told}, {result.roads} roads (seeds {seed} to {seed + result.roads - 1}; events of {seed})"
    typer.echo(f"Ridelab core {result.core_version}, {told}; changes against {tables.label(against)}")
    for line in tables.run_table(result, against):
        typer.echo(line)
