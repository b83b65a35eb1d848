"""`ridelab compare`: two results, figure by figure; its exit code says whether they are the same."""

import dataclasses
import json
import math
from typing import Annotated

import typer

from backend.cli import options, targets
from backend.cli.differences import Difference, Tolerance, differences, inputs
from backend.cli.reporting import DIFFERENT, InputError
from backend.cli.services import Services
from backend.client import RunResult

_RESULT = "File of a scenario or of a saved run (run --json), preset, run id, or address of a run or link."


def compare(
    a: Annotated[str, typer.Argument(metavar="A", help=_RESULT)],
    b: Annotated[str, typer.Argument(metavar="B", help="The same; changes are from A to B.")],
    strategy: options.Strategies = None,
    tolerance: Annotated[
        float, typer.Option(metavar="REL", min=0, help="Equal up to this part of A's value, such as 0.01.")
    ] = 1e-6,
    tolerance_abs: Annotated[
        float, typer.Option(metavar="ABS", min=0, help="Equal up to this much, in each figure's own unit.")
    ] = 1e-9,
    limit: Annotated[int, typer.Option(metavar="N", min=0, help="Show the N largest differences, 0 for all.")] = 20,
    as_json: Annotated[bool, typer.Option("--json", help="Every difference, as JSON.")] = False,
    server: options.Server = None,
    data_dir: options.DataDir = None,
) -> None:
    """Compare two results figure by figure, the largest change first.

    A and B are equal where |B - A| is at most the larger of ABS and REL times |A|. Scenarios are run first, with the
    strategies of the other side or those --strategy names.

    Exit codes: 0 equal within the tolerance, 1 different, 2 bad input, 3 no service or it failed.
    """
    if a == b == "-":
        raise InputError("Only one of A and B can be standard input")
    with Services(server, data_dir) as services:
        found = [targets.find(target, services) for target in (a, b)]
        wanted = options.listed(strategy)
        runs = [_run(item, wanted, found, services) for item in found]
    names = wanted or list(dict.fromkeys([*runs[0].strategies, *runs[1].strategies]))
    told = differences(runs[0], runs[1], names, Tolerance(relative=tolerance, absolute=tolerance_abs))
    if as_json:
        _print_json(runs, told)
    else:
        _print(found, runs, names, told[:limit] if limit else told, len(told))
    if told:
        raise typer.Exit(DIFFERENT)


def _run(item: targets.Found, wanted: list[str], both: list[targets.Found], services: Services) -> RunResult:
    """The run to compare: as it is stored, or made now."""
    if item.batch is not None:
        raise InputError(f"{item.name}: compare takes single runs; export writes a batch's table")
    if item.run is not None:
        missing = [name for name in wanted if name not in item.run.strategies]
        if missing:
            raise InputError(f"{item.name}: it has no {', '.join(missing)}, only {', '.join(item.run.strategies)}")
        return item.run
    from sim_core.strategies import STRATEGIES

    others = [name for other in both for name in targets.strategies_of(other)]
    roads = max((other.run.roads for other in both if other.run is not None), default=1)
    return services.at().run(item.scenario, wanted or others or list(STRATEGIES), roads=roads)


def _print_json(runs: list[RunResult], told: list[Difference]) -> None:
    listed = [
        {**dataclasses.asdict(item), "change": item.change if math.isfinite(item.change) else None} for item in told
    ]
    sides = [{"id": run.id, "core_version": run.core_version} for run in runs]
    changed = [{"field": name, "a": one, "b": other} for name, one, other in inputs(runs[0].scenario, runs[1].scenario)]
    answer = {"a": sides[0], "b": sides[1], "equal": not told, "inputs": changed, "differences": listed}
    typer.echo(json.dumps(answer, indent=1, ensure_ascii=False))


def _print(
    found: list[targets.Found], runs: list[RunResult], names: list[str], told: list[Difference], all_told: int
) -> None:
    from backend.cli.tables import aligned, shown, with_unit
    from sim_core.scenario import dotted

    for side, item, run in zip("AB", found, runs, strict=True):
        over = f", mean of {run.roads} roads" if run.roads > 1 else ""
        typer.echo(f"{side}  {item.name} (core {run.core_version}{over})")
    for name, one, other in inputs(runs[0].scenario, runs[1].scenario):
        unit = dotted.fields()[name].unit if name in dotted.fields() else "1"
        typer.echo(f"   {with_unit(name, unit)}: {shown(one)} -> {shown(other)}")
    if not told:
        count = sum(len(runs[0][name].figures()) for name in names)
        typer.echo(f"Equal within the tolerance: {count} figures of {', '.join(names)}")
        return
    rows = [
        [item.strategy, with_unit(item.figure, item.unit), shown(item.a), shown(item.b), _percent(item.change)]
        for item in told
    ]
    typer.echo("")
    for line in aligned(["strategy", "figure", "A", "B", "change"], rows, left={0, 1}):
        typer.echo(line)
    more = f"; these are the {len(told)} largest, --limit 0 shows all" if all_told > len(told) else ""
    typer.echo(f"\n{all_told} figures differ beyond the tolerance{more}")


def _percent(change: float) -> str:
    return f"{100 * change:+.2f} %" if math.isfinite(change) else "-"
