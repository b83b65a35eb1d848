"""`ridelab tune`: look for better weights."""

import json
import sys
from pathlib import Path
from typing import Annotated, Any

import typer

from ridelab.cli import fields, options, tuned
from ridelab.cli.following import followed, later, may_detach, say_end, show_estimate, submitted
from ridelab.cli.reporting import DIFFERENT, note, print_json
from ridelab.cli.service import Services
from ridelab.client import Ridelab
from ridelab.files import save
from ridelab.jobs import Tuning


def tune(
    services: Services,
    scenario: options.Scenario = "paper",
    objective: Annotated[
        list[str] | None,
        options.option(
            "OBJECTIVE",
            "paper (Eq. 16), peaks (the same with peaks), or a figure such as bump.body_acceleration.peak; "
            "paper@bump is over that window, paper:2,1,1 has other q. Up to three: a Pareto front [default: paper].",
        ),
    ] = None,
    limit: Annotated[
        list[str] | None,
        typer.Option(metavar="FIGURE=MOST", help="On every training road, such as events.travel_exceeded_mm=1."),
    ] = None,
    strategy: Annotated[str, typer.Option("--strategy", "-s", metavar="ID", help="lv, suspension_only or lqr.")] = "lv",
    search: Annotated[
        list[str] | None,
        options.option(
            "WEIGHT=LOW:HIGH", "Only these weights, such as mpc.stage_weights.bump.2=0.1:20 [default: all, 0.05:50]."
        ),
    ] = None,
    trials: Annotated[int | None, options.option("N", "Sets of weights in all [default: 200].", min=1)] = None,
    seeds: Annotated[str | None, options.option("SEEDS", "Roads trained on [default: 1-4].")] = None,
    fresh: Annotated[str | None, options.option("SEEDS", "Roads compared on [default: 101-110].")] = None,
    population: Annotated[int | None, options.option("N", "Tried at once [default: 16].", min=1)] = None,
    seed: Annotated[int, typer.Option(metavar="N", min=0, help="Same request, same trials.")] = 0,
    changes: options.Changes = None,
    resume: Annotated[str | None, options.option("TUNING", "Go on with this one, or show it where it is done.")] = None,
    out: Annotated[
        Path | None,
        options.option("FILE", "Write the scenario with the tuned weights, as JSON.", "--out", "-o", dir_okay=False),
    ] = None,
    label: options.Label = None,
    detach: options.Detach = False,
    dry_run: options.DryRun = False,
    as_json: Annotated[bool, typer.Option("--json", help="The whole tuning, as JSON.")] = False,
) -> None:
    """Look for weights that make an objective small, and compare them with the paper's on fresh roads.

    Ctrl-C cancels; --resume goes on where it stopped. With several objectives --out takes the front's knee.
    """
    may_detach(detach, services)
    ridelab = services.at()
    if resume is not None:
        tuning = _resumed(ridelab, resume, trials)
    else:
        asked = {
            "objectives": [tuned.objective(text) for text in objective or ["paper"]],
            "limits": [tuned.limit(text) for text in limit or []],
            "search": fields.ranges_of(search, "--search", services) if search else None,
            "seeds": tuned.seeds(seeds, "--seeds"),
            "fresh_seeds": tuned.seeds(fresh, "--fresh"),
            "trials": trials,
            "population": population,
            "label": label,
        }
        start = fields.scenario_of(scenario, changes, services)
        request = {"scenario": start, "strategy": strategy, "seed": seed}
        request |= {name: value for name, value in asked.items() if value is not None}
        if dry_run:
            show_estimate(ridelab.estimate_tuning(request), "runs", "generations", as_json=as_json)
            return
        tuning = submitted(lambda key: ridelab.tune(request, key), services)
    if detach:
        print_json(tuning.answer) if as_json else typer.echo(tuning.id)
        note(f"{tuning.total} trials; {later(tuning, services)} shows how it ended")
        return
    if code := followed(tuning, services):
        note(f"To go on: {later(tuning, services)}")
        raise typer.Exit(code)
    if tuning.state == "done":
        _show(tuning, out, services, as_json=as_json)
    code = say_end(tuning)
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
