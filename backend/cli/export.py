"""`ridelab export`: a stored result as a file."""

import json
from collections.abc import Iterator
from typing import Annotated

import typer

from backend.cli import options, output, targets
from backend.cli.following import Table, take
from backend.cli.reporting import InputError, note
from backend.cli.run import with_units
from backend.cli.services import Services
from backend.client import Ridelab, RunResult


def export(
    target: Annotated[str, typer.Argument(metavar="RESULT", help="Id or address of a run, a batch or a link.")],
    out: Annotated[str, typer.Option(metavar="FILE", help="Where to write: .csv, .parquet or .json; - is stdout.")],
    file_format: options.Format = None,
    strategy: options.Strategies = None,
    signals: Annotated[
        list[str] | None,
        typer.Option(
            metavar="KEYS", help="Of a run: some signals, with commas; time and position always.", show_default=False
        ),
    ] = None,
    points: Annotated[
        int | None,
        typer.Option(metavar="N", min=2, help="Of a run: about N samples instead of all.", show_default=False),
    ] = None,
    metrics: Annotated[
        bool, typer.Option("--metrics", help="Of a run: its figures as JSON, as compare reads them.")
    ] = False,
    wait: Annotated[bool, typer.Option("--wait", help="Of a batch: until it has ended.")] = False,
    server: options.Server = None,
    data_dir: options.DataDir = None,
) -> None:
    """Write a run's time histories, or a batch's table of figures, to a file; units are in the header.

    The name's end or --format says how. A whole file replaces an older one; a broken one never does.
    """
    chosen = "json" if metrics else output.chosen_format(out, file_format)
    with Services(server, data_dir) as services:
        found = targets.find(target, services)
        if found.batch is not None and wait:
            there = None if services.started or found.ridelab is None else found.ridelab.address
            named = metrics or file_format is not None
            table = Table(out=out, file_format=chosen, named=named, server=there, data_dir=data_dir)
            take(found.batch, table, ours=False)
            return
        if found.batch is not None:
            if not found.batch.finished:
                left = found.batch.total - found.batch.done - found.batch.failed
                note(f"The batch is {found.batch.state}: {left} of {found.batch.total} rows wait")
            content = found.batch.content(chosen)
        elif found.run is not None and metrics:
            content = iter([json.dumps(with_units(found.run), indent=1, ensure_ascii=False).encode() + b"\n"])
        elif found.run is not None and found.ridelab is not None:
            content = _series(found.ridelab, found.run, chosen, options.listed(strategy), signals, points)
        else:
            raise InputError(f"{target}: export takes a stored run, batch or link; run and sweep make them")
        output.deliver(content, out)


def _series(
    ridelab: Ridelab,
    run: RunResult,
    file_format: str,
    strategies: list[str],
    signals: list[str] | None,
    points: int | None,
) -> Iterator[bytes]:
    names = strategies or [outcome.strategy for outcome in run if outcome.status == "ok"]
    keys = options.listed(signals) or None
    return ridelab.series_content(run, file_format, strategies=names, signals=keys, points=points)
