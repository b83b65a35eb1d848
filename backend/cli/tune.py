"""`ridelab tune`: look for better weights."""

import json
import shlex
import sys
import uuid
from pathlib import Path
from typing import Annotated, Any

import typer
from rich.progress import BarColumn, MofNCompleteColumn, Progress, TextColumn, TimeRemainingColumn

from backend.cli import fields, options, targets, tuned
from backend.cli.reporting import (
    DIFFERENT,
    INTERRUPTED,
    InputError,
    UnavailableError,
    note,
    nothing_submitted,
    terminal,
)
from backend.cli.services import Services
from backend.client import Ridelab, RidelabClientError, Tuning
from backend.client.address import without_login
from backend.client.files import save
from sim_core.scenario import dotted


def tune(
    scenario: options.Scenario = "paper",
    objective: Annotated[
        list[str] | None,
        typer.Option(
            "--objective",
            "-o",
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
            metavar="FILE",
            help="Write the scenario with the tuned weights, as JSON.",
            dir_okay=False,
            show_default=False,
        ),
    ] = None,
    detach: Annotated[bool, typer.Option("--detach", help="Hand it in and leave; needs --server.")] = False,
    dry_run: Annotated[bool, typer.Option("--dry-run", help="Only say how many runs and how long.")] = False,
    as_json: Annotated[bool, typer.Option("--json", help="The whole tuning, as JSON.")] = False,
    server: options.Server = None,
    data_dir: options.DataDir = None,
) -> None:
    """Look for weights that make an objective small, and compare them with the paper's on fresh roads.

    Ctrl-C cancels; --resume goes on where it stopped. With several objectives --out takes the front's knee.
    """
    if detach and server is None:
        raise InputError("--detach needs --server: a private service ends with this command")
    with Services(server, data_dir) as services:
        ridelab = services.at()
        if resume is not None:
            tuning = _resumed(ridelab, resume, trials)
        else:
            try:
                start = fields.changed(targets.find(scenario, services).scenario, changes or [])
            except KeyboardInterrupt:
                raise nothing_submitted() from None
            chosen = {
                "objectives": [tuned.objective(text) for text in objective or ["paper"]],
                "limits": [tuned.limit(text) for text in limit or []],
                "search": fields.ranges_of(search, "--search") if search else None,
                "seeds": tuned.seeds(seeds, "--seeds"),
                "fresh_seeds": tuned.seeds(fresh, "--fresh"),
                "trials": trials,
                "population": population,
            }
            request = {"scenario": start, "strategy": strategy, "seed": seed}
            request |= {name: value for name, value in chosen.items() if value is not None}
            if dry_run:
                _estimate(ridelab.estimate_tuning(request), as_json=as_json)
                return
            tuning = _submit(ridelab, request, server, data_dir)
        if detach:
            typer.echo(json.dumps(tuning.answer, indent=1) if as_json else tuning.id)
            note(f"{tuning.total} trials; {_command(tuning, server, data_dir)} shows how it ended")
            return
        _follow(tuning, server, data_dir)
    _show(tuning, out, as_json=as_json)


def _submit(ridelab: Ridelab, request: dict[str, Any], server: str | None, data_dir: Path | None) -> Tuning:
    """Hand it in; interrupted meanwhile, the same key tells whether it was accepted, and it ends."""
    key = uuid.uuid4().hex
    try:
        return ridelab.tune(request, idempotency_key=key)
    except KeyboardInterrupt:
        raise _interrupted(ridelab.tune(request, idempotency_key=key), server, data_dir) from None


def _resumed(ridelab: Ridelab, tuning_id: str, trials: int | None) -> Tuning:
    """It goes on; where it is done and no more trials are asked for it stays as it is."""
    tuning = ridelab.get_tuning(tuning_id)
    if tuning.state == "done" and trials in (None, tuning.total):
        return tuning
    return tuning.resume(trials)


def _follow(tuning: Tuning, server: str | None, data_dir: Path | None) -> None:
    columns = (
        TextColumn("{task.description}"),
        BarColumn(),
        MofNCompleteColumn(),
        TextColumn("{task.fields[told]}"),
        TimeRemainingColumn(),
    )
    console = terminal()
    try:
        with Progress(*columns, console=console, disable=not console.is_terminal, transient=True) as bar:
            task = bar.add_task(tuning.state, total=tuning.total, told="")

            def show(tuning: Tuning) -> None:
                told = f"{tuning.feasible} within the limits" if tuning.answer["limits"] else ""
                word = tuning.answer["step"] if tuning.state == "running" else tuning.state
                bar.update(task, description=word, completed=tuning.done + tuning.failed, told=told)

            tuning.wait(show)
    except KeyboardInterrupt:
        raise _interrupted(tuning, server, data_dir) from None


def _interrupted(tuning: Tuning, server: str | None, data_dir: Path | None) -> typer.Exit:
    """Cancel it and say how to go on; the exit to raise."""
    try:
        tuning.cancel()
        word = "Cancelled" if tuning.state == "cancelled" else "Interrupted"
        note(f"{word} after {tuning.done + tuning.failed} of {tuning.total} trials, which stay stored")
    except (RidelabClientError, KeyboardInterrupt) as error:
        note(str(error) or "Interrupted again")
    note(f"To go on: {_command(tuning, server, data_dir)}")
    return typer.Exit(INTERRUPTED)


def _command(tuning: Tuning, server: str | None, data_dir: Path | None) -> str:
    """The command that goes on with it."""
    where: list[str] = []
    if server is not None:
        where = ["--server", without_login(server)]
    elif data_dir is not None:
        where = ["--data-dir", str(data_dir)]
    return shlex.join(["ridelab", "tune", "--resume", tuning.id, *where])


def _estimate(found: dict[str, Any], *, as_json: bool) -> None:
    if as_json:
        typer.echo(json.dumps(found, indent=1))
        return
    seconds = found["estimated_seconds"]
    told = "" if seconds is None else f", about {seconds:.3g} s"
    typer.echo(f"{found['runs']} runs in {found['generations']} generations{told}")


def _show(tuning: Tuning, out: Path | None, *, as_json: bool) -> None:
    if tuning.state == "failed":
        raise UnavailableError(f"The tuning failed: {tuning.reason}")
    if as_json:
        typer.echo(json.dumps(tuning.answer, indent=1, ensure_ascii=False))
    else:
        for line in tuned.lines(tuning.answer):
            typer.echo(line)
    best = tuning.knee or tuning.best[0]
    if out is not None and best is not None:
        scenario = dotted.with_changes(tuning.answer["scenario"], best["weights"])
        save([json.dumps(scenario, indent=1).encode() + b"\n"], out)
        note(f"{out} has the weights of trial {best['number']}")
    sys.stdout.flush()
    note(f"tuning {tuning.id}: {tuning.state}, {tuning.done} trials, {tuning.failed} failed")
    if best is None or tuning.state == "cancelled":
        raise typer.Exit(DIFFERENT)
