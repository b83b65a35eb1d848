"""`ridelab tune`: look for better weights."""

import json
import sys
from pathlib import Path
from typing import Annotated, Any

import typer

from ridelab.cli import fields, options, targets, tuned
from ridelab.cli.following import estimate_text, followed, later, may_detach, submitted, told_end
from ridelab.cli.reporting import DIFFERENT, note, nothing_submitted, print_json
from ridelab.cli.service import Services
from ridelab.client import Ridelab
from ridelab.files import save
from ridelab.jobs import Tuning


def tune(
    scenario: options.Scenario = "paper",
    objective: Annotated[
        list[str] | None,
        typer.Option(
            metavar="OBJECTIVE",
            help="paper (Eq. 16), peaks (the same with peaks), or a figure such as bump.body_acceleration.peak; "
            "paper@bump is over that window, paper:2,1,1 has other q. Up to three: a Pareto front [default: paper].",
            show_default=False,
        ),
    ] = None,
    limit: Annotated[
        list[str] | None,
        typer.Option(metavar="FIGURE=MOST", help="On every training road, such as events.travel_exceeded_mm=1."),
    ] = None,
    strategy: Annotated[str, typer.Option("--strategy", "-s", metavar="ID", help="lv, suspension_only or lqr.")] = "lv",
    search: Annotated[
        list[str] | None,
        typer.Option(
            metavar="WEIGHT=LOW:HIGH",
            help="Only these weights, such as mpc.stage_weights.bump.2=0.1:20 [default: all, 0.05:50].",
            show_default=False,
        ),
    ] = None,
    trials: Annotated[
        int | None, typer.Option(metavar="N", min=1, help="Sets of weights in all [default: 200].", show_default=False)
    ] = None,
    seeds: Annotated[
        str | None, typer.Option(metavar="SEEDS", help="Roads trained on [default: 1-4].", show_default=False)
    ] = None,
    fresh: Annotated[
        str | None, typer.Option(metavar="SEEDS", help="Roads compared on [default: 101-110].", show_default=False)
    ] = None,
    population: Annotated[
        int | None, typer.Option(metavar="N", min=1, help="Tried at once [default: 16].", show_default=False)
    ] = None,
    seed: Annotated[int, typer.Option(metavar="N", min=0, help="Same request, same trials.")] = 0,
    changes: options.Changes = None,
    resume: Annotated[
        str | None,
        typer.Option(metavar="TUNING", help="Go on with this one, or show it where it is done.", show_default=False),
    ] = None,
    out: Annotated[
        Path | None,
        typer.Option(
            "--out",
            "-o",
            metavar="FILE",
            help="Write the scenario with the tuned weights, as JSON.",
            dir_okay=False,
            show_default=False,
        ),
    ] = None,
    label: options.Label = None,
    detach: options.Detach = False,
    dry_run: options.DryRun = False,
    as_json: Annotated[bool, typer.Option("--json", help="The whole tuning, as JSON.")] = False,
    server: options.Server = None,
    data_dir: options.DataDir = None,
) -> None:
    """Look for weights that make an objective small, and compare them with the paper's on fresh roads.

    Ctrl-C cancels; --resume goes on where it stopped. With several objectives --out takes the front's knee.
    """
    with Services(server, data_dir) as services:
        may_detach(detach, services)
        ridelab = services.at()
        if resume is not None:
            tuning = _resumed(ridelab, resume, trials)
        else:
            try:
                start = fields.changed(targets.find(scenario, services).scenario, changes or [], services)
                asked = {
                    "objectives": [tuned.objective(text) for text in objective or ["paper"]],
                    "limits": [tuned.limit(text) for text in limit or []],
                    "search": fields.ranges_of(search, "--search", services) if search else None,
                    "seeds": tuned.seeds(seeds, "--seeds"),
                    "fresh_seeds": tuned.seeds(fresh, "--fresh"),
                    "trials": trials,
                    "population": population,
                }
                request = {"scenario": start, "strategy": strategy, "seed": seed}
                request |= {name: value for name, value in asked.items() if value is not None}
                if dry_run:
                    found = ridelab.estimate_tuning(request)
                    print_json(found) if as_json else typer.echo(estimate_text(found, ("runs", "generations")))
                    return
            except KeyboardInterrupt:
                raise nothing_submitted() from None
            tuning = submitted(lambda key: ridelab.tune(request, key), label, lambda tuning: later(tuning, services))
        follow_up = later(tuning, services)
        if detach:
            print_json(tuning.answer) if as_json else typer.echo(tuning.id)
            note(f"{tuning.total} trials; {follow_up} shows how it ended")
            return
        if code := followed(tuning, follow_up):
            note(f"To go on: {follow_up}")
            raise typer.Exit(code)
        if tuning.state == "done":
            _show(tuning, out, services, as_json=as_json)
    code = told_end(tuning)
    raise typer.Exit(code if tuning.state != "done" else DIFFERENT * (_wanted(tuning) is None))


def _resumed(ridelab: Ridelab, tuning_id: str, trials: int | None) -> Tuning:
    """It goes on; where it is done and no more trials are asked for it stays as it is."""
    tuning = ridelab.get_tuning(tuning_id)
    if tuning.state == "done" and trials in (None, tuning.total):
        return tuning
    return tuning.resume(trials)


def _wanted(tuning: Tuning) -> dict[str, Any] | None:
    return tuning.knee or tuning.best[0]


def _show(tuning: Tuning, out: Path | None, services: Services, *, as_json: bool) -> None:
    print_json(tuning.answer) if as_json else tuned.show(tuning, services.names)
    best = _wanted(tuning)
    if out is not None and best is not None:
        scenario = fields.with_values(tuning.answer["scenario"], best["weights"])
        save([json.dumps(scenario, indent=1).encode() + b"\n"], out)
        note(f"{out} has the weights of trial {best['number']}")
    sys.stdout.flush()
