"""`ridelab sweep`: a batch of what-ifs."""

import itertools
from collections.abc import Mapping
from dataclasses import asdict
from functools import partial
from pathlib import Path
from typing import Annotated, Any

import typer

from ridelab.cli import fields, following, options, requirements, targets
from ridelab.cli.reporting import (
    DIFFERENT,
    InputError,
    deliver,
    note,
    output_format,
    print_json_rows,
    show_table,
    with_unit,
)
from ridelab.cli.service import Services
from ridelab.errors import RidelabClientError
from ridelab.jobs import Batch
from ridelab.requirements import failing
from ridelab.results import flat

_PREVIEW = 20  # rows shown where no file is asked for
_FIGURES = ("rough_road.body_acceleration.rms", "bump.body_acceleration.peak", "bump.front_tyre_load.peak")

_GRID = "road.bump.height=0.05:0.15:11 (evenly, both ends) or =0.05,0.1; repeated: every combination."
_CUBE = "Evenly spread random points in these ranges."
_LINK = "Fields that take a swept field's value too: speed.initial_speed_kmh=speed.target_speed_kmh."
_LIST = 'JSON list of points, [{"road.bump.height": 0.1}, ..].'
_OUT = "Write every row to .csv, .parquet or .json; - is stdout."


def sweep(
    services: Services,
    scenario: options.Scenario = "paper",
    grid: Annotated[list[str] | None, options.option("FIELD=VALUES", _GRID, completes="fields =")] = None,
    latin_hypercube: Annotated[list[str] | None, options.option("FIELD=LOW:HIGH", _CUBE, completes="fields =")] = None,
    samples: Annotated[int | None, options.option("N", "Points of the hypercube.", min=1)] = None,
    seed: options.Seed = 0,
    points: Annotated[Path | None, options.option("FILE", _LIST, "--list", exists=True, dir_okay=False)] = None,
    link: Annotated[list[str] | None, options.option("FIELD=FIELD,..", _LINK, completes="fields =")] = None,
    strategy: options.Strategies = None,
    changes: options.Changes = None,
    out: Annotated[str | None, options.option("FILE", _OUT, "--out", "-o")] = None,
    file_format: options.Format = None,
    baseline: options.Baseline = None,
    require: requirements.Require = None,
    strict: requirements.Strict = False,
    junit: requirements.Junit = None,
    label: options.Label = None,
    detach: options.Detach = False,
    dry_run: options.DryRun = False,
    as_json: Annotated[bool, options.flag("The batch and all its rows, as JSON.", "--json")] = False,
) -> None:
    """Run many variants of a scenario; Ctrl-C cancels and keeps what is finished.

    One of --grid, --latin-hypercube and --list says what varies. The strategy is lv unless --strategy names others.
    With --require the exit code is 1 where a run fails one; changes are against the baseline at the same point.
    """
    if sum((bool(grid), bool(latin_hypercube), points is not None)) != 1:
        raise InputError("Say what to sweep with one of --grid, --latin-hypercube and --list")
    if (samples is not None) != bool(latin_hypercube):
        raise InputError("--latin-hypercube and --samples belong together")
    kind = None if out is None else output_format(out, file_format)
    if detach:
        following.check_detachable(services)
    swept: dict[str, Any]
    if points is not None:
        swept = {"list": targets.document(points.read_bytes(), str(points))}
    elif grid:
        swept = {"grid": fields.grid_of(grid, services.names.fields)}
    else:
        ranges = fields.ranges_of(latin_hypercube or [], "--latin-hypercube", services.names.fields)
        swept = {"latin_hypercube": {"ranges": ranges, "samples": samples, "seed": seed}}
    if link:
        swept["linked"] = fields.links_of(link)
    ridelab, names = services.at(), options.listed(strategy) or ["lv"]
    start = fields.scenario_of(scenario, changes, services, _set_in_every_point(swept))
    if dry_run:
        following.show_estimate(ridelab.estimate(start, names, swept), "total", "points", as_json=as_json)
        return
    again = following.file_options(out, file_format)
    required = requirements.requirements_of(require, services)
    requirements.check_file(junit, required)
    submit = partial(ridelab.submit, start, names, swept, label=label, baseline=baseline, requirements=required)
    batch, code = following.submit_job(lambda key: submit(key), services, *again)
    if detach:
        following.show_detached(batch, services, *again, as_json=as_json)
        raise typer.Exit(code)
    code = code or following.follow_to_end(batch, services, *again)
    if out is not None and kind is not None:
        _write(batch, kind, out, following.resume_command(batch, services, *again))
    elif code:
        note(f"For its rows: {following.resume_command(batch, services)}")
    elif not as_json:
        _preview(batch, services)
    judged = batch.requirement_results() if required else []
    if as_json:
        extra = {"requirement_results": [asdict(each) for each in judged]} if judged else {}
        print_json_rows(batch.answer | extra, batch.rows())
    elif judged:
        typer.echo()
        requirements.show(judged, services)
    if junit is not None:
        requirements.write_junit(requirements.cases(judged, services), junit, "ridelab sweep", strict=strict)
    failed = DIFFERENT if failing(judged, strict=strict) else 0
    raise typer.Exit(code or following.say_end(batch) or failed)


def _set_in_every_point(swept: Mapping[str, Any]) -> set[str]:
    """Names of the fields whose value in the scenario no point has."""
    points = swept.get("list", [swept.get("grid", {})])
    if not isinstance(points, list) or not points or not all(isinstance(point, dict) for point in points):
        return set()  # the service says what is wrong
    return set[str].intersection(*map(set, points))


def _write(batch: Batch, file_format: str, out: str, follow_up: str) -> None:
    try:
        deliver(batch.content(file_format), out)
    except (RidelabClientError, OSError):
        note(f"For its rows: {follow_up}")
        raise
    if out != "-":
        cancelled = ", those that never ran with the status cancelled" if batch.state == "cancelled" else ""
        note(f"Wrote {out}: all {len(batch)} rows{cancelled}")


def _preview(batch: Batch, services: Services) -> None:
    """The first rows, with the metrics most people look at."""
    swept = [(item["name"], item["unit"]) for item in batch.answer["fields"] or []]
    rows = []
    for row in itertools.islice(batch.rows(), _PREVIEW):
        figures = dict(flat(row.get("metrics") or {}))
        cells = [*(row.get(name) for name, _ in swept), row["strategy"], row["status"], *map(figures.get, _FIGURES)]
        rows.append([*cells, row.get("reason") or ""])
    heads = [with_unit(*item) for item in (*swept, ("strategy", ""), ("status", ""))]
    heads += [with_unit(name, services.names.metrics[name]) for name in _FIGURES]
    heads.append("reason" if any(row[-1] for row in rows) else "")
    show_table(heads, rows)
    if len(batch) > len(rows):
        typer.echo(f"... {len(batch) - len(rows)} more; --out FILE writes all with every metric")
