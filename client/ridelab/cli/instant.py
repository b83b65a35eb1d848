"""`ridelab instant`: why a controller commanded its forces at one instant of a run."""

from typing import Annotated, Any

import typer

from ridelab.cli import fields, options, targets
from ridelab.cli.reporting import InputError, print_json, show_table
from ridelab.cli.service import Services

_RUN = "Id or address of a run or link; or a scenario, which is run first."
_WHOSE = "Whose controller [default: the run's first; of a scenario lv]."
_LEAST_SHARE = 0.005  # of the cost, that is shown


def instant(
    services: Services,
    target: Annotated[str, typer.Argument(metavar="RUN", help=_RUN, autocompletion=options.completes("presets"))],
    strategy: Annotated[str | None, options.option("ID", _WHOSE, "--strategy", "-s", completes="strategies")] = None,
    changes: options.Changes = None,
    position: Annotated[float | None, options.option("M", "Of the front axle [m].", "--position")] = None,
    time: Annotated[float | None, options.option("S", "In its place [s].", "--time")] = None,
    as_json: options.AsJson = False,
) -> None:
    """Show why a controller commanded its forces at one instant: what it saw, its limits with their price, its cost.

    Over a run of several roads it is the first road.
    """
    if (position is None) == (time is None):
        raise InputError("Give --position or --time")
    strategy = strategy and options.one_strategy(strategy)
    source = targets.find(target, services)
    ridelab = source.ridelab or services.at()
    run = source.run
    strategy = strategy or next(iter(services.names.strategies if run is None else run.strategies))
    if run is None or changes:
        run = ridelab.run(fields.changed(source.scenario, changes or [], services), [strategy])
    answer = ridelab.instant(run, strategy, position=position, time=time)
    if as_json:
        print_json({"run_id": run.id, **answer})
        return
    label = services.names.label(strategy)
    where = f"{answer['position']:.2f} m, {answer['time']:.3f} s, {3.6 * answer['speed']:.1f} km/h"
    typer.echo(f"{label} at {where}, stage {answer['stage']}\n{answer['why']}\n")
    forces = answer["forces"]
    show_table(
        ["force [N]", *forces],
        [[axle, *(_newtons(each and each[i]) for each in forces.values())] for i, axle in enumerate(("front", "rear"))],
    )
    if answer["limits"]:
        typer.echo()
        show_table(
            ["limit", "of", "distance", "multiplier", "front without [N]", "rear without [N]"],
            [_limit(each) for each in answer["limits"]],
        )
    if answer["cost"]:
        total = sum(answer["cost"].values())
        shares = {name: value / total for name, value in answer["cost"].items() if value > _LEAST_SHARE * total}
        typer.echo()
        show_table(["cost", "share"], [[name, f"{share:.1%}"] for name, share in shares.items()])
    if ridelab is not services.opened.get(None):  # a private service ends before anybody opens a page of it
        place = f"{strategy}~{round(answer['position'], 2):g}"
        typer.echo(f"\n{ridelab.address}/r/{run.id}?instant={place}")


def _limit(limit: dict[str, Any]) -> list[str]:
    """A row: its price is a dash where nothing is minimised."""
    unit, multiplier = limit["unit"], limit["multiplier"]
    price = "-" if multiplier is None else f"{multiplier:.3g} 1/{unit}"
    without = limit["force_without"] or [None, None]
    return [
        limit["name"],
        f"{limit['limit']:.4g} {unit}",
        f"{limit['distance']:.4g} {unit}",
        price,
        *map(_newtons, without),
    ]


def _newtons(force: float | None) -> str:
    return "-" if force is None else f"{force:z.0f}"
