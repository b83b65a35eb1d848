"""`ridelab export`: a stored result as a file."""

import csv
import io
import json
from collections.abc import Iterator
from typing import Annotated

import typer

from ridelab.cli import options, targets
from ridelab.cli.following import file_options, followed
from ridelab.cli.reporting import InputError, chosen_format, deliver, note
from ridelab.cli.run import with_units
from ridelab.cli.service import Services
from ridelab.results import Interval, RunResult, flat


def export(
    services: Services,
    target: Annotated[str, typer.Argument(metavar="RESULT", help="Id or address of a run, a batch or a link.")],
    out: Annotated[
        str, typer.Option("--out", "-o", metavar="FILE", help="Where to write: .csv, .parquet or .json; - is stdout.")
    ],
    file_format: options.Format = None,
    strategy: options.Strategies = None,
    signals: Annotated[
        list[str] | None, options.option("KEYS", "Of a run: some signals, with commas; time and position always.")
    ] = None,
    points: Annotated[int | None, options.option("N", "Of a run: about N samples instead of all.", min=2)] = None,
    metrics: Annotated[
        bool, typer.Option("--metrics", help="Of a run: its metrics, as .csv or as the .json that compare reads.")
    ] = False,
    wait: Annotated[bool, typer.Option("--wait", help="Of a batch: until it has ended.")] = False,
) -> None:
    """Write a run's time histories or metrics, or a batch's table, to a file; units are in the header.

    The name's end or --format says how. A whole file replaces an older one; a broken one never does.
    """
    wanted = chosen_format(out, file_format)
    if metrics and wanted == "parquet":
        raise InputError("--metrics: The file's format has to be json or csv")
    found = targets.find(target, services)
    if found.batch is not None:
        if wait:
            followed(found.batch, services, *file_options(out, file_format), ours=False)
        elif not found.batch.finished:
            left = found.batch.total - found.batch.done - found.batch.failed
            note(f"The batch is {found.batch.state}: {left} of {found.batch.total} rows wait")
        content = found.batch.content(wanted)
    elif found.run is not None and metrics:
        text = json.dumps(with_units(found.run), indent=1, ensure_ascii=False) + "\n"
        content = iter([(text if wanted == "json" else _metrics_csv(found.run)).encode()])
    elif found.run is not None and found.ridelab is not None:
        names = options.listed(strategy) or [each.strategy for each in found.run if each.status == "ok"]
        content = found.ridelab.series_content(
            found.run, wanted, strategies=names, signals=options.listed(signals) or None, points=points
        )
    else:
        raise InputError(f"{target}: export takes a stored run, batch or link; run and sweep make them")
    deliver(content, out)


def _metrics_csv(run: RunResult) -> str:
    """A line a strategy and metric; over several roads with the mean's 95 % interval."""
    file = io.StringIO()
    writer = csv.writer(file, lineterminator="\n")
    writer.writerow(["strategy", "metric", "unit", "value", *(["low", "high"] if run.roads > 1 else [])])
    writer.writerows(_metric_rows(run))
    return file.getvalue()


def _metric_rows(run: RunResult) -> Iterator[list[object]]:
    for outcome in run:
        intervals = dict(flat({**outcome.metrics, "comfort": outcome.comfort}))
        for name, value in outcome.figures().items():
            interval = intervals.get(name)
            ends = [interval.low, interval.high] if isinstance(interval, Interval) else [None] * 2 * (run.roads > 1)
            yield [outcome.strategy, name, run.units.get(name, "1"), value, *ends]
