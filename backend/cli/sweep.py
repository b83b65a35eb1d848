"""`ridelab sweep`: a batch of what-ifs."""

import itertools
import json
import shutil
import sys
import uuid
from pathlib import Path
from typing import Annotated, Any

import typer

from backend.cli import fields, options, output, targets
from backend.cli.following import Table, interrupted, take
from backend.cli.reporting import DIFFERENT, InputError, UnavailableError, note, nothing_submitted
from backend.cli.services import Services
from backend.client import Batch, Ridelab

_PREVIEW = 20  # rows shown where no file is asked for
_FIGURES = ("rough_road.body_acceleration.rms", "bump.body_acceleration.peak", "bump.front_tyre_load.peak")


def sweep(
    scenario: options.Scenario = "paper",
    grid: Annotated[
        list[str] | None,
        typer.Option(
            metavar="FIELD=VALUES",
            help="road.bump.height=0.05:0.15:11 (evenly, both ends) or =0.05,0.1; repeated: every combination.",
            show_default=False,
        ),
    ] = None,
    latin_hypercube: Annotated[
        list[str] | None,
        typer.Option(metavar="FIELD=LOW:HIGH", help="Evenly spread random points in these ranges.", show_default=False),
    ] = None,
    samples: Annotated[
        int | None, typer.Option(metavar="N", min=1, help="Points of the hypercube.", show_default=False)
    ] = None,
    seed: Annotated[int, typer.Option(metavar="N", min=0, help="Of the hypercube: same seed, same points.")] = 0,
    points: Annotated[
        Path | None,
        typer.Option(
            "--list",
            metavar="FILE",
            help='JSON list of points, [{"road.bump.height": 0.1}, ..].',
            exists=True,
            dir_okay=False,
            show_default=False,
        ),
    ] = None,
    strategy: options.Strategies = None,
    changes: options.Changes = None,
    out: Annotated[
        str | None,
        typer.Option(metavar="FILE", help="Write every row to .csv, .parquet or .json; - is stdout."),
    ] = None,
    file_format: options.Format = None,
    detach: Annotated[bool, typer.Option("--detach", help="Hand it in and leave; needs --server.")] = False,
    dry_run: Annotated[bool, typer.Option("--dry-run", help="Only say how many runs and how long.")] = False,
    as_json: Annotated[bool, typer.Option("--json", help="How the batch ended, as JSON.")] = False,
    server: options.Server = None,
    data_dir: options.DataDir = None,
) -> None:
    """Run many variants of a scenario; Ctrl-C cancels and keeps what is finished.

    One of --grid, --latin-hypercube and --list says what varies. The strategy is lv unless --strategy names others.
    """
    wanted = fields.sweep_of(grid=grid or [], ranges=latin_hypercube or [], samples=samples, seed=seed, points=points)
    if detach and server is None:
        raise InputError("--detach needs --server: a private service ends with this command")
    chosen = "" if out is None else output.chosen_format(out, file_format)
    table = Table(out=out, file_format=chosen, named=file_format is not None, server=server, data_dir=data_dir)
    with Services(server, data_dir) as services:
        try:
            start = fields.changed(targets.find(scenario, services).scenario, changes or [])
            ridelab, names = services.at(), options.listed(strategy) or ["lv"]
            if dry_run:
                _estimate(ridelab.estimate(start, names, wanted), as_json=as_json)
                return
        except KeyboardInterrupt:
            raise nothing_submitted() from None
        batch = _submit(ridelab, start, names, wanted, table)
        if not detach:
            take(batch, table, ours=True)
            if out is None and not as_json:
                _preview(batch)
        elif not as_json:
            typer.echo(f"{batch.id}")
            note(f"{batch.total} runs; ridelab export {batch.id} --wait --out FILE --server {ridelab.address}")
    if as_json:
        typer.echo(json.dumps(batch.answer, indent=1, ensure_ascii=False))
    _end(batch, detached=detach)


def _submit(
    ridelab: Ridelab, scenario: dict[str, Any], strategies: list[str], sweep: dict[str, Any], table: Table
) -> Batch:
    """Hand it in. Interrupted meanwhile, nobody knows whether it was accepted: the same key tells, and it ends."""
    key = uuid.uuid4().hex
    try:
        return ridelab.submit(scenario, strategies, sweep, idempotency_key=key)
    except KeyboardInterrupt:
        batch = ridelab.submit(scenario, strategies, sweep, idempotency_key=key)
        raise interrupted(batch, table) from None


def _estimate(found: dict[str, Any], *, as_json: bool) -> None:
    if as_json:
        typer.echo(json.dumps(found, indent=1))
        return
    seconds = found.get("estimated_seconds")
    told = "" if seconds is None else f", about {seconds:.3g} s"
    typer.echo(f"{found['total']} runs at {found['points']} points{told}")


def _preview(batch: Batch) -> None:
    """The first rows, with the figures most people look at."""
    from backend.cli.tables import aligned, shown, with_unit
    from backend.client.answers import Outcome, units

    swept = [(item["name"], item["unit"]) for item in batch.answer["fields"]]
    figures = [(name, units()[name]) for name in _FIGURES]
    rows = []
    for row in itertools.islice(batch.rows(), _PREVIEW):
        found = Outcome.of(row["strategy"], {"compute_ms": 0, **row}).figures()
        told = [shown(row.get(name)) for name, _ in swept] + [row["strategy"], row["status"]]
        rows.append(told + [shown(found.get(name)) for name, _ in figures] + [row.get("reason") or ""])
    named = [with_unit(*item) for item in swept], [with_unit(*item) for item in figures]
    heads = [*named[0], "strategy", "status", *named[1], "reason" if any(row[-1] for row in rows) else ""]
    for line in aligned(heads, rows, left={len(swept), len(swept) + 1, len(heads) - 1}):
        typer.echo(line[: max(shutil.get_terminal_size().columns, 80)] if sys.stdout.isatty() else line)
    if batch.total > len(rows):
        typer.echo(f"... {batch.total - len(rows)} more; --out FILE writes all with every figure")


def _end(batch: Batch, *, detached: bool) -> None:
    if batch.state == "failed":
        raise UnavailableError(f"The batch failed: {batch.reason}")
    if detached:
        return
    note(f"batch {batch.id}: {batch.done} of {batch.total} runs done, {batch.failed} failed")
    if batch.failed or batch.state == "cancelled":
        raise typer.Exit(DIFFERENT)
