"""`ridelab export`: a stored result as a file."""

import csv
import io
import json
from typing import Annotated

import typer

from ridelab.cli import options, targets
from ridelab.cli.following import file_options, follow_to_end
from ridelab.cli.reporting import InputError, deliver, note, output_format
from ridelab.cli.run import with_units
from ridelab.cli.service import Services
from ridelab.results import Interval, RunResult, flat

_SIGNALS = "Of a run: some signals, with commas; time and position always."
_METRICS = "Of a run: its metrics, as .csv or as the .json that compare reads."


def export(
    services: Services,
    target: Annotated[str, typer.Argument(metavar="RESULT", help="Id or address of a run, a batch or a link.")],
    out: Annotated[str, options.option("FILE", "Where to write: .csv, .parquet or .json; - is stdout.", "--out", "-o")],
    file_format: options.Format = None,
    strategy: options.Strategies = None,
    signals: Annotated[list[str] | None, options.option("KEYS", _SIGNALS)] = None,
    points: Annotated[int | None, options.option("N", "Of a run: about N samples instead of all.", min=2)] = None,
    metrics: Annotated[bool, options.flag(_METRICS, "--metrics")] = False,
    wait: Annotated[bool, options.flag("Of a batch: until it has ended.", "--wait")] = False,
    as_json: options.AsJson = False,
) -> None:
    """Write a run's time histories or metrics, or a batch's table, to a file; units are in the header.

    The name's end or --format says how. A whole file replaces an older one; a broken one never does.
    """
    kind = output_format(out, file_format, as_json=as_json)
    if metrics and kind == "parquet":
        raise InputError("--metrics: The file's format has to be json or csv")
    source = targets.find(target, services)
    if source.batch is not None:
        if wait:
            follow_to_end(source.batch, services, *file_options(out, file_format), ours=False)
        elif not source.batch.finished:
            left = len(source.batch) - source.batch.done - source.batch.failed
            note(f"The batch is {source.batch.state}: {left} of {len(source.batch)} rows wait")
        content = source.batch.content(kind)
    elif source.run is not None and metrics:
        text = json.dumps(with_units(source.run), indent=1, ensure_ascii=False) + "\n"
        content = iter([(text if kind == "json" else _metrics_csv(source.run)).encode()])
    elif source.run is not None and source.ridelab is not None:
        names = options.listed(strategy) or [each.strategy for each in source.run if each.status == "ok"]
        content = source.ridelab.series_content(
            source.run, kind, strategies=names, signals=options.listed(signals, "--signals") or None, points=points
        )
    else:
        raise InputError(f"{target}: export takes a stored run, batch or link; run and sweep make them")
    deliver(content, out, as_json=as_json, format=kind)


def _metrics_csv(run: RunResult) -> str:
    """A line a strategy and metric; over several roads with the mean's 95 % interval."""
    file = io.StringIO()
    writer = csv.writer(file, lineterminator="\n")
    writer.writerow(["strategy", "metric", "unit", "value", *(["low", "high"] if run.roads > 1 else [])])
    for outcome in run:
        intervals = dict(flat({**outcome.metrics, "comfort": outcome.comfort}))
        for name, value in outcome.figures().items():
            interval = intervals.get(name)
            ends = [interval.low, interval.high] if isinstance(interval, Interval) else [None] * 2 * (run.roads > 1)
            writer.writerow([outcome.strategy, name, run.units.get(name, "1"), value, *ends])
    return file.getvalue()
